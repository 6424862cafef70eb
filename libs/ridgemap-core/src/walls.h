// SPDX-License-Identifier: BSD-3-Clause
// Walls: what people and robots use, made from the strict ridges by passes that are pure functions.
#pragma once

#include <ridgemap/options.h>
#include <ridgemap/types.h>

#include <vector>

namespace ridgemap
{
/** Leaves out stretches whose vertices are less curved across than `minCurvature`: rungs between walls, which the ridge
 * criterion admits but no surface made. */
std::vector<Polyline> cutWeak(const std::vector<Polyline>& lines, const Options& options);

/** Leaves out polylines shorter than `pruneLength` sigma; lengths are of whole, stitched polylines. */
std::vector<Polyline> pruneShort(const std::vector<Polyline>& lines, const Options& options);

/** Joins free ends to what lies beside them, at most `attachDistance` sigma away: two free ends that are nearest to
 * each other are bridged, any other free end is led to the nearest point of another line (or of a distant part of its
 * own). Ends that such a lead has come close to follow in further rounds. */
std::vector<Polyline> attachFreeEnds(const std::vector<Polyline>& lines, const Options& options);

/** Puts a vertex where two straight arms of a line meet, in place of the rounded bend that the ridge makes there. Bends
 * that are wider than a corner's, and curves, are left as they are. */
std::vector<Polyline> sharpenCorners(const std::vector<Polyline>& lines, const Options& options);

/** Moves the free ends of straight lines back to where the density falls to half that of the wall, which is where the
 * surface ends, and draws their last stretch straight. Ends that other lines are led to stay. */
std::vector<Polyline> trimEnds(const std::vector<Polyline>& lines, const Options& options);

/** Replaces every stretch that is straight or circular within what chance explains by the fitted line or arc; parts
 * meet where they cross. Writes the shape of every segment, the standard error of every vertex, and the noise of every
 * wall.
 */
std::vector<Polyline> straightenRuns(const std::vector<Polyline>& lines, const Options& options);

/** Moves the vertices of bent stretches outwards, by as much as the ridge of a circle of their radius lies inside it.
 * Arcs that straightenRuns() has fitted are moved there. */
std::vector<Polyline> correctBends(const std::vector<Polyline>& lines, const Options& options);

/** All passes that the options ask for, in order. */
std::vector<Polyline> makeWalls(const std::vector<Polyline>& ridges, const Options& options);

}  // namespace ridgemap
