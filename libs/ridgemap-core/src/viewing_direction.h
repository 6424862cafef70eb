// SPDX-License-Identifier: BSD-3-Clause
// From which side a surface was seen. A return tells not only where the surface is but also that the space between it
// and the sensor is free: measurements seen from opposite sides belong to different faces.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "vec2.h"

namespace ridgemap
{
/** Bins of viewing directions: eight of 45 degrees each, and 0 for measurements whose direction is not known. */
constexpr std::uint32_t directionBins = 9;

/** Bin of a direction from the surface to the sensor, lattice frame, any length. */
inline std::uint32_t directionBin(Vec2 d)
{
	if (!(d.x * d.x + d.y * d.y > 0)) return 0;
	std::uint32_t bin = 1;
	if (d.y < 0 || (d.y == 0 && d.x < 0))
	{
		d = -d;
		bin += 4;
	}
	if (d.x <= 0)
	{
		d = {d.y, -d.x};
		bin += 2;
	}
	return d.y >= d.x ? bin + 1 : bin;
}

/** Unit vectors in the middle of the bins; zero for the bin of unknown directions. */
struct BinDirections
{
	static constexpr double c = 0.92387953251128676, s = 0.38268343236508977;  // of 22.5 degrees
	static constexpr double x[directionBins] = {0, c, s, -s, -c, -c, -s, s, c},
							y[directionBins] = {0, s, c, c, s, -s, -c, -c, -s};
};

/** Unit vector in the middle of a bin of known direction. */
inline Vec2 binDirection(std::uint32_t bin)
{
	return {BinDirections::x[bin], BinDirections::y[bin]};
}

/** By how much the cosine between the direction of a bin and a normal is past the step between behind and in front, as
 * a share of the step. */
inline double sideStep(std::uint32_t bin, Vec2 normal)
{
	const double t = 0.5 + 2 * (normal.x * BinDirections::x[bin] + normal.y * BinDirections::y[bin]);
	return std::min(1.0, std::max(0.0, t));
}

/** Measurements of a direction bin count for a surface with this normal. */
inline bool isSeenFrom(std::uint32_t bin, Vec2 normal)
{
	return bin == 0 || sideStep(bin, normal) > 0;
}

/** Weights of the measurements of each direction bin in the density of the surface whose normal, towards the viewer, is
 * given: 1 in front of the surface, 0 behind it, a smooth step of +-1/4 in the cosine between. Unknown directions
 * weigh 1. Without a normal, all weigh 1. */
struct SideWeights
{
	double of[directionBins];

	SideWeights() { std::fill(std::begin(of), std::end(of), 1.0); }
	explicit SideWeights(Vec2 normal)
	{
		for (std::uint32_t bin = 0; bin < directionBins; bin++)
		{
			const double t = sideStep(bin, normal);
			of[bin] = t * t * (3 - 2 * t);
		}
		of[0] = 1;
	}
	/** The density is the same for both normals. */
	bool operator==(const SideWeights& o) const { return std::equal(std::begin(of), std::end(of), std::begin(o.of)); }
};

/** Change of the weights per radian that the normal turns to its left. */
struct SideSlopes
{
	double of[directionBins];

	explicit SideSlopes(Vec2 normal)
	{
		const Vec2 left = leftNormal(normal);
		for (std::uint32_t bin = 0; bin < directionBins; bin++)
		{
			const double t = sideStep(bin, normal);
			of[bin] = 12 * t * (1 - t) * (left.x * BinDirections::x[bin] + left.y * BinDirections::y[bin]);
		}
	}
};

}  // namespace ridgemap
