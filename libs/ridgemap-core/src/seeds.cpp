// SPDX-License-Identifier: BSD-3-Clause
#include "seeds.h"

#include <algorithm>

namespace ridgemap
{
namespace
{
constexpr double tolerance = 1e-4;     ///< [sigma]
constexpr double longestStep = 0.4;    ///< [sigma]
constexpr double shortestClimb = 0.3;  ///< where the density does not lead to a ridge yet [sigma]
constexpr int maxIterations = 40;

/** The value with its size confined to [least, most]. */
double clamped(double value, double least, double most)
{
	const double size = std::max(least, std::min(most, std::abs(value)));
	return value < 0 ? -size : size;
}

Search judge(const RidgePoint& r, const Options& o)
{
	if (r.occupancy >= o.lTol && isRidgeLike(r, o)) return {Search::found, r};
	return {Search::noRidge, std::nullopt};
}

/** Uphill along v1 while the density is not yet attractive, Newton's method on f where it is. */
Search project(const TileField& field, const Options& options, Vec2 start, Vec2 side,
			   const std::function<bool(Vec2)>& known)
{
	Vec2 p = start, climbed;
	for (int i = 0; i < maxIterations; i++)
	{
		const RidgePoint r = evaluateRidge(field, p, side);
		side = r.v1;
		if (!(r.occupancy > 0)) return {Search::noRidge, std::nullopt};
		Vec2 move;
		if (r.lambda1 < -0.05 * r.occupancy)
		{
			const double slope = dot(r.df, r.v1);
			if (std::abs(r.f) < tolerance * std::min(norm(r.df), -r.lambda1)) return judge(r, options);
			move = clamped(-r.f / (slope < 0.2 * r.lambda1 ? slope : r.lambda1), 0, longestStep) * r.v1;
			climbed = {};
		}
		else
		{
			// The mean shift would creep where it is nearly flat.
			move = clamped(r.f / r.occupancy, shortestClimb, longestStep) * r.v1;
			if (dot(move, climbed) < 0) return {Search::noRidge, std::nullopt};  // back and forth on a plateau
			climbed = move;
		}
		p = p + move;
		if (!field.inDomain(p) || norm(p - start) > searchReach) return {};
		if (known(p)) return {Search::known, std::nullopt};
	}
	return {};
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

Search climb(const TileField& field, const Options& options, Vec2 start, Vec2 side,
			 const std::function<bool(Vec2)>& known)
{
	RidgePoint r = evaluateRidge(field, start, side);
	double radius = 0.5;
	for (int i = 0; i < maxIterations && radius > tolerance; i++)
	{
		const Vec2 step = trustRegionStep(r, radius);
		if (norm(step) < tolerance) return judge(r, options);
		if (!field.inDomain(r.p + step)) return {};
		if (known(r.p + step)) return {Search::known, std::nullopt};
		const RidgePoint next = evaluateRidge(field, r.p + step, r.v1);
		const double a = dot(step, r.v1), b = dot(step, r.v2);
		const double predicted = dot(r.gradient, step) + 0.5 * (r.lambda1 * a * a + r.lambda2 * b * b);
		const double ratio = predicted > 0 ? (next.occupancy - r.occupancy) / predicted : 0;
		radius = ratio < 0.25 ? 0.5 * radius : ratio > 0.75 ? std::min(1.0, 2 * radius) : radius;
		if (next.occupancy > r.occupancy) r = next;
	}
	return {};
}
}  // namespace

Search findRidge(const TileField& field, const Options& options, Vec2 start, Vec2 side,
				 const std::function<bool(Vec2)>& known)
{
	return options.seedRule == SeedRule::maximum ? climb(field, options, start, side, known)
												 : project(field, options, start, side, known);
}

}  // namespace ridgemap
