// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/options.h>
#include <ridgemap/types.h>

#include <array>
#include <vector>

#include "free_cut.h"
#include "gap_closer.h"
#include "join_ends.h"
#include "line_grid.h"
#include "memo.h"
#include "merge_sides.h"

namespace ridgemap
{
/** Makes walls of ridges, again and again as the ridges change: each pass is a pure function of a line and, where it
 * joins lines, of those near its ends, and is done again only when one of these is another one than before. So the
 * walls are a function of the ridges alone, and what an insertion costs depends on the lines that it changed. */
class WallMaker
{
 public:
	explicit WallMaker(const Options& options);

	/** The walls of these ridges, given in canonical order, without what rays passed through. Lines that are the same
	 * object as in the last call are taken to be unchanged. */
	std::vector<Polyline> make(const Lines& ridges, const FreeSpace& space);

	/** Number of lines that passes were applied to so far. */
	std::size_t computed() const { return shaped_.computed() + trimmed_.computed() + straightened_.computed(); }

 private:
	Lines cutRidges(const Lines& ridges);
	Lines withoutShort(const Lines& lines) const;
	Lines shape(const Lines& lines);
	Lines joinEnds(const Lines& lines);
	Lines trim(const Lines& lines);
	Lines straighten(const Lines& lines);
	Lines seat(const Lines& lines);
	LinePtr seated(const LinePtr& line, const std::array<std::vector<int>, 2>& near, const Lines& lines) const;

	Options options_;
	Memo<Lines> strong_;
	FreeCutter clear_, withdraw_;
	SideMerger sides_;
	Memo<LinePtr> shaped_;
	std::array<EndJoiner, 3> joiners_;  ///< ends that a lead has come close to follow in further rounds
	Memo<LinePtr> trimmed_, straightened_, seated_;
	LineGrid grid_;  ///< of the lines that led ends are seated on
	GapCloser closeGaps_;
};

}  // namespace ridgemap
