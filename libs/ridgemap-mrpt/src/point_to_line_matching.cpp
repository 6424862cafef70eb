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
	Alignment result;
	result.pose = start;
	const double scale = std::max(options.robustLeast, options.robustShare * gate.distance);
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
		result.converged = length < smallestStep && std::abs(step->phi) < smallestStep;
	}
	return result;
}

Alignment alignFromSeveralYaws(const MatchingTargets& targets, const std::vector<Point2>& points,
							   const PlanarPose& start, const MatchingGate& gate, const TMatchingOptions& options)
{
	constexpr double degree = 3.14159265358979323846 / 180;
	Alignment best;
	for (int turn = 0; turn <= int(2 * options.yawStarts); turn++)
	{
		PlanarPose turned = start;
		turned.phi += (turn % 2 ? 1 : -1) * ((turn + 1) / 2) * options.yawStep * degree;
		Alignment next = alignToLines(targets, points, turned, gate, options);
		next.score = scoreOf(targets, points, next.pose, options.matchSides);
		// A tie between turned starts goes to the smaller turn, which comes first.
		if (turn == 0 || next.score > best.score * (1 + options.yawMargin)) best = next;
	}
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
