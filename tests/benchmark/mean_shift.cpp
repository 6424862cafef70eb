// SPDX-License-Identifier: BSD-3-Clause
#include "mean_shift.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace ridgemap::benchmarks
{
namespace
{
constexpr double cutoff = 5;  ///< [sigma]
constexpr int maxIterations = 500;

class MeanShift
{
 public:
	MeanShift(const std::vector<Measurement>& measurements, double sigma) : sigma_(sigma)
	{
		for (const Measurement& m : measurements)
			squares_[key(index(m.x), index(m.y))].push_back({m.x / sigma, m.y / sigma});
	}

	/** The step along v1 from a point [sigma]. */
	Point2 step(const Point2& p) const
	{
		double l = 0, mx = 0, my = 0, hxx = 0, hxy = 0, hyy = 0;
		const std::int64_t cx = index(p.x * sigma_), cy = index(p.y * sigma_);
		for (std::int64_t y = cy - 1; y <= cy + 1; y++)
			for (std::int64_t x = cx - 1; x <= cx + 1; x++)
			{
				const auto square = squares_.find(key(x, y));
				if (square == squares_.end()) continue;
				for (const Point2& q : square->second)
				{
					const double dx = q.x - p.x, dy = q.y - p.y, d2 = dx * dx + dy * dy;
					if (d2 > cutoff * cutoff) continue;
					const double w = std::exp(-0.5 * d2);
					l += w;
					mx += w * dx;
					my += w * dy;
					hxx += w * (dx * dx - 1);
					hxy += w * dx * dy;
					hyy += w * (dy * dy - 1);
				}
			}
		if (!(l > 0)) return {};
		const double angle = 0.5 * std::atan2(2 * hxy, hxx - hyy);  // of the larger eigenvalue
		const double vx = -std::sin(angle), vy = std::cos(angle), along = (mx * vx + my * vy) / l;
		return {along * vx, along * vy};
	}

 private:
	std::int64_t index(double v) const { return std::int64_t(std::floor(v / (cutoff * sigma_))); }
	static std::int64_t key(std::int64_t x, std::int64_t y) { return x * 1000003 + y; }

	double sigma_;
	std::unordered_map<std::int64_t, std::vector<Point2>> squares_;
};
}  // namespace

MeanShiftResult meanShift(const std::vector<Measurement>& measurements, double sigma, double tolerance)
{
	const MeanShift shift(measurements, sigma);
	MeanShiftResult result;
	for (const Measurement& m : measurements)
	{
		Point2 p{m.x / sigma, m.y / sigma};
		for (int i = 0; i < maxIterations; i++)
		{
			const Point2 d = shift.step(p);
			result.evaluations++;
			p = {p.x + d.x, p.y + d.y};
			if (std::hypot(d.x, d.y) * sigma >= tolerance) continue;
			result.points.push_back({p.x * sigma, p.y * sigma});
			break;
		}
	}
	return result;
}

}  // namespace ridgemap::benchmarks
