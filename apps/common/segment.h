// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <algorithm>
#include <cmath>

namespace ridgemap::apps
{
/** A straight piece of a true surface, map frame [m]. */
struct Segment
{
	Point2 a, b;
	bool seen = true;  ///< some sensor position had it in view

	double length() const { return std::hypot(b.x - a.x, b.y - a.y); }
	Point2 at(double t) const { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }
	/** Share 0 .. 1 of the way from a to b at which p is nearest. */
	double nearest(const Point2& p) const
	{
		const double dx = b.x - a.x, dy = b.y - a.y, n = dx * dx + dy * dy;
		return n > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / n, 0.0, 1.0) : 0;
	}
	double distance(const Point2& p) const
	{
		const Point2 q = at(nearest(p));
		return std::hypot(p.x - q.x, p.y - q.y);
	}
};

}  // namespace ridgemap::apps
