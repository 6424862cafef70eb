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

/** Eigenvalues of the Hessian, lambda1 <= lambda2, and their unit eigenvectors. */
struct Axes
{
	double lambda1, lambda2;
	Vec2 v1, v2;

	/** By half-angle formulas. */
	explicit Axes(const KernelSums& s)
	{
		const double mean = 0.5 * (s.hxx + s.hyy), half = 0.5 * (s.hxx - s.hyy);
		const double radius = std::sqrt(half * half + s.hxy * s.hxy);
		lambda1 = mean - radius;
		lambda2 = mean + radius;
		v2 = {1, 0};
		if (const double c = half / radius; radius > 0)
		{
			const double larger = std::sqrt(0.5 * (1 + std::abs(c))), smaller = 0.5 * s.hxy / (radius * larger);
			v2 = c >= 0 ? Vec2{larger, smaller} : Vec2{smaller, larger};
		}
		v1 = leftNormal(v2);
	}

	/** Gives v1 the sense of `normal`. */
	void orient(Vec2 normal)
	{
		if (!(dot(v1, normal) < 0)) return;
		v1 = -v1;
		v2 = -v2;
	}
};

RidgePoint ridgePointOf(Vec2 p, const KernelSums& s, const Axes& axes)
{
	RidgePoint r;
	r.p = p;
	r.occupancy = s.value;
	r.gradient = {s.gx, s.gy};
	r.lambda1 = axes.lambda1;
	r.lambda2 = axes.lambda2;
	r.v1 = axes.v1;
	r.v2 = axes.v2;
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
	return ridgePointOf(p, s, Axes(s));
}

RidgePoint evaluateRidge(FieldPoint& point, Vec2 normal)
{
	SideWeights weights(normal);
	double before = 0;
	for (int i = 0;; i++)
	{
		const KernelSums sums = point.sum(weights);
		Axes axes(sums);
		if (!(sums.value > 0)) return ridgePointOf(point.place(), sums, axes);
		axes.orient(normal);
		const double off = std::abs(cross(normal, axes.v1));
		bool settled = off < goodNormal;
		if (!settled)
		{
			const SideWeights next(axes.v1);
			settled = next == weights;
			weights = next;
		}
		if (settled || i == mostNormals || (i > 1 && off > 0.8 * before))
		{
			RidgePoint r = ridgePointOf(point.place(), sums, axes);
			addTurn(point.turn(r.v1), r);
			if (!settled && off > fairNormal) r.response = std::numeric_limits<double>::infinity();
			return r;
		}
		normal = axes.v1;
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

bool isRidgeLike(const RidgePoint& r, const Options& o, double slack)
{
	return r.lambda1 < 0 && r.occupancy > 0 && sensitivity(r) <= slack * o.maxSensitivity;
}

}  // namespace ridgemap
