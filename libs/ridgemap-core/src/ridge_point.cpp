// SPDX-License-Identifier: BSD-3-Clause
#include "ridge_point.h"

#include <limits>

namespace ridgemap
{
namespace
{
/** Unit eigenvector of the larger eigenvalue of (xx xy; xy yy), by half-angle formulas. */
Vec2 majorEigenvector(double halfDifference, double xy, double radius)
{
	if (!(radius > 0)) return {1, 0};
	const double c = halfDifference / radius;
	if (c >= 0)
	{
		const double x = std::sqrt(0.5 * (1 + c));
		return {x, 0.5 * xy / (radius * x)};
	}
	const double y = std::sqrt(0.5 * (1 - c));
	return {0.5 * xy / (radius * y), y};
}
}  // namespace

RidgePoint makeRidgePoint(Vec2 p, const KernelSums& s)
{
	RidgePoint r;
	r.p = p;
	r.occupancy = s.value;
	r.gradient = {s.gx, s.gy};
	const double mean = 0.5 * (s.hxx + s.hyy), half = 0.5 * (s.hxx - s.hyy);
	const double radius = std::sqrt(half * half + s.hxy * s.hxy);
	r.lambda1 = mean - radius;
	r.lambda2 = mean + radius;
	r.v2 = majorEigenvector(half, s.hxy, radius);
	r.v1 = leftNormal(r.v2);
	r.f = dot(r.gradient, r.v1);
	const Vec2 a = r.v1, b = r.v2;
	const double tx = s.txxx * a.x * b.x + s.txxy * (a.x * b.y + a.y * b.x) + s.txyy * a.y * b.y;
	const double ty = s.txxy * a.x * b.x + s.txyy * (a.x * b.y + a.y * b.x) + s.tyyy * a.y * b.y;
	const double gap = r.lambda1 - r.lambda2;
	const double k = gap < 0 ? dot(r.gradient, b) / gap : 0;
	r.df = {r.lambda1 * a.x + k * tx, r.lambda1 * a.y + k * ty};
	return r;
}

double sensitivity(const RidgePoint& r)
{
	const double pull = -dot(r.df, r.v1);
	if (!(pull > 0)) return std::numeric_limits<double>::infinity();
	const double turn = std::abs(dot(r.gradient, r.v2)) / (r.lambda2 - r.lambda1);
	return r.occupancy * (1 + turn) / pull;
}

bool isRidgeLike(const RidgePoint& r, const Options& o)
{
	return r.lambda1 < 0 && r.occupancy > 0 && sensitivity(r) <= o.maxSensitivity;
}

}  // namespace ridgemap
