// SPDX-License-Identifier: BSD-3-Clause
// Lines and circular arcs fitted to samples of a wall, by weighted least squares of the distances.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "vec2.h"

namespace ridgemap
{
/** A place on a wall, with how far chance may have moved it across the wall. */
struct WallSample
{
	Vec2 p;
	double arc = 0;       ///< arc length along the wall [m]
	double variance = 1;  ///< of the place across the wall [m^2]
};

/** Samples [first, last) of a wall. */
struct SampleRange
{
	const WallSample* first = nullptr;
	const WallSample* last = nullptr;

	std::size_t size() const { return std::size_t(last - first); }
};

/** A line (curvature 0) or a circular arc: the curve through `origin` in `direction`, bending to the left by
 * `curvature` [1/m], with the covariance of its offset, turn and curvature at the origin. */
struct FittedCurve
{
	Vec2 origin, direction;
	double curvature = 0;
	/** Of (offset to the left, turn, curvature), for independent samples: 11, 12, 13, 22, 23, 33. */
	std::array<double, 6> covariance{};

	/** Signed distance of a point, positive to the left. */
	double distance(Vec2 q) const;
	/** Nearest point of the curve, continued beyond the samples. */
	Vec2 project(Vec2 q) const;
	/** Unit normal to the left at the foot of a point. */
	Vec2 normal(Vec2 q) const;
	/** Centre of the circle; only with a curvature. */
	Vec2 centre() const { return origin + (1 / curvature) * leftNormal(direction); }
	/** Variance of the place of the curve across it near a point, for independent samples [m^2]. */
	double variance(Vec2 q) const;
};

/** Line through at least two samples. */
FittedCurve fitStraight(const SampleRange& samples);

/** Arc through at least three samples; nothing where they do not determine one. */
std::optional<FittedCurve> fitArc(const SampleRange& samples);

/** The arc next to a line that was fitted to the samples: one step of fitArc() from there, which tells whether the
 * samples bend. */
std::optional<FittedCurve> bendOf(const FittedCurve& line, const SampleRange& samples);

/** Where two curves cross near a place; nothing if they do not within `reach` of it. */
std::optional<Vec2> intersection(const FittedCurve& a, const FittedCurve& b, Vec2 near, double reach);

}  // namespace ridgemap
