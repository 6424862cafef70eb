// SPDX-License-Identifier: BSD-3-Clause
// Initial guesses of the second kind (paper section V-A): from a measurement to a point of the ridge.
#pragma once

#include <functional>
#include <optional>

#include "field.h"
#include "ridge_point.h"

namespace ridgemap
{
/** Finds a ridge point above L_tol by the rule of the options, starting at a measurement. None if the search does not
 * converge to one within the domain of the field, or as soon as it comes to a place that is `known` already. */
std::optional<RidgePoint> findRidge(const TileField& field, const Options& options, Vec2 start,
									const std::function<bool(Vec2)>& known);

}  // namespace ridgemap
