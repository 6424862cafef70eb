// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/options.h>

#include <array>
#include <vector>

#include "line_grid.h"
#include "memo.h"

namespace ridgemap
{
/** Last step of joining ends: an end that is left near another line, because one of the two was drawn anew, gets one
 * more vertex, on the other line. No segment is moved, so that no gap opens elsewhere. Remembers what it did. */
class GapCloser
{
 public:
	explicit GapCloser(const Options& options) : sigma_(options.sigma), grid_(4 * options.sigma) {}

	/** The lines without such gaps, in the same order. */
	Lines close(const Lines& lines);

 private:
	LinePtr closed(const LinePtr& line, const std::array<std::vector<int>, 2>& near, const Lines& lines) const;

	double sigma_;
	LineGrid grid_;
	Memo<LinePtr> memo_;
};

}  // namespace ridgemap
