// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <algorithm>
#include <cmath>

namespace ridgemap
{
/** The point at t; exactly a or b at the ends. */
inline Point2 along(const Point2& a, const Point2& b, double t)
{
	if (t >= 1) return b;
	return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/** The point of a segment nearest to p. */
template <class Segment>
Point2 footOn(const Segment& s, const Point2& p)
{
	const double t = ((p.x - s.a.x) * (s.b.x - s.a.x) + (p.y - s.a.y) * (s.b.y - s.a.y)) * s.perLengthSqr;
	return along(s.a, s.b, std::max(0.0, t));
}

inline double squareBetween(const Point2& a, const Point2& b)
{
	const double dx = a.x - b.x, dy = a.y - b.y;
	return dx * dx + dy * dy;
}

inline bool isFinite(const Point2& p)
{
	return std::isfinite(p.x) && std::isfinite(p.y);
}

/** Cells of a PolylineIndex know the segments up to this distance, in bucket edges. */
constexpr double cellReach = 8;

}  // namespace ridgemap
