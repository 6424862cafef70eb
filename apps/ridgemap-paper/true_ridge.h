// SPDX-License-Identifier: BSD-3-Clause
// The ridge criterion from the occupancy alone, independent of the code that traces ridges.
#pragma once

#include <ridgemap/ridge_map.h>

#include <optional>

namespace ridgemap::apps
{
/** The ridge function R = |<grad L, v1>|, equation (8) [kernels/m]; with lambda1 < 0 told. */
struct RidgeFunction
{
	double value = 0;
	bool concave = false;
	Point2 v1;  ///< unit
};
RidgeFunction ridgeFunction(const OccupancySample& o);

/** Distance of a point to the nearest place of the ridge beside it [m]: Newton's method on <grad L, v1> = 0 for the
 * foot of the perpendicular. Nothing if no ridge is found within 2 sigma. */
std::optional<double> distanceToRidge(const RidgeMap& map, const Point2& p);

}  // namespace ridgemap::apps
