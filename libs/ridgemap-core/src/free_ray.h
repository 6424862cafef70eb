// SPDX-License-Identifier: BSD-3-Clause
// The way of a ray over the cells of the free-space counters.
#pragma once

#include <ridgemap/options.h>
#include <ridgemap/types.h>

#include <cstdint>
#include <optional>

#include "frame.h"

namespace ridgemap
{
/** A ray on the lattice, in quanta of sigma/4096, and twice its direction in 128ths. */
struct LatticeRay
{
	static constexpr std::int64_t quantaPerSigma = 4096;
	static constexpr std::int64_t cellSigmas = 2;  ///< edge of a cell of the counters [sigma]
	static constexpr std::int64_t quantaPerCell = cellSigmas * quantaPerSigma;
	static constexpr std::int32_t directionScale = 128;

	LatticePoint from, to;
	std::int32_t a = 0;  ///< round(128 cos 2 phi), phi the angle of the ray
	std::int32_t b = 0;  ///< round(128 sin 2 phi)
};

/** The ray from a sensor to `margin` [sigma] before its end; nothing if that leaves no length. The sensor is NaN: not
 * known, no ray. Throws std::invalid_argument if an end lies beyond +-1e6 m. */
std::optional<LatticeRay> makeRay(const Frame& frame, const FreeRay& ray, double margin);

/** Where a ray is along one axis. */
class RayAxis
{
 public:
	RayAxis(std::int64_t from, std::int64_t to)
		: step(to > from   ? 1
			   : to < from ? -1
						   : 0),
		  length(to > from ? to - from : from - to)
	{
		// A ray that starts on a border belongs to the cell that it goes into.
		cell = floorDiv(step < 0 ? from - 1 : from, LatticeRay::quantaPerCell);
		toBorder = step > 0 ? (cell + 1) * LatticeRay::quantaPerCell - from : from - cell * LatticeRay::quantaPerCell;
		crossings = toBorder < length ? (length - 1 - toBorder) / LatticeRay::quantaPerCell + 1 : 0;
	}

	std::int64_t step, length;
	std::int64_t cell;       ///< present cell
	std::int64_t toBorder;   ///< from the start to the first border
	std::int64_t crossings;  ///< borders between start and end
};

/** Calls fn(cx, cy) for all cells that share a stretch of more than a point with the ray, in order. Exact: the borders
 * crossed are ordered by comparing products of integers. A ray through a corner goes from cell to cell diagonally. */
template <class Fn>
void forEachCell(const LatticeRay& ray, Fn fn)
{
	RayAxis x(ray.from.u, ray.to.u), y(ray.from.v, ray.to.v);
	fn(x.cell, y.cell);
	// Positive: the next border is one of y; zero: a corner.
	std::int64_t order = x.toBorder * y.length - y.toBorder * x.length;
	if (x.length == 0) order = 1;
	if (y.length == 0) order = -1;
	const std::int64_t perX = LatticeRay::quantaPerCell * y.length, perY = LatticeRay::quantaPerCell * x.length;
	for (std::int64_t left = x.crossings + y.crossings; left > 0;)
	{
		// Without branches, which could not be predicted: all bits set where the ray steps.
		const std::int64_t goX = -std::int64_t(order <= 0), goY = -std::int64_t(order >= 0);
		x.cell += x.step & goX;
		y.cell += y.step & goY;
		order += (perX & goX) - (perY & goY);
		left += goX + goY;
		fn(x.cell, y.cell);
	}
}

}  // namespace ridgemap
