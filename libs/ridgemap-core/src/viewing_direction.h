// SPDX-License-Identifier: BSD-3-Clause
// From which side a surface was seen. A return tells not only where the surface is but also that the space between it
// and the sensor is free: measurements seen from opposite sides belong to different faces.
#pragma once

#include <cstdint>

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

/** Unit vector in the middle of a bin of known direction. */
inline Vec2 binDirection(std::uint32_t bin)
{
	constexpr double c = 0.92387953251128676, s = 0.38268343236508977;  // of 22.5 degrees
	constexpr double x[8] = {c, s, -s, -c, -c, -s, s, c}, y[8] = {s, c, c, s, -s, -c, -c, -s};
	return {x[bin - 1], y[bin - 1]};
}

/** Weight of the measurements of a bin in the density of the surface whose normal, towards the viewer, is `normal`: 1
 * in front of the surface, 0 behind it, a smooth step of +-1/4 in the cosine between. Unknown directions weigh 1. */
inline double sideWeight(std::uint32_t bin, Vec2 normal)
{
	if (bin == 0) return 1;
	const double t = 0.5 + 2 * dot(normal, binDirection(bin));
	if (t <= 0) return 0;
	return t >= 1 ? 1 : t * t * (3 - 2 * t);
}

/** Change of sideWeight() per radian that the normal turns to its left. */
inline double sideWeightSlope(std::uint32_t bin, Vec2 normal)
{
	if (bin == 0) return 0;
	const Vec2 d = binDirection(bin);
	const double t = 0.5 + 2 * dot(normal, d);
	return t <= 0 || t >= 1 ? 0 : 12 * t * (1 - t) * dot(leftNormal(normal), d);
}

/** The density is the same for both normals. */
inline bool sameWeights(Vec2 a, Vec2 b)
{
	for (std::uint32_t bin = 1; bin < directionBins; bin++)
		if (sideWeight(bin, a) != sideWeight(bin, b)) return false;
	return true;
}

}  // namespace ridgemap
