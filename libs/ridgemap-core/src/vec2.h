// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace ridgemap
{
/** A vector or point in lattice coordinates, unit sigma. */
struct Vec2
{
	double x = 0;
	double y = 0;
};

inline Vec2 operator+(Vec2 a, Vec2 b)
{
	return {a.x + b.x, a.y + b.y};
}
inline Vec2 operator-(Vec2 a, Vec2 b)
{
	return {a.x - b.x, a.y - b.y};
}
inline Vec2 operator-(Vec2 a)
{
	return {-a.x, -a.y};
}
inline Vec2 operator*(double s, Vec2 a)
{
	return {s * a.x, s * a.y};
}
inline bool operator==(Vec2 a, Vec2 b)
{
	return a.x == b.x && a.y == b.y;
}
inline double dot(Vec2 a, Vec2 b)
{
	return a.x * b.x + a.y * b.y;
}
inline double cross(Vec2 a, Vec2 b)
{
	return a.x * b.y - a.y * b.x;
}
inline double norm(Vec2 a)
{
	return std::sqrt(dot(a, a));
}
inline Vec2 leftNormal(Vec2 a)
{
	return {-a.y, a.x};
}
inline Vec2 unit(Vec2 a)
{
	const double n = norm(a);
	return n > 0 ? (1 / n) * a : Vec2{1, 0};
}

/** Closest point of a segment: its parameter in [0,1] and its distance. */
struct SegmentFoot
{
	double t = 0;
	double distance = 0;
};
inline SegmentFoot footOnSegment(Vec2 a, Vec2 b, Vec2 p)
{
	const Vec2 d = b - a;
	const double l2 = dot(d, d);
	double t = l2 > 0 ? dot(p - a, d) / l2 : 0;
	t = t < 0 ? 0 : t > 1 ? 1 : t;
	return {t, norm(p - (a + t * d))};
}

}  // namespace ridgemap
