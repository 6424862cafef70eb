// SPDX-License-Identifier: BSD-3-Clause
// Initial guesses of the second kind (paper section V-A): from a measurement to a point of the ridge.
#pragma once

#include <functional>
#include <optional>

#include "field.h"
#include "ridge_point.h"

namespace ridgemap
{
/** Farthest that a measurement is brought to a ridge [sigma]. */
constexpr double searchReach = 3;

/** What a search for a ridge came to. */
struct Search
{
	enum Outcome
	{
		found,    ///< `ridge` is above L_tol
		known,    ///< it led to a place that is known already
		noRidge,  ///< it led to no ridge
		gaveUp    ///< it went too far, left the domain of the field or did not converge
	};
	Outcome outcome = gaveUp;
	std::optional<RidgePoint> ridge;
};

/** Looks for a ridge above L_tol by the rule of the options, starting at a measurement that was seen from direction
 * `side`. Ends as soon as it comes to a place that is `known`; that is asked for every place on the way. */
Search findRidge(const TileField& field, const Options& options, Vec2 start, Vec2 side,
				 const std::function<bool(Vec2)>& known);

}  // namespace ridgemap
