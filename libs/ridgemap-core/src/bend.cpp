// SPDX-License-Identifier: BSD-3-Clause
// Curvature correction. The ridge of a circle lies inside it, as more of the circle is on that side of any of its
// points; how far is known in closed form.
#include "bend.h"

#include <ridgemap/standard_error.h>

#include <cmath>

#include "runs.h"
#include "wall_path.h"
#include "walls.h"

namespace ridgemap
{
namespace
{
// Lengths in units of se = sqrt(sigma^2 + s^2), the width of the density across the wall.
constexpr double window = 2.5;       ///< to each side of a vertex whose circle is fitted
constexpr double spacing = 0.25;     ///< of the points of that fit
constexpr double largestRms = 0.12;  ///< of the points about their circle
constexpr double leastRadius = 0.9;  ///< of a ridge that can be corrected [sigma]
constexpr double significant = 4;    ///< a curvature below this many standard errors may be chance
constexpr double leastMove = 0.01;   ///< smaller corrections are left out [sigma]

/** Circle about the stretch of a path around s; nothing where there is none. */
std::optional<FittedCurve> circleAround(const Path& path, double s, double se)
{
	if (!path.has(s - window * se, s + window * se)) return std::nullopt;
	const int n = int(2 * window / spacing);
	std::vector<WallSample> samples;
	for (int i = 0; i <= n; i++) samples.push_back({path.at(s + window * se * (2.0 * i / n - 1)), 0, 1});
	const std::optional<FittedCurve> arc = fitArc({samples.data(), samples.data() + samples.size()});
	if (!arc) return std::nullopt;
	double square = 0;
	for (const WallSample& i : samples) square += arc->distance(i.p) * arc->distance(i.p) / (n + 1);
	if (square > largestRms * largestRms * se * se) return std::nullopt;
	return arc;
}
}  // namespace

double besselRatio(double z)
{
	// The continued fraction I1/I0 = z/(2 + z^2/(4 + z^2/(6 + ...))), from far enough below.
	const int depth = 20 + int(z < 400 ? z : 400);
	double tail = 0;
	if (z >= 400) return 1 - 0.5 / z - 0.125 / (z * z) - 0.125 / (z * z * z);
	for (int k = depth; k >= 1; k--) tail = z * z / (2 * k + tail);
	return tail / z;
}

double trueRadius(double ridgeRadius, double sigma)
{
	// R/r = I1/I0(R r/sigma^2), in units of sigma; r by Newton's method with a bracket.
	const double ridge = ridgeRadius / sigma;
	double low = ridge, high = ridge + 2, radius = ridge + 0.5 / (ridge + 0.5);
	for (int step = 0; step < 60; step++)
	{
		const double z = ridge * radius, ratio = besselRatio(z), excess = radius * ratio - ridge;
		// The ridge of a circle of this radius would lie farther out: the circle is smaller.
		(excess > 0 ? high : low) = radius;
		double next = radius - excess / (ratio + z * (1 - ratio / z - ratio * ratio));
		if (!(next > low && next < high)) next = 0.5 * (low + high);
		const double moved = std::abs(next - radius);
		radius = next;
		if (moved < 1e-13 * radius) break;
	}
	return sigma * radius;
}

double bendCorrection(const FittedCurve& arc, double sigma)
{
	const double radius = 1 / std::abs(arc.curvature);
	if (radius < leastRadius * sigma || radius > sigma / (2 * leastMove)) return 0;
	const double outward = trueRadius(radius, sigma) - radius;
	return arc.curvature > 0 ? -outward : outward;
}

FittedCurve unbent(const FittedCurve& arc, double sigma)
{
	const double move = bendCorrection(arc, sigma);
	FittedCurve surface = arc;
	surface.origin = arc.origin + move * leftNormal(arc.direction);
	surface.curvature = arc.curvature / (1 - arc.curvature * move);
	return surface;
}

Polyline correctBends(const Polyline& line, const Options& options)
{
	Polyline result = line;
	const Path path(line);
	const double se = densityWidth(line, options.sigma), noise = wallNoise(line, options.sigma).noise;
	for (std::size_t k = 0; k < line.points.size(); k++)
	{
		const VertexInfo& v = line.info[k];
		if (v.origin != VertexOrigin::ridge || v.shape != WallShape::curve) continue;
		const std::optional<FittedCurve> arc = circleAround(path, path.arc(k), se);
		if (!arc) continue;
		const double chance = samplesPerIndependent * arc->covariance[5] *
							  offsetVariance(std::max(1.0, double(v.occupancy)), noise, options.sigma);
		if (arc->curvature * arc->curvature <= significant * significant * chance) continue;
		const Vec2 p{line.points[k].x, line.points[k].y};
		const Vec2 q = p + bendCorrection(*arc, options.sigma) * arc->normal(p);
		result.points[k] = {q.x, q.y};
	}
	if (line.closed) result.points.back() = result.points.front();
	return result;
}

}  // namespace ridgemap
