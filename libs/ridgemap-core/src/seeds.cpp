// SPDX-License-Identifier: BSD-3-Clause
#include "seeds.h"

#include <algorithm>

namespace ridgemap
{
namespace
{
constexpr double reach = 3;         ///< farthest that a measurement is brought to a ridge [sigma]
constexpr double tolerance = 1e-4;  ///< [sigma]
constexpr int maxIterations = 40;

bool accepted(const RidgePoint& r, const Options& o)
{
	return r.occupancy >= o.lTol && isRidgeLike(r, o);
}

/** Mean shift along v1 while the density is not yet attractive, Newton's method on f where it is. */
std::optional<RidgePoint> project(const TileField& field, const Options& options, Vec2 start,
								  const std::function<bool(Vec2)>& known)
{
	Vec2 p = start;
	for (int i = 0; i < maxIterations; i++)
	{
		const RidgePoint r = makeRidgePoint(p, field.sample(p));
		if (!(r.occupancy > 0)) return std::nullopt;
		double step = r.f / r.occupancy;
		if (r.lambda1 < -0.05 * r.occupancy)
		{
			const double slope = dot(r.df, r.v1);
			step = -r.f / (slope < 0.2 * r.lambda1 ? slope : r.lambda1);
			if (std::abs(r.f) < tolerance * std::min(norm(r.df), -r.lambda1))
				return accepted(r, options) ? std::optional(r) : std::nullopt;
		}
		else if (std::abs(step) < tolerance)
			return std::nullopt;
		p = p + std::max(-0.4, std::min(0.4, step)) * r.v1;
		if (!field.inDomain(p) || norm(p - start) > reach || known(p)) return std::nullopt;
	}
	return std::nullopt;
}

/** Step of Newton's method for a maximum, confined to a radius: along each eigenvector to the extremum if L is concave
 * there, else uphill to the radius. */
Vec2 trustRegionStep(const RidgePoint& r, double radius)
{
	const auto along = [&](Vec2 v, double lambda)
	{
		const double g = dot(r.gradient, v);
		if (lambda < 0) return std::max(-radius, std::min(radius, -g / lambda));
		return g > 0 ? radius : g < 0 ? -radius : 0.0;
	};
	Vec2 step = along(r.v1, r.lambda1) * r.v1 + along(r.v2, r.lambda2) * r.v2;
	const double length = norm(step);
	return length > radius ? (radius / length) * step : step;
}

std::optional<RidgePoint> climb(const TileField& field, const Options& options, Vec2 start,
								const std::function<bool(Vec2)>& known)
{
	RidgePoint r = makeRidgePoint(start, field.sample(start));
	double radius = 0.5;
	for (int i = 0; i < maxIterations && radius > tolerance; i++)
	{
		const Vec2 step = trustRegionStep(r, radius);
		if (norm(step) < tolerance) return accepted(r, options) ? std::optional(r) : std::nullopt;
		if (!field.inDomain(r.p + step) || known(r.p + step)) return std::nullopt;
		const RidgePoint next = makeRidgePoint(r.p + step, field.sample(r.p + step));
		const double a = dot(step, r.v1), b = dot(step, r.v2);
		const double predicted = dot(r.gradient, step) + 0.5 * (r.lambda1 * a * a + r.lambda2 * b * b);
		const double ratio = predicted > 0 ? (next.occupancy - r.occupancy) / predicted : 0;
		radius = ratio < 0.25 ? 0.5 * radius : ratio > 0.75 ? std::min(1.0, 2 * radius) : radius;
		if (next.occupancy > r.occupancy) r = next;
	}
	return std::nullopt;
}
}  // namespace

std::optional<RidgePoint> findRidge(const TileField& field, const Options& options, Vec2 start,
									const std::function<bool(Vec2)>& known)
{
	return options.seedRule == SeedRule::maximum ? climb(field, options, start, known)
												 : project(field, options, start, known);
}

}  // namespace ridgemap
