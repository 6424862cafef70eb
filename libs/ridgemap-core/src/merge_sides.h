// SPDX-License-Identifier: BSD-3-Clause
// Walls that were seen from both sides and are too thin to have two faces.
#pragma once

#include <ridgemap/options.h>

#include "line_grid.h"
#include "memo.h"

namespace ridgemap
{
/** Makes one line of lines that run along each other at most `mergeDistance` sigma apart: the longer one is kept, moved
 * to the middle as their densities weigh, the shorter one is cut where it runs along. Looks only at lines that know the
 * side from which they were seen. Remembers what it did: lines with the same lines near them are not looked at again.
 */
class SideMerger
{
 public:
	explicit SideMerger(const Options& options);

	/** The lines after merging, in canonical order if the lines are. */
	Lines merge(const Lines& lines);

 private:
	Lines merged(const LinePtr& line, const Lines& near) const;

	double sigma_, distance_;
	LineGrid grid_;
	Memo<Lines> memo_;
};

}  // namespace ridgemap
