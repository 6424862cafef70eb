// SPDX-License-Identifier: BSD-3-Clause
#include "true_ridge.h"

#include <algorithm>
#include <cmath>

namespace ridgemap::apps
{
RidgeFunction ridgeFunction(const OccupancySample& o)
{
	const double mean = 0.5 * (o.hxx + o.hyy), half = 0.5 * (o.hxx - o.hyy), root = std::hypot(half, o.hxy);
	const double angle = 0.5 * std::atan2(-o.hxy, -half);  // of the eigenvector of the smaller eigenvalue
	RidgeFunction r;
	r.v1 = {std::cos(angle), std::sin(angle)};
	r.value = std::abs(o.gx * r.v1.x + o.gy * r.v1.y);
	r.concave = mean - root < 0;
	return r;
}

namespace
{
/** <grad L, v1> with v1 on the side of a direction, and its gradient by the third derivatives. */
struct Criterion
{
	double f;
	Point2 gradient;
};
Criterion criterion(const OccupancySample& o, const Point2& side)
{
	Point2 v = ridgeFunction(o).v1;
	if (v.x * side.x + v.y * side.y < 0) v = {-v.x, -v.y};
	const Point2 w{-v.y, v.x};
	const auto second = [&](const Point2& a, const Point2& b)
	{ return o.hxx * a.x * b.x + o.hxy * (a.x * b.y + a.y * b.x) + o.hyy * a.y * b.y; };
	const double gap = second(v, v) - second(w, w);
	const auto along = [&](const Point2& n)
	{
		const double third = o.txxx * v.x * w.x * n.x + o.txxy * (v.x * w.x * n.y + v.x * w.y * n.x + v.y * w.x * n.x) +
							 o.txyy * (v.x * w.y * n.y + v.y * w.x * n.y + v.y * w.y * n.x) + o.tyyy * v.y * w.y * n.y;
		return second(v, n) + (o.gx * w.x + o.gy * w.y) / gap * third;
	};
	return {o.gx * v.x + o.gy * v.y, {along({1, 0}), along({0, 1})}};
}
}  // namespace

std::optional<double> distanceToRidge(const RidgeMap& map, const Point2& p)
{
	const double sigma = map.options().sigma, longest = 0.3 * sigma;
	const Point2 side = ridgeFunction(map.occupancy(p)).v1;
	Point2 x = p;
	for (int i = 0; i < 100; i++)
	{
		const Criterion c = criterion(map.occupancy(x), side);
		if (!(c.gradient.x * side.x + c.gradient.y * side.y < 0)) return std::nullopt;
		// Onto the ridge by Newton's method, and along its tangent to the foot of p.
		const double steep = std::hypot(c.gradient.x, c.gradient.y);
		const Point2 normal{c.gradient.x / steep, c.gradient.y / steep}, tangent{-normal.y, normal.x};
		const double across = std::clamp(-c.f / steep, -longest, longest);
		const double along = std::clamp((p.x - x.x) * tangent.x + (p.y - x.y) * tangent.y, -longest, longest);
		x = {x.x + across * normal.x + along * tangent.x, x.y + across * normal.y + along * tangent.y};
		const double distance = std::hypot(x.x - p.x, x.y - p.y);
		if (distance > 2 * sigma) return std::nullopt;
		if (std::hypot(across, along) < 1e-7 * sigma) return distance;
	}
	return std::nullopt;
}

}  // namespace ridgemap::apps
