// SPDX-License-Identifier: BSD-3-Clause
// Walls: what people and robots use, made from the strict ridges by passes that are pure functions. WallMaker puts them
// in order. Each pass here knows one line only.
#pragma once

#include <ridgemap/options.h>
#include <ridgemap/types.h>

#include <vector>

namespace ridgemap
{
class FreeSpace;

/** The parts of a line that remain without some of its vertices; where it is cut, the ends have the given reason. */
std::vector<Polyline> withoutVertices(const Polyline& line, const std::vector<bool>& leftOut, StopReason reason);

/** Leaves out stretches whose vertices are less curved across than `minCurvature`: rungs between walls, which the ridge
 * criterion admits but no surface made. */
std::vector<Polyline> cutWeak(const Polyline& line, const Options& options);

/** Shorter than `pruneLength` sigma; lengths are of whole, stitched polylines. */
bool isShort(const Polyline& line, const Options& options);

/** Puts a vertex where two straight arms of a line meet, in place of the rounded bend that the ridge makes there. Bends
 * that are wider than a corner's, and curves, are left as they are. */
Polyline sharpenCorners(const Polyline& line, const Options& options);

/** Moves the free ends that are asked for back to where the density falls to half that of the wall, which is where the
 * surface ends, and draws their last stretch straight; only at straight ends. */
Polyline trimEnds(const Polyline& line, bool front, bool back, const Options& options);

/** Ends with another line led to a place nearer than this are not to be trimmed [m]. */
double visitedRange(const Polyline& line, const Options& options);

/** Replaces every stretch that is straight or circular within what chance explains by the fitted line or arc; parts
 * meet where they cross. Writes the shape of every segment, the standard error of every vertex, and the noise of the
 * wall. */
Polyline straightenRuns(const Polyline& line, const Options& options);

/** Moves the vertices of bent stretches outwards, by as much as the ridge of a circle of their radius lies inside it.
 * Arcs that straightenRuns() has fitted are moved there. */
Polyline correctBends(const Polyline& line, const Options& options);

/** All passes that the options ask for, in order, from scratch. */
std::vector<Polyline> makeWalls(const std::vector<Polyline>& ridges, const FreeSpace& space, const Options& options);

/** What the first cut along free space leaves out of these, as far as it was long enough for a wall. */
std::vector<Polyline> clearedFromWalls(const std::vector<Polyline>& ridges, const FreeSpace& space,
									   const Options& options);

}  // namespace ridgemap
