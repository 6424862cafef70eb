// SPDX-License-Identifier: BSD-3-Clause
#include "ridge_point.h"

#include <limits>

namespace ridgemap
{
namespace
{
/** Above this the normal and the density of a side do not determine each other well enough. */
constexpr double largestResponse = 0.5;
/** A normal is found when v1 is this close to it, and not found when it stays farther away than the second [rad]. */
constexpr double goodNormal = 1e-3, fairNormal = 0.02;
/** How often a normal is improved; two are enough on most surfaces. */
constexpr int mostNormals = 6;

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

/** The density turns with v1: what that adds to the gradient of f. */
void addTurn(const FieldTurn& turn, RidgePoint& r)
{
	const double gap = r.lambda1 - r.lambda2;
	if ((turn.twist == 0 && turn.slope == 0) || !(gap < 0)) return;
	r.response = turn.twist / gap;
	if (!(std::abs(r.response) <= largestResponse)) return;
	// v1 turns to its left by -T(v1, v2, .)/gap, and the density that turns with it multiplies that.
	const double k = (dot(r.gradient, leftNormal(r.v1)) + turn.slope) / (gap * (1 - r.response));
	r.df = {r.lambda1 * r.v1.x - k * r.third.x, r.lambda1 * r.v1.y - k * r.third.y};
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
	r.third = {tx, ty};
	r.df = {r.lambda1 * a.x + k * tx, r.lambda1 * a.y + k * ty};
	return r;
}

RidgePoint evaluateRidge(FieldPoint& point, Vec2 normal)
{
	SideWeights weights(normal);
	double before = 0;
	for (int i = 0;; i++)
	{
		RidgePoint r = makeRidgePoint(point.place(), point.sum(weights));
		if (!(r.occupancy > 0)) return r;
		if (dot(r.v1, normal) < 0)
		{
			r.v1 = -r.v1;
			r.v2 = -r.v2;
			r.f = -r.f;
			r.df = -r.df;
		}
		const double off = std::abs(cross(normal, r.v1));
		const SideWeights next(r.v1);
		const bool settled = off < goodNormal || next == weights;
		if (settled || i == mostNormals || (i > 1 && off > 0.8 * before))
		{
			addTurn(point.turn(r.v1), r);
			if (!settled && off > fairNormal) r.response = std::numeric_limits<double>::infinity();
			return r;
		}
		normal = r.v1;
		weights = next;
		before = off;
	}
}

RidgePoint evaluateRidge(const TileField& field, Vec2 p, Vec2 normal)
{
	if (!field.isSided()) return makeRidgePoint(p, field.sample(p));
	FieldPoint point(field, p);
	return evaluateRidge(point, normal);
}

double sensitivity(const RidgePoint& r)
{
	if (!(std::abs(r.response) <= largestResponse)) return std::numeric_limits<double>::infinity();
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
