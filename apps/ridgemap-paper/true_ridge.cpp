// SPDX-License-Identifier: BSD-3-Clause
#include "true_ridge.h"

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
/** <grad L, v1> with v1 on the side of a direction, and its derivative along this direction by the third derivatives.
 */
struct Criterion
{
	double f, slope;
};
Criterion criterion(const OccupancySample& o, const Point2& n)
{
	Point2 v = ridgeFunction(o).v1;
	if (v.x * n.x + v.y * n.y < 0) v = {-v.x, -v.y};
	const Point2 w{-v.y, v.x};
	const auto second = [&](const Point2& a, const Point2& b)
	{ return o.hxx * a.x * b.x + o.hxy * (a.x * b.y + a.y * b.x) + o.hyy * a.y * b.y; };
	const double third = o.txxx * v.x * w.x * n.x + o.txxy * (v.x * w.x * n.y + v.x * w.y * n.x + v.y * w.x * n.x) +
						 o.txyy * (v.x * w.y * n.y + v.y * w.x * n.y + v.y * w.y * n.x) + o.tyyy * v.y * w.y * n.y;
	const double gap = second(v, v) - second(w, w);
	return {o.gx * v.x + o.gy * v.y, second(v, n) + (o.gx * w.x + o.gy * w.y) / gap * third};
}
}  // namespace

std::optional<double> distanceToRidge(const RidgeMap& map, const Point2& p)
{
	const double sigma = map.options().sigma;
	const Point2 n = ridgeFunction(map.occupancy(p)).v1;
	double moved = 0;
	for (int i = 0; i < 30; i++)
	{
		const Criterion c = criterion(map.occupancy({p.x + moved * n.x, p.y + moved * n.y}), n);
		if (!(c.slope < 0)) return std::nullopt;
		const double step = std::max(-0.3 * sigma, std::min(0.3 * sigma, -c.f / c.slope));
		moved += step;
		if (std::abs(moved) > 2 * sigma) return std::nullopt;
		if (std::abs(step) < 1e-7 * sigma) return std::abs(moved);
	}
	return std::nullopt;
}

}  // namespace ridgemap::apps
