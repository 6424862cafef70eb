// SPDX-License-Identifier: BSD-3-Clause
#include "point_to_line_solver.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ridgemap
{
namespace
{
/** Scale and reach of the score of a pose [m]; a smaller scale, for what doors and corners tell apart. */
constexpr double scoreScale = 0.1, fineScale = 0.05, scoreReach = 0.5;
/** Below this distance the direction to the foot is rounding noise [m]. */
constexpr double smallestResidual = 1e-5;
/** Keeps directions that no point speaks for as they are. */
constexpr double damping = 1e-4;

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

	/** The direction of travel that the rows say least about, unit length. */
	Point2 weakest() const
	{
		const double half = 0.5 * (h[0] - h[2]), radius = std::hypot(half, h[1]);
		const Point2 d = half >= 0 ? Point2{-h[1], half + radius} : Point2{radius - half, -h[1]};
		const double length = std::hypot(d.x, d.y);
		return length > 0 ? Point2{d.x / length, d.y / length} : Point2{1, 0};
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

/** The rows of all points that have a target. */
NormalEquations equationsAt(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& pose,
							const MatchingGate& gate, double scale, bool sides)
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
	return sums;
}
}  // namespace

Fit::Fit(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& pose, bool sides)
{
	terms.reserve(points.size());
	for (const auto& p : points)
	{
		const auto target = sides ? targets.nearestVisible(pose * p, {pose.x, pose.y}, scoreReach)
								  : targets.nearest(pose * p, scoreReach);
		terms.push_back(target ? 1 / (1 + target->distanceSqr / (fineScale * fineScale)) : 0);
		if (target) score += 1 / (1 + target->distanceSqr / (scoreScale * scoreScale));
	}
}

double Fit::relativeTo(const Fit& o) const
{
	double ours = 0, theirs = 0;
	std::size_t common = 0, least = 0;
	for (std::size_t i = 0; i < terms.size(); i++)
	{
		least += o.terms[i] > 0;
		if (!(terms[i] > 0 && o.terms[i] > 0)) continue;
		common++;
		ours += terms[i];
		theirs += o.terms[i];
	}
	return common > 0 && 2 * common >= least ? ours / theirs : -1;
}

Alignment descend(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& start,
				  const MatchingGate& gate, double scale, double enough, const TMatchingOptions& options)
{
	Alignment result;
	result.pose = start;
	while (result.steps < options.solverIterations && !result.converged)
	{
		result.steps++;
		const auto sums = equationsAt(targets, points, result.pose, gate, scale, options.matchSides);
		if (!(sums.weight > 0)) break;
		const PlanarPose step = sums.solve();
		const double length = std::hypot(step.x, step.y);
		if (!std::isfinite(length + step.phi)) break;
		const double share = length > gate.distance ? gate.distance / length : 1;
		result.pose.x += share * step.x;
		result.pose.y += share * step.y;
		result.pose.phi += share * step.phi;
		result.converged = length < enough && std::abs(step.phi) < enough;
	}
	return result;
}

Point2 weakestDirection(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& pose,
						const MatchingGate& gate, double scale, bool sides)
{
	return equationsAt(targets, points, pose, gate, scale, sides).weakest();
}

}  // namespace ridgemap
