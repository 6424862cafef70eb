// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "memo.h"
#include "vec2.h"

namespace ridgemap
{
/** Which lines pass near a place. Follows a changing set of lines at a cost that depends on the change. */
class LineGrid
{
 public:
	/** @param cell edge of its cells [m], about the distances that will be asked for */
	explicit LineGrid(double cell) : cell_(cell) {}

	/** From now on the lines are these. */
	void follow(const Lines& lines);

	/** Numbers, in ascending order, of the lines that may pass within a distance of a place; all that do are there. */
	std::vector<int> near(const Point2& p, double distance) const;

	/** Lines that may pass near the ends of a line, and the key of what they and the line determine. */
	struct NearEnds
	{
		std::array<std::vector<int>, 2> numbers;  ///< at the first and the last point
		MemoKey key;
	};
	/** Of the ends, those of which `isAsked(back)` is true; `lines` are those that are followed. */
	template <class Fn>
	NearEnds nearEnds(const LinePtr& line, double distance, const Lines& lines, Fn isAsked) const
	{
		NearEnds result;
		result.key.add(line);
		for (const bool back : {false, true})
		{
			if (isAsked(back)) result.numbers[back] = near(back ? line->points.back() : line->points.front(), distance);
			for (const int i : result.numbers[back]) result.key.add(lines[std::size_t(i)]);
			result.key.add(back);
		}
		return result;
	}

	/** The other lines that may pass within half a cell of a line, given by its number; all that do are there. Looked
	 * up again only when lines near it have changed. */
	const Lines& beside(int number);

 private:
	/** A line that is followed; a slot is used again when its line has gone. */
	struct Slot
	{
		LinePtr line;
		std::vector<std::uint64_t> keys;  ///< cells that it passes
		int number = 0;
		bool present = false;
		Lines beside;
		bool besideKnown = false;
	};
	int slotOf(const LinePtr& line);
	void release(int slot);
	/** Slots of the lines in these cells and in those around them, some of them several times. */
	template <class Visit>
	void visitAround(const std::vector<std::uint64_t>& keys, Visit visit) const;
	void forgetBeside(const std::vector<std::uint64_t>& keys);
	std::uint64_t key(double x, double y) const;
	std::vector<std::uint64_t> cellsOf(const Polyline& line) const;

	double cell_;
	std::vector<Slot> slots_;
	std::vector<int> free_;
	std::vector<int> slotOfNumber_;
	bool besideAsked_ = false;  ///< so far nothing needs to be forgotten
	std::unordered_map<const Polyline*, int> slotOfLine_;
	std::unordered_map<std::uint64_t, std::vector<int>> cells_;  ///< slots of the lines that pass
};

}  // namespace ridgemap
