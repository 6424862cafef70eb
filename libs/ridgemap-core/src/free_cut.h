// SPDX-License-Identifier: BSD-3-Clause
// Walls without what rays passed through: people who walked, doors that opened, points between two surfaces.
#pragma once

#include <ridgemap/options.h>
#include <ridgemap/types.h>

#include <vector>

#include "free_space.h"
#include "memo.h"

namespace ridgemap
{
/** Leaves out the stretches of lines through which more rays passed than ended there.
 *
 * Samples lie 0.5 sigma apart. Each has hits, its density in kernels times 0.5 cell/sigma, and passes, the sum of
 * cos^2 of the angle between the rays and the normal of the line. A sample stays where the hits within
 * `freeSpaceWindow` are at least `freeSpaceTau` of hits and passes, or where fewer than `freeSpaceLeast` rays passed on
 * average. Stretches below 2 sigma between stretches that stay are kept, and below 3 sigma at the end of a line. A line
 * of which all stays comes out as it is.
 *
 * A line depends on itself and on the counters within `freeSpaceWindow` + 3 sigma of it alone.
 * @param removed where to put what was left out, if wanted */
std::vector<Polyline> cutFree(const std::vector<Polyline>& lines, const FreeSpace& space, const Options& options,
							  std::vector<Polyline>* removed = nullptr);

/** The same again and again, as lines and counters change. Decisions are made anew, which takes some 50 ns a sample;
 * the parts of a line are made anew only when a decision differs. */
class FreeCutter
{
 public:
	explicit FreeCutter(const Options& options) : options_(options) {}

	/** @param prune leave out parts of cut lines that are shorter than pruneLength */
	Lines cut(const Lines& lines, const FreeSpace& space, bool prune);

 private:
	Options options_;
	Memo<Lines> parts_;
};

/** Passes through a piece of surface: the sum of cos^2 of the angles between the rays and its normal, both in the
 * lattice frame; `tangent` is a unit vector, p in sigma. */
double passesAcross(const FreeSpace& space, Vec2 p, Vec2 tangent);

/** Hits that are comparable with passes, from the density [kernels]. */
inline double hitsOf(double occupancy)
{
	return 0.5 * double(LatticeRay::cellSigmas) * occupancy;
}

}  // namespace ridgemap
