// SPDX-License-Identifier: BSD-3-Clause
// Free ends of walls, joined to what lies beside them.
#pragma once

#include <ridgemap/options.h>

#include "line_grid.h"
#include "memo.h"

namespace ridgemap
{
/** An open end of a line. */
struct LineEnd
{
	int line = -1;  ///< number of the line, -1: none
	bool back = false;

	bool operator==(const LineEnd& o) const { return line == o.line && back == o.back; }
};

/** One round of joining: two free ends that are each other's nearest place are bridged, any other free end is led to
 * the nearest point of another line, or of a distant part of its own, at most `attachDistance` sigma away. Remembers
 * what it did: ends with the same lines near them are not looked at again. */
class EndJoiner
{
 public:
	explicit EndJoiner(const Options& options);

	/** The lines after this round, in canonical order if the lines are. */
	Lines join(const Lines& lines);

 private:
	/** Nearest place to a free end. */
	struct Target
	{
		bool found = false;
		double distance = 0;
		Point2 foot;
		LineEnd end;  ///< the open end that the foot is, if it is one; numbered as in the key of the memo
	};

	const Point2& place(LineEnd e) const;
	Vec2 outward(LineEnd e) const;
	Target target(LineEnd e);
	Target findTarget(LineEnd e, const std::vector<int>& near) const;
	void tryLine(LineEnd e, int line, Target& best) const;
	bool bridged(LineEnd e) const;
	LinePtr group(LineEnd first, std::vector<char>& used);
	Polyline assemble(const std::vector<LineEnd>& entries, bool closed) const;
	void lead(LineEnd e, Polyline& result) const;
	StopReason reasonAt(LineEnd e) const;
	const Target& targetOf(LineEnd e) const { return targets_[std::size_t(2 * e.line + e.back)]; }

	double sigma_, reach_;
	LineGrid grid_;
	Memo<Target> memo_;
	Memo<LinePtr> groups_;
	Lines lines_;
	std::vector<Target> targets_;  ///< of this round, by number of line and end
};

}  // namespace ridgemap
