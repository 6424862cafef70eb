// SPDX-License-Identifier: BSD-3-Clause
// Walls that were seen from both sides and are too thin to have two faces.
#pragma once

#include <ridgemap/options.h>

#include <vector>

#include "line_grid.h"
#include "memo.h"

namespace ridgemap
{
/** Makes one line of the two faces of a wall that is on average thinner than `mergeDistance` sigma over the stretch on
 * which the faces run along each other at most 1.3 sigma apart: the longer face is kept, moved to the middle as their
 * densities weigh, the shorter one is cut along this stretch. Faces know the side from which they were seen and look
 * away from each other; a wall of negative thickness, as poses that are off make it, is thin. Remembers what it did:
 * lines with the same lines near them are not looked at again. */
class SideMerger
{
 public:
	explicit SideMerger(const Options& options);

	/** The lines after merging, in canonical order if the lines are. */
	Lines merge(const Lines& lines);

 private:
	/** What two faces have in common, by vertices. */
	struct Shared
	{
		/** Where a vertex of the longer face is to go. */
		struct Move
		{
			std::size_t vertex = 0;
			double thickness = 0;  ///< absolute [m]
			Point2 to;
		};
		std::vector<Move> moves;
		std::vector<std::size_t> doubled;  ///< vertices of the shorter face that are left out
	};
	/** Asked with the same order of the two for either of them, so that both get the same answer. */
	Shared shared(const Polyline& longer, const Polyline& shorter) const;
	Lines merged(const LinePtr& line, const Lines& near);

	double sigma_, distance_;
	LineGrid grid_;
	Memo<Shared> shared_;
	Memo<Lines> memo_;
};

}  // namespace ridgemap
