// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/CRidgeMap2D.h>

#include <optional>
#include <vector>

#include "../common/segment.h"
#include "contestant.h"

namespace ridgemap::apps
{
/** The box with a margin [m]. */
Box2 grown(Box2 box, double margin);
/** A square around a point. */
Box2 around(const Point2& centre, double half);
/** Of all measurements, with the positions of the robot. */
Box2 boxOf(const std::vector<PosedScan>& scans);

/** The corner nearest to a right angle between two long straight walls. */
std::optional<Point2> sharpestCorner(const CRidgeMap2D& map);
/** Where two walls run closest beside each other, 3 to 40 cm apart: of the truth if there is one, since the map may
 * have made one of both, else of the map. */
std::optional<Point2> thinnestWall(const CRidgeMap2D& map, const std::vector<Segment>& truth);

}  // namespace ridgemap::apps
