// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <vector>

namespace ridgemap
{
/** Polylines of the fewest vertices that stay within a tolerance of the given ones.
 *
 * The vertices are vertices of the input in their order, as few as possible among all such choices, and among those the
 * choice with the least sum of squared distances of the left-out vertices. Every point of the result lies within
 * `tolerance` of its input polyline, and every point of the input within `tolerance` of its result. Kept in any case:
 * both ends of open polylines, and junctions, that is, vertices in which an end of a polyline lies; an end in the
 * middle of a segment of another polyline makes a vertex there. A closed polyline keeps three different vertices or
 * more, and may start at another of its vertices than before.
 *
 * A pure function: the same input gives the same bits everywhere. Time O(n k) for n vertices of which k in turn can be
 * replaced by one segment.
 * @param tolerance [m], >= 0. 0 gives back the input, but for the vertices of junctions. Throws std::invalid_argument
 * for other values. */
std::vector<Polyline> simplified(const std::vector<Polyline>& lines, double tolerance);

/** Greatest distance of a point of one of two sets of polylines to the other set [m], in the worse direction; each
 * segment is looked at in steps of at most `step` [m]. Infinite if only one of the sets is empty. */
double greatestDeviation(const std::vector<Polyline>& a, const std::vector<Polyline>& b, double step);

}  // namespace ridgemap
