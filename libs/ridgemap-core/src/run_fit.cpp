// SPDX-License-Identifier: BSD-3-Clause
#include "run_fit.h"

#include <cmath>

namespace ridgemap
{
namespace
{
constexpr int newtonSteps = 3;
constexpr int crossingSteps = 5;

using Matrix3 = std::array<double, 6>;  // symmetric: 11, 12, 13, 22, 23, 33

/** Inverse of a symmetric matrix; nothing if it is singular as far as doubles can tell. */
std::optional<Matrix3> inverse(const Matrix3& m)
{
	const double c11 = m[3] * m[5] - m[4] * m[4], c12 = m[2] * m[4] - m[1] * m[5], c13 = m[1] * m[4] - m[2] * m[3];
	const double det = m[0] * c11 + m[1] * c12 + m[2] * c13;
	if (!(det > 1e-14 * m[0] * m[3] * m[5])) return std::nullopt;
	const double s = 1 / det;
	return Matrix3{s * c11,
				   s * c12,
				   s * c13,
				   s * (m[0] * m[5] - m[2] * m[2]),
				   s * (m[1] * m[2] - m[0] * m[4]),
				   s * (m[0] * m[3] - m[1] * m[1])};
}

std::array<double, 3> times(const Matrix3& m, const std::array<double, 3>& v)
{
	return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[1] * v[0] + m[3] * v[1] + m[4] * v[2],
			m[2] * v[0] + m[4] * v[1] + m[5] * v[2]};
}

/** How the distance of a sample answers to a shift, a turn and a bend of the curve, all at its origin. */
std::array<double, 3> jacobian(const FittedCurve& c, Vec2 q)
{
	const Vec2 d = q - c.origin, n = leftNormal(c.direction);
	const double u = dot(d, c.direction), v = dot(d, n), distance = c.distance(q);
	const double s = 1 - c.curvature * distance;  // distance to the centre over the radius
	return {(c.curvature * v - 1) / s, -u / s, 0.5 * (distance * distance - u * u - v * v) / s};
}

/** The circle x^2 + y^2 + b x + c y + d = 0 that fits algebraically: a first guess. */
std::optional<FittedCurve> algebraicArc(const SampleRange& samples)
{
	const FittedCurve line = fitStraight(samples);
	const double scale = norm((samples.last - 1)->p - samples.first->p) + 1e-3;
	Matrix3 m{};
	std::array<double, 3> r{};
	for (const WallSample* i = samples.first; i != samples.last; i++)
	{
		const Vec2 q = (1 / scale) * (i->p - line.origin);
		const double w = 1 / i->variance, z = dot(q, q);
		m[0] += w * q.x * q.x;
		m[1] += w * q.x * q.y;
		m[2] += w * q.x;
		m[3] += w * q.y * q.y;
		m[4] += w * q.y;
		m[5] += w;
		r[0] -= w * q.x * z;
		r[1] -= w * q.y * z;
		r[2] -= w * z;
	}
	const std::optional<Matrix3> inverted = inverse(m);
	if (!inverted) return std::nullopt;
	const std::array<double, 3> s = times(*inverted, r);
	const Vec2 centre{-0.5 * s[0], -0.5 * s[1]};
	const double square = dot(centre, centre) - s[2];
	if (!(square > 0)) return std::nullopt;
	const Vec2 middle = (1 / scale) * ((samples.first + samples.size() / 2)->p - line.origin);
	const Vec2 inward = unit(centre - middle);
	const double radius = std::sqrt(square);
	FittedCurve arc;
	arc.origin = line.origin + scale * (centre - radius * inward);
	arc.direction = {inward.y, -inward.x};
	arc.curvature = 1 / (scale * radius);
	const Vec2 next = (samples.first + samples.size() / 2 + 1)->p, before = (samples.first + samples.size() / 2 - 1)->p;
	if (dot(arc.direction, next - before) < 0)
	{
		arc.direction = -arc.direction;
		arc.curvature = -arc.curvature;
	}
	return arc;
}

/** Normal equations of a curve; returns their right-hand side, too. */
Matrix3 normalEquations(const FittedCurve& curve, const SampleRange& samples, std::array<double, 3>& right)
{
	Matrix3 m{};
	right = {};
	for (const WallSample* i = samples.first; i != samples.last; i++)
	{
		const double w = 1 / i->variance, d = curve.distance(i->p);
		const std::array<double, 3> j = jacobian(curve, i->p);
		m[0] += w * j[0] * j[0];
		m[1] += w * j[0] * j[1];
		m[2] += w * j[0] * j[2];
		m[3] += w * j[1] * j[1];
		m[4] += w * j[1] * j[2];
		m[5] += w * j[2] * j[2];
		for (std::size_t k = 0; k < 3; k++) right[k] -= w * j[k] * d;
	}
	return m;
}
}  // namespace

// With f = v - k (u^2 + v^2)/2 the signed distance d to a circle of curvature k solves d - k d^2/2 = f; the form below
// holds for lines as well.
double FittedCurve::distance(Vec2 q) const
{
	const Vec2 d = q - origin;
	const double f = dot(d, leftNormal(direction)) - 0.5 * curvature * dot(d, d);
	const double root = 1 - 2 * curvature * f;
	return 2 * f / (1 + std::sqrt(root > 0 ? root : 0));
}

Vec2 FittedCurve::normal(Vec2 q) const
{
	const Vec2 n = leftNormal(direction);
	if (curvature == 0) return n;
	// From the foot towards the centre when it lies to the left, away from it else.
	const Vec2 inward = n - curvature * (q - origin);
	return unit(inward);
}

Vec2 FittedCurve::project(Vec2 q) const
{
	return q - distance(q) * normal(q);
}

double FittedCurve::variance(Vec2 q) const
{
	const std::array<double, 3> j = jacobian(*this, project(q)), c = times(covariance, j);
	return j[0] * c[0] + j[1] * c[1] + j[2] * c[2];
}

FittedCurve fitStraight(const SampleRange& samples)
{
	double w = 0;
	Vec2 mean;
	for (const WallSample* i = samples.first; i != samples.last; i++)
	{
		w += 1 / i->variance;
		mean = mean + (1 / i->variance) * (i->p - samples.first->p);
	}
	mean = samples.first->p + (1 / w) * mean;
	double xx = 0, xy = 0, yy = 0;
	for (const WallSample* i = samples.first; i != samples.last; i++)
	{
		const Vec2 d = i->p - mean;
		xx += d.x * d.x / i->variance;
		xy += d.x * d.y / i->variance;
		yy += d.y * d.y / i->variance;
	}
	const double half = 0.5 * (xx - yy), radius = std::sqrt(half * half + xy * xy);
	FittedCurve line;
	line.origin = mean;
	// The eigenvector of the larger eigenvalue, from whichever row is safer.
	line.direction = half >= 0 ? unit({half + radius, xy}) : unit({xy, radius - half});
	if (dot(line.direction, (samples.last - 1)->p - samples.first->p) < 0) line.direction = -line.direction;
	const double along = 0.5 * (xx + yy) + radius;
	line.covariance = {1 / w, 0, 0, along > 0 ? 1 / along : 0, 0, 0};
	return line;
}

std::optional<FittedCurve> bendOf(const FittedCurve& line, const SampleRange& samples)
{
	std::array<double, 3> right;
	const std::optional<Matrix3> inverted = inverse(normalEquations(line, samples, right));
	if (!inverted) return std::nullopt;
	const std::array<double, 3> change = times(*inverted, right);
	const Vec2 n = leftNormal(line.direction);
	FittedCurve curve;
	curve.origin = line.origin + change[0] * n;
	curve.direction = unit(line.direction + change[1] * n);
	curve.curvature = line.curvature + change[2];
	curve.covariance = *inverted;
	return curve;
}

std::optional<FittedCurve> fitArc(const SampleRange& samples)
{
	if (samples.size() < 4) return std::nullopt;
	const std::optional<FittedCurve> start = algebraicArc(samples);
	std::optional<FittedCurve> curve = start ? *start : fitStraight(samples);
	for (int step = 0; curve && step < newtonSteps; step++) curve = bendOf(*curve, samples);
	return curve;
}

std::optional<Vec2> intersection(const FittedCurve& a, const FittedCurve& b, Vec2 near, double reach)
{
	Vec2 p = near;
	for (int step = 0; step < crossingSteps; step++)
	{
		const Vec2 na = a.normal(p), nb = b.normal(p);
		const double sine = cross(na, nb), da = a.distance(p), db = b.distance(p);
		if (!(std::abs(sine) > 0.05)) return std::nullopt;
		// p + x na + y nb with both distances 0.
		const double c = dot(na, nb), s2 = 1 - c * c;
		const double x = (-da + c * db) / s2, y = (-db + c * da) / s2;
		p = p + (x * na + y * nb);
		if (!(norm(p - near) <= reach)) return std::nullopt;
	}
	return p;
}

}  // namespace ridgemap
