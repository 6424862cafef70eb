// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

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
	void addDisc(Vec2 p, double radius, std::uint32_t mask)
	{
		const double cx = (p.x + origin_) * perSigma - 0.5, cy = (p.y + origin_) * perSigma - 0.5;
		const double r = radius * perSigma;
		const int last = std::min(side_ - 1, roundDown(cy + r));
		for (int y = std::max(0, roundUp(cy - r)); y <= last; y++)
		{
			const double half = std::sqrt(std::max(0.0, r * r - (y - cy) * (y - cy)));
			const int x0 = std::max(0, roundUp(cx - half)), x1 = std::min(side_ - 1, roundDown(cx + half));
			addSpan(y, x0, x1, mask);
		}
	}

	/** Adds the squares whose middle is at most about `radius` from the segment a-b. */
	void addCapsule(Vec2 a, Vec2 b, double radius, std::uint32_t mask)
	{
		const int steps = std::max(1, roundUp(norm(b - a) * 2 * perSigma / (1 + perSigma * radius)));
		for (int i = 0; i <= steps; i++) addDisc(a + (double(i) / steps) * (b - a), radius, mask);
	}

 private:
	static constexpr int perSigma = 4;

	int index(double coordinate) const { return roundDown((coordinate + origin_) * perSigma); }

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
