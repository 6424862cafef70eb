// SPDX-License-Identifier: BSD-3-Clause
// The way of a ray over the cells of the free-space counters.
#pragma once

#include <ridgemap/options.h>
#include <ridgemap/types.h>

#include <algorithm>
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

/** A ray as a walk along its longer axis: the rows (columns, for rays that are steeper than 45 degrees) of cells in
 * which it enters and leaves every column. Positions come from one slope in units of 2^-32, so that each follows from
 * the one before by one addition; they lie below the true ones by less than a tenth of a quantum. A ray and its reverse
 * have the same walk. */
class RayWalk
{
 public:
	explicit RayWalk(const LatticeRay& ray);

	bool steep() const { return steep_; }
	/** Columns of the walk; for steep rays these are rows of cells. */
	std::int64_t firstColumn() const { return u0_ >> cellBits; }
	std::int64_t lastColumn() const { return u1_ >> cellBits; }
	/** +1 or -1: where the rows of later columns lie, if not in the same row. */
	std::int64_t rowStep() const { return slope_ < 0 ? -1 : 1; }
	/** The row in which the ray enters a column of the walk, or starts; that of its end for lastColumn() + 1. */
	std::int64_t rowAt(std::int64_t column) const { return row0_ + (position(column) >> rowBits); }

	/** Calls fn(column, row, leaving) for columns of the walk: the ray enters in `row` and leaves in `leaving`, which
	 * is the same or the next one by rowStep(). */
	template <class Fn>
	void forEachColumn(std::int64_t first, std::int64_t last, Fn fn) const
	{
		// Copies, because fn may write to memory that could be this object, as far as a compiler can tell.
		const std::int64_t row0 = row0_, end = rowAt(last + 1), perColumn = slope_ * LatticeRay::quantaPerCell;
		std::int64_t row = rowAt(first), next = position(first + 1);
		for (std::int64_t column = first; column < last; column++)
		{
			const std::int64_t leaving = row0 + (next >> rowBits);
			fn(column, row, leaving);
			row = leaving;
			next += perColumn;
		}
		fn(last, row, end);
	}

 private:
	static constexpr int cellBits = 13;
	static constexpr int fractionBits = 32;
	static constexpr int rowBits = cellBits + fractionBits;
	static_assert(LatticeRay::quantaPerCell == std::int64_t(1) << cellBits);

	/** Where the ray enters a column, in 2^-32 quanta above row0_. */
	std::int64_t position(std::int64_t column) const
	{
		const std::int64_t u = std::max(u0_, std::min(u1_, column * LatticeRay::quantaPerCell));
		return v0_ + (u - u0_) * slope_;
	}

	bool steep_;
	std::int64_t u0_, u1_;  ///< along the longer axis, u0 <= u1
	std::int64_t row0_;     ///< the row at u0
	std::int64_t v0_;       ///< at u0, in 2^-32 quanta above row0_
	std::int64_t slope_;    ///< in 2^-32, at most 1
};

/** Calls fn(cx, cy) once for all cells of the walk of a ray. */
template <class Fn>
void forEachCell(const LatticeRay& ray, Fn fn)
{
	const RayWalk walk(ray);
	const auto visit = [&](std::int64_t column, std::int64_t row) { walk.steep() ? fn(row, column) : fn(column, row); };
	walk.forEachColumn(walk.firstColumn(), walk.lastColumn(),
					   [&](std::int64_t column, std::int64_t row, std::int64_t leaving)
					   {
						   visit(column, row);
						   if (leaving != row) visit(column, leaving);
					   });
}

}  // namespace ridgemap
