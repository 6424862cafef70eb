// SPDX-License-Identifier: BSD-3-Clause
#include "oracle.h"

#include <algorithm>
#include <cmath>

namespace ridgemap::test
{
namespace
{
constexpr double cellEdge = 4, kernelReach = 8;
constexpr double rootTolerance = 1e-7;   ///< |f / lambda1| on a ridge [sigma]
constexpr double leastCurvature = 1e-7;  ///< -lambda1 / L above which a place counts as curved

bool curved(const BruteRidgePoint& r)
{
	return r.value > 0 && r.lambda1 < -leastCurvature * r.value;
}
bool onRidge(const BruteRidgePoint& r)
{
	return curved(r) && std::abs(r.f) <= rootTolerance * -r.lambda1;
}
}  // namespace

Oracle::Oracle(const std::vector<Measurement>& measurements, double sigma) : sigma_(sigma)
{
	if (!measurements.empty()) origin_ = {measurements[0].x, measurements[0].y};
	for (const Measurement& m : measurements)
	{
		const Vec2 p = toUnit({m.x, m.y});
		cells_[key(std::int64_t(std::floor(p.x / cellEdge)), std::int64_t(std::floor(p.y / cellEdge)))].push_back(p);
	}
}

BruteSample Oracle::sample(Vec2 p) const
{
	BruteSample s;
	const auto index = [](double v) { return std::int64_t(std::floor(v / cellEdge)); };
	for (std::int64_t cy = index(p.y - kernelReach); cy <= index(p.y + kernelReach); cy++)
		for (std::int64_t cx = index(p.x - kernelReach); cx <= index(p.x + kernelReach); cx++)
		{
			const auto cell = cells_.find(key(cx, cy));
			if (cell == cells_.end()) continue;
			for (const Vec2& mu : cell->second)
			{
				const Vec2 d = p - mu;
				const double r2 = dot(d, d), r = std::sqrt(r2), w = std::exp(-0.5 * r2);
				s.value += w;
				s.gradient = s.gradient - w * d;
				s.hessian[0] += w * (d.x * d.x - 1);
				s.hessian[1] += w * d.x * d.y;
				s.hessian[2] += w * (d.y * d.y - 1);
				s.third[0] += w * d.x * (3 - d.x * d.x);
				s.third[1] += w * d.y * (1 - d.x * d.x);
				s.third[2] += w * d.x * (1 - d.y * d.y);
				s.third[3] += w * d.y * (3 - d.y * d.y);
				s.scale[0] += 2 * w;
				s.scale[1] += w * (1 + r);
				s.scale[2] += w * (1 + r2);
				s.scale[3] += w * (1 + r2 * r);
			}
		}
	return s;
}

BruteRidgePoint Oracle::ridgePoint(Vec2 p) const
{
	const BruteSample s = sample(p);
	BruteRidgePoint r;
	r.value = s.value;
	const auto [xx, xy, yy] = s.hessian;
	const double angle = 0.5 * std::atan2(2 * xy, xx - yy), spread = std::hypot(0.5 * (xx - yy), xy);
	r.v2 = {std::cos(angle), std::sin(angle)};
	r.v1 = leftNormal(r.v2);
	r.lambda1 = 0.5 * (xx + yy) - spread;
	r.lambda2 = 0.5 * (xx + yy) + spread;
	r.f = dot(s.gradient, r.v1);
	// First-order perturbation of v1: its change along axis k is v2 <v2, (d_k H) v1> / (lambda1 - lambda2).
	const auto mixed = [&](double kxx, double kxy, double kyy)
	{ return r.v2.x * (kxx * r.v1.x + kxy * r.v1.y) + r.v2.y * (kxy * r.v1.x + kyy * r.v1.y); };
	const double turn = spread > 0 ? dot(s.gradient, r.v2) / (-2 * spread) : 0;
	r.df = {r.lambda1 * r.v1.x + turn * mixed(s.third[0], s.third[1], s.third[2]),
			r.lambda1 * r.v1.y + turn * mixed(s.third[1], s.third[2], s.third[3])};
	return r;
}

std::optional<Vec2> Oracle::newtonAlongV1(Vec2 p, double reach) const
{
	Vec2 x = p;
	for (int i = 0; i < 40; i++)
	{
		const BruteRidgePoint r = ridgePoint(x);
		if (!curved(r)) return std::nullopt;
		if (onRidge(r)) return x;
		double slope = dot(r.df, r.v1);
		if (slope > 0.1 * r.lambda1) slope = r.lambda1;
		x = x + std::clamp(-r.f / slope, -0.3, 0.3) * r.v1;
		if (norm(x - p) > reach) return std::nullopt;
	}
	return std::nullopt;
}

/** Distance from p to the ridge near a point of it: alternately to the foot of p on the tangent and back to f = 0. */
double Oracle::slideToClosest(Vec2 p, Vec2 x) const
{
	double best = norm(x - p);
	for (int i = 0; i < 8; i++)
	{
		const Vec2 normal = unit(ridgePoint(x).df);
		Vec2 y = p - dot(p - x, normal) * normal;
		if (norm(y - x) > 0.3) y = x + (0.3 / norm(y - x)) * (y - x);
		bool found = false;
		for (int k = 0; k < 8 && !found; k++)
		{
			const BruteRidgePoint r = ridgePoint(y);
			found = onRidge(r);
			const double slope = dot(r.df, r.df);
			if (found || !(slope > 0)) break;
			y = y - std::clamp(r.f / std::sqrt(slope), -0.2, 0.2) * unit(r.df);
		}
		const double distance = norm(y - p);
		if (!found || distance > best - 1e-7) break;
		best = distance;
		x = y;
	}
	return best;
}

/** Looks along 16 directions for the first change of sign of f, with v1 followed continuously, and closes in on it. */
std::optional<double> Oracle::searchAround(Vec2 p, double reach) const
{
	std::optional<double> best;
	const BruteRidgePoint centre = ridgePoint(p);
	constexpr double step = 0.05;
	for (int k = 0; k < 16; k++)
	{
		const double angle = 3.14159265358979323846 * k / 8;
		const Vec2 direction{std::cos(angle), std::sin(angle)};
		BruteRidgePoint a = centre;
		double from = 0;
		for (double to = step; to <= std::min(reach, best.value_or(reach)) + step; to += step)
		{
			BruteRidgePoint b = ridgePoint(p + to * direction);
			const double aligned = dot(a.v1, b.v1);
			if (std::abs(aligned) < 0.7) break;
			if (aligned < 0) b.v1 = -b.v1, b.f = -b.f;
			if ((a.f < 0) != (b.f < 0))
			{
				double low = from, high = to;
				for (int i = 0; i < 50; i++)
				{
					const double middle = 0.5 * (low + high);
					const BruteRidgePoint m = ridgePoint(p + middle * direction);
					const double f = dot(m.v1, a.v1) < 0 ? -m.f : m.f;
					((f < 0) == (a.f < 0) ? low : high) = middle;
				}
				const Vec2 root = p + high * direction;
				if (curved(ridgePoint(root)))
				{
					const double distance = slideToClosest(p, root);
					if (distance <= reach && distance < best.value_or(reach + 1)) best = distance;
					break;
				}
			}
			a = b;
			from = to;
		}
	}
	return best;
}

std::optional<double> Oracle::distanceToRidge(Vec2 p, double reach) const
{
	constexpr double surelyNearest = 0.01;
	std::optional<double> best;
	if (const auto root = newtonAlongV1(p, reach)) best = slideToClosest(p, *root);
	if (best && *best < surelyNearest) return best;
	const auto around = searchAround(p, best.value_or(reach));
	if (around && (!best || *around < *best)) best = around;
	return best;
}

std::optional<Oracle::Foot> Oracle::project(Vec2 p) const
{
	Vec2 x = p;
	for (int i = 0; i < 300; i++)
	{
		const BruteRidgePoint r = ridgePoint(x);
		if (!(r.value > 0)) return std::nullopt;
		if (onRidge(r)) return Foot{x, r.value};
		double step = r.f / r.value;  // mean shift
		if (r.lambda1 < -0.05 * r.value && std::abs(step) < 0.1)
		{
			const double slope = dot(r.df, r.v1);
			step = -r.f / (slope < 0.2 * r.lambda1 ? slope : r.lambda1);
		}
		x = x + std::clamp(step, -0.3, 0.3) * r.v1;
		if (norm(x - p) > 5) return std::nullopt;
	}
	return std::nullopt;
}

}  // namespace ridgemap::test
