// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "frame.h"

namespace ridgemap
{
/** A set of places in and around a tile, kept as the squares of a quarter of sigma that they lie in. */
class PlaceSet
{
 public:
	/** For a tile of this edge and the given margin around it [sigma]. */
	PlaceSet(double edge, double margin)
		: origin_(margin),
		  side_(int(std::ceil((edge + 2 * margin) * perSigma))),
		  words_((side_ + 63) / 64),
		  bits_(std::size_t(side_ * words_), 0)
	{
	}

	bool contains(Vec2 p) const
	{
		const int x = index(p.x), y = index(p.y);
		if (x < 0 || y < 0 || x >= side_ || y >= side_) return false;
		return bits_[std::size_t(y * words_ + x / 64)] >> (x % 64) & 1;
	}

	void add(Vec2 p)
	{
		const int x = index(p.x), y = index(p.y);
		if (x >= 0 && y >= 0 && x < side_ && y < side_) addSpan(y, x, x);
	}

	/** Adds the squares whose middle is at most `radius` from p. */
	void addDisc(Vec2 p, double radius)
	{
		const double cx = (p.x + origin_) * perSigma - 0.5, cy = (p.y + origin_) * perSigma - 0.5;
		const double r = radius * perSigma;
		const int last = std::min(side_ - 1, roundDown(cy + r));
		for (int y = std::max(0, roundUp(cy - r)); y <= last; y++)
		{
			const double half = std::sqrt(std::max(0.0, r * r - (y - cy) * (y - cy)));
			const int x0 = std::max(0, roundUp(cx - half)), x1 = std::min(side_ - 1, roundDown(cx + half));
			if (x0 <= x1) addSpan(y, x0, x1);
		}
	}

	/** Adds the squares whose middle is at most about `radius` from the segment a-b. */
	void addCapsule(Vec2 a, Vec2 b, double radius)
	{
		const int steps = std::max(1, roundUp(norm(b - a) * 2 * perSigma / (1 + perSigma * radius)));
		for (int i = 0; i <= steps; i++) addDisc(a + (double(i) / steps) * (b - a), radius);
	}

 private:
	static constexpr int perSigma = 4;

	int index(double coordinate) const { return roundDown((coordinate + origin_) * perSigma); }

	void addSpan(int y, int x0, int x1)
	{
		std::uint64_t* row = bits_.data() + y * words_;
		for (int w = x0 / 64; w <= x1 / 64; w++)
		{
			const int first = std::max(0, x0 - 64 * w), last = std::min(63, x1 - 64 * w);
			row[w] |= ((std::uint64_t(2) << last) - 1) & ~((std::uint64_t(1) << first) - 1);
		}
	}

	double origin_;
	int side_, words_;
	std::vector<std::uint64_t> bits_;
};

}  // namespace ridgemap
