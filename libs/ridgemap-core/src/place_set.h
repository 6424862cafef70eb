// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "frame.h"

namespace ridgemap
{
/** Sets of places in and around a tile, one for each direction bin, kept as the squares of a quarter of sigma that the
 * places lie in: every square has a mask of the sets that it belongs to, bit `bin` for each. */
class PlaceSets
{
 public:
	/** For a tile of this edge and the given margin around it [sigma]. */
	PlaceSets(double edge, double margin) : origin_(margin), side_(int(std::ceil((edge + 2 * margin) * perSigma))) {}

	bool contains(Vec2 p, std::uint32_t bin) const
	{
		const int x = index(p.x), y = index(p.y);
		if (!masks_ || x < 0 || y < 0 || x >= side_ || y >= side_) return false;
		return masks_[std::size_t(y * side_ + x)] >> bin & 1;
	}

	void add(Vec2 p, std::uint32_t mask)
	{
		const int x = index(p.x), y = index(p.y);
		if (x >= 0 && y >= 0 && x < side_ && y < side_) addSpan(y, x, x, mask);
	}

	/** Adds the squares whose middle is at most `radius` from p. */
	void addDisc(Vec2 p, double radius, std::uint32_t mask) { addCapsule(p, p, radius, mask); }

	/** Adds the squares whose middle is at most `radius` from the segment a-b. */
	void addCapsule(Vec2 a, Vec2 b, double radius, std::uint32_t mask)
	{
		const double r = radius * perSigma;
		Vec2 low = middleIndex(a), high = middleIndex(b);
		if (low.y > high.y) std::swap(low, high);
		const Vec2 along = high - low;
		const double length = norm(along);
		// From the segment to its parallels on both sides.
		const Vec2 beside = length > 0 ? (r / length) * leftNormal(along) : Vec2{};
		const int last = std::min(side_ - 1, roundDown(high.y + r));
		for (int y = std::max(0, roundUp(low.y - r)); y <= last; y++)
		{
			double left = side_, right = -1;
			for (const Vec2& c : {low, high})
			{
				const double square = r * r - (y - c.y) * (y - c.y);
				if (square < 0) continue;
				const double half = std::sqrt(square);
				left = std::min(left, c.x - half);
				right = std::max(right, c.x + half);
			}
			for (const Vec2& c : {low + beside, low - beside})
			{
				const double up = y - c.y;
				if (up < 0 || up > along.y || !(along.y > 0)) continue;
				const double column = c.x + along.x * (up / along.y);
				left = std::min(left, column);
				right = std::max(right, column);
			}
			addSpan(y, std::max(0, roundUp(left)), std::min(side_ - 1, roundDown(right)), mask);
		}
	}

 private:
	static constexpr int perSigma = 4;

	int index(double coordinate) const { return roundDown((coordinate + origin_) * perSigma); }
	/** Column and row of the square whose middle would be here. */
	Vec2 middleIndex(Vec2 p) const { return {(p.x + origin_) * perSigma - 0.5, (p.y + origin_) * perSigma - 0.5}; }

	void addSpan(int y, int x0, int x1, std::uint32_t mask)
	{
		if (!masks_) masks_ = std::make_unique<std::uint16_t[]>(std::size_t(side_ * side_));
		std::uint16_t* row = masks_.get() + y * side_;
		for (int x = x0; x <= x1; x++) row[x] = std::uint16_t(row[x] | mask);
	}

	double origin_;
	int side_;
	std::unique_ptr<std::uint16_t[]> masks_;  ///< row by row; none while the sets are empty
};

}  // namespace ridgemap
