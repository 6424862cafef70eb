// SPDX-License-Identifier: BSD-3-Clause
// The truth that the tests compare with: the continuous occupancy as a double-precision sum over the raw measurements,
// and its ridges, found without any part of the library's own field or tracer.
#pragma once

#include <ridgemap/types.h>

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "vec2.h"

namespace ridgemap::test
{
/** Sum of all kernels within 8 sigma with its derivatives, unit sigma. */
struct BruteSample
{
	double value = 0;
	Vec2 gradient;
	std::array<double, 3> hessian{};  ///< xx, xy, yy
	std::array<double, 4> third{};    ///< xxx, xxy, xyy, yyy
	std::array<double, 4> scale{};    ///< Sum w (1 + r^k): what errors of the k-th derivatives are measured by
};

/** A sample seen by the ridge criterion, equations (5)-(8). */
struct BruteRidgePoint
{
	double value = 0, lambda1 = 0, lambda2 = 0;
	Vec2 v1, v2;
	double f = 0;
	Vec2 df;
};

class Oracle
{
 public:
	Oracle(const std::vector<Measurement>& measurements, double sigma);

	/** Points of the oracle are in sigma, relative to the first measurement. */
	Vec2 toUnit(const Point2& p) const { return {(p.x - origin_.x) / sigma_, (p.y - origin_.y) / sigma_}; }
	Point2 toMap(Vec2 p) const { return {origin_.x + sigma_ * p.x, origin_.y + sigma_ * p.y}; }

	BruteSample sample(Vec2 p) const;
	BruteRidgePoint ridgePoint(Vec2 p) const;

	/** Distance to the nearest place of a true ridge (f = 0, lambda1 < 0), if there is one within `reach`. Exact for
	 * small distances; for larger ones an upper bound. */
	std::optional<double> distanceToRidge(Vec2 p, double reach) const;

	struct Foot
	{
		Vec2 p;
		double value = 0;
	};
	/** Moves a measurement along v1 onto its ridge (subspace-constrained mean shift, then Newton's method). */
	std::optional<Foot> project(Vec2 p) const;

 private:
	static std::int64_t key(std::int64_t cx, std::int64_t cy) { return cx * 0x100000000 + cy; }
	std::optional<Vec2> newtonAlongV1(Vec2 p, double reach) const;
	double slideToClosest(Vec2 p, Vec2 onRidge) const;
	std::optional<double> searchAround(Vec2 p, double reach) const;

	double sigma_;
	Point2 origin_;
	std::unordered_map<std::int64_t, std::vector<Vec2>> cells_;
};

}  // namespace ridgemap::test
