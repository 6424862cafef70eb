// SPDX-License-Identifier: BSD-3-Clause
// Borders between tiles: where ridges pass from one to the next (initial guesses of the first kind, paper section V-A).
#pragma once

#include "field.h"
#include "ridge_point.h"
#include "tile.h"

namespace ridgemap
{
/** Farthest that a measurement may lie beside a ridge and still support it [sigma]. */
constexpr double supportWidth = 2.5;

/** Measurements lie within d_tol of a point of a ridge both ways along it, so that it does not end right there. */
bool isSupported(const TileField& field, const Options& options, const RidgePoint& r, Vec2 tangent);

/** Place for the lower-left corner of a field's tile: the nominal one, or one beside it that keeps clear of ridges. */
Vec2 placeCorner(const TileField& field, const Options& options);

/** Lays the border from corner `from` to corner `to` (frame of the field's tile) so that ridges cross it transversally
 * where possible, and finds all crossings of ridges above L_tol that have measurements on both sides. */
Edge layEdge(const TileField& field, Vec2 from, Vec2 to, const Options& options);

}  // namespace ridgemap
