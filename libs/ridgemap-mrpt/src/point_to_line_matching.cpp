// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/point_to_line_matching.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace ridgemap
{
namespace
{
/** Scale and reach of the score that starts are compared by [m]. */
constexpr double scoreScale = 0.1, scoreReach = 0.5;
constexpr double smallestStep = 1e-6;
/** Below this distance the direction to the foot is rounding noise [m]. */
constexpr double smallestResidual = 1e-5;
/** Starts are compared by this number of points. */
constexpr std::size_t mostPointsOfStart = 120;
/** Keeps directions that no point speaks for as they are. */
constexpr double damping = 1e-4;

std::vector<Point2> loneMeasurements(const std::vector<Polyline>& polylines, const std::vector<Point2>& measurements,
									 const TargetSettings& settings)
{
	std::vector<Point2> lone;
	if (settings.loneDistance < 0) return lone;
	const PolylineIndex lines(polylines, settings.spacing);
	for (const auto& p : measurements)
		if (!lines.hasWithin(p, settings.loneDistance)) lone.push_back(p);
	return lone;
}

/** Weighted sums of the normal equations; the unknowns are x, y and rho * yaw. */
struct NormalEquations
{
	double weight = 0, rangeSqr = 0;
	std::array<double, 6> h{};  ///< xx xy yy xt yt tt, t not yet divided by rho
	std::array<double, 3> b{};

	/** One row: direction n, lever arm d, residual r. */
	void add(double nx, double ny, const Point2& d, double r, double w)
	{
		const double t = d.x * ny - d.y * nx;
		h[0] += w * nx * nx;
		h[1] += w * nx * ny;
		h[2] += w * ny * ny;
		h[3] += w * nx * t;
		h[4] += w * ny * t;
		h[5] += w * t * t;
		b[0] += w * nx * r;
		b[1] += w * ny * r;
		b[2] += w * t * r;
		weight += w;
		rangeSqr += w * (d.x * d.x + d.y * d.y);
	}

	/** -(H/sw + damping I)^-1 b/sw, yaw in radians. */
	PlanarPose solve() const
	{
		const double rho = std::max(std::sqrt(rangeSqr / weight), 1e-3), k = 1 / weight;
		const double a = k * h[0] + damping, c = k * h[1], d = k * h[2] + damping;
		const double e = k * h[3] / rho, f = k * h[4] / rho, g = k * h[5] / (rho * rho) + damping;
		const double u = k * b[0], v = k * b[1], w = k * b[2] / rho;
		const double ca = d * g - f * f, cc = e * f - c * g, ce = c * f - d * e;
		const double cd = a * g - e * e, cf = c * e - a * f, cg = a * d - c * c;
		const double det = a * ca + c * cc + e * ce;
		return {-(ca * u + cc * v + ce * w) / det, -(cc * u + cd * v + cf * w) / det,
				-(ce * u + cf * v + cg * w) / det / rho};
	}
};

/** One Gauss-Newton step from a pose; nothing if no point has a target. */
std::optional<PlanarPose> gaussNewtonStep(const MatchingTargets& targets, const std::vector<Point2>& points,
										  const PlanarPose& pose, const MatchingGate& gate, double scale, bool sides)
{
	NormalEquations sums;
	const double c = std::cos(pose.phi), s = std::sin(pose.phi);
	for (const auto& local : points)
	{
		const Point2 d{c * local.x - s * local.y, s * local.x + c * local.y}, p{pose.x + d.x, pose.y + d.y};
		const auto target =
			sides ? targets.nearestVisible(p, {pose.x, pose.y}, gate.at(p)) : targets.nearest(p, gate.at(p));
		if (!target) continue;
		const double r = std::sqrt(target->distanceSqr), q = 1 + target->distanceSqr / (scale * scale), w = 1 / (q * q);
		const double dx = p.x - target->point.x, dy = p.y - target->point.y;
		if (targets.isLone(*target))
		{
			sums.add(1, 0, d, dx, w);
			sums.add(0, 1, d, dy, w);
		}
		else if (r < smallestResidual)
		{
			const Point2 n = targets.normal(*target);
			sums.add(n.x, n.y, d, n.x * dx + n.y * dy, w);
		}
		else
			sums.add(dx / r, dy / r, d, r, w);
	}
	if (!(sums.weight > 0)) return std::nullopt;
	return sums.solve();
}

double scoreOf(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& pose, bool sides)
{
	double score = 0;
	for (const auto& p : points)
		if (const auto target = sides ? targets.nearestVisible(pose * p, {pose.x, pose.y}, scoreReach)
									  : targets.nearest(pose * p, scoreReach))
			score += 1 / (1 + target->distanceSqr / (scoreScale * scoreScale));
	return score;
}
/** Gauss-Newton with one scale of the weights, until a step is shorter than `enough` [m, rad]. */
Alignment descend(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& start,
				  const MatchingGate& gate, double scale, double enough, const TMatchingOptions& options)
{
	Alignment result;
	result.pose = start;
	while (result.steps < options.solverIterations && !result.converged)
	{
		result.steps++;
		const auto step = gaussNewtonStep(targets, points, result.pose, gate, scale, options.matchSides);
		if (!step) break;
		const double length = std::hypot(step->x, step->y);
		if (!std::isfinite(length + step->phi)) break;
		const double share = length > gate.distance ? gate.distance / length : 1;
		result.pose.x += share * step->x;
		result.pose.y += share * step->y;
		result.pose.phi += share * step->phi;
		result.converged = length < enough && std::abs(step->phi) < enough;
	}
	return result;
}

/** The same solution, found from two starts. */
bool agree(const PlanarPose& a, const PlanarPose& b)
{
	constexpr double distance = 0.02, angle = 0.005;
	return std::hypot(a.x - b.x, a.y - b.y) < distance && std::abs(a.phi - b.phi) < angle;
}

/** Every so many-th point that at most `most` remain. */
std::vector<Point2> thinned(const std::vector<Point2>& points, std::size_t most)
{
	const std::size_t step = std::max<std::size_t>(1, (points.size() + most - 1) / most);
	std::vector<Point2> few;
	for (std::size_t i = 0; i < points.size(); i += step) few.push_back(points[i]);
	return few;
}
}  // namespace

MatchingTargets::MatchingTargets(const std::vector<Polyline>& polylines, const std::vector<Point2>& measurements,
								 const TargetSettings& settings)
	: settings_(settings), index_(polylines, settings.spacing, loneMeasurements(polylines, measurements, settings))
{
}

Point2 MatchingTargets::normal(const Foot& target) const
{
	const Point2 u = index_.direction(target.segment);
	return {-u.y, u.x};
}

Point2 PlanarPose::operator*(const Point2& p) const
{
	const double c = std::cos(phi), s = std::sin(phi);
	return {x + c * p.x - s * p.y, y + s * p.x + c * p.y};
}

double MatchingGate::at(const Point2& p) const
{
	const double turned = angular > 0 ? angular * std::hypot(p.x - pivot.x, p.y - pivot.y) : 0;
	return std::min(distance + turned, greatest);
}

Alignment alignToLines(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& start,
					   const MatchingGate& gate, const TMatchingOptions& options)
{
	const double scale = std::max(options.robustLeast, options.robustShare * gate.distance);
	return descend(targets, points, start, gate, scale, smallestStep, options);
}

Alignment alignNarrowing(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& start,
						 MatchingGate gate, const TMatchingOptions& options)
{
	constexpr double narrower = 0.5, enough = 0.05;
	Alignment result;
	result.pose = start;
	unsigned steps = 0;
	gate.distance = std::min(gate.distance, gate.greatest);
	for (bool last = false; !last; gate.distance *= narrower, gate.angular *= narrower)
	{
		const double scale = std::max(options.robustLeast, options.robustShare * gate.distance);
		last = !(options.robustShare * gate.distance * narrower >= options.robustLeast);
		result = descend(targets, points, result.pose, gate, scale, enough * scale, options);
		steps += result.steps;
	}
	result.steps = steps;
	return result;
}

Alignment alignFromSeveralStarts(const MatchingTargets& targets, const std::vector<Point2>& points,
								 const PlanarPose& start, const MatchingGate& gate, const TMatchingOptions& options)
{
	constexpr double degree = 3.14159265358979323846 / 180;
	const std::vector<Point2> few = thinned(points, mostPointsOfStart);
	const auto scored = [&](const PlanarPose& from, const MatchingGate& first)
	{
		Alignment a = alignNarrowing(targets, few, from, first, options);
		a.score = scoreOf(targets, few, a.pose, options.matchSides);
		return a;
	};
	MatchingGate near = gate;
	if (gate.distance > options.nearGate)
	{
		near.distance = options.nearGate;
		near.angular *= near.distance / gate.distance;
	}
	Alignment best = scored(start, near);
	const Alignment wide = scored(start, gate);
	const bool sure = agree(best.pose, wide.pose) && best.score >= options.startShare * double(few.size());
	// A tie goes to the start that comes first: odometry is right more often than not.
	const auto compare = [&](const Alignment& next)
	{
		if (next.score > best.score * (1 + options.yawMargin)) best = next;
	};
	compare(wide);
	const int turns = sure || gate.distance < options.yawLeastGate ? 0 : int(options.yawStarts);
	for (int turn = 1; turn <= turns; turn++)
		for (const int sign : {1, -1})
			compare(scored({start.x, start.y, start.phi + sign * turn * options.yawStep * degree}, gate));
	const double score = best.score;
	best = descend(targets, points, best.pose, gate, options.robustLeast, smallestStep, options);
	best.score = score;
	return best;
}

bool AlignmentMemory::goesOn(const PlanarPose& start, double gate) const
{
	constexpr double rounding = 1e-4;  // MRPT keeps pairs in single precision
	const std::lock_guard<std::mutex> lock(mutex_);
	return gate <= gate_ && std::abs(start.x - end_.x) < rounding && std::abs(start.y - end_.y) < rounding &&
		   std::abs(std::remainder(start.phi - end_.phi, 6.283185307179586)) < rounding;
}

void AlignmentMemory::remember(const PlanarPose& end, double gate)
{
	const std::lock_guard<std::mutex> lock(mutex_);
	end_ = end;
	gate_ = gate;
}

}  // namespace ridgemap
