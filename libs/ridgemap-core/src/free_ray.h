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

/** Makes rays from a sensor to `margin` [sigma] before their ends. The measurements of a scan come from one place: what
 * follows from that alone is kept until it changes. */
class RayMaker
{
 public:
	RayMaker(const Frame& frame, double margin) : frame_(frame), margin_(margin) {}

	/** Nothing if the margin leaves no length or if the sensor is NaN: not known. Throws std::invalid_argument if an
	 * end lies beyond +-1e6 m. */
	std::optional<LatticeRay> make(const FreeRay& ray);

 private:
	Frame frame_;
	double margin_;
	double sensorX_ = 0, sensorY_ = 0;
	std::optional<Vec2> sensor_;  ///< in the lattice frame [sigma]; nothing: none yet
	LatticePoint from_;
};

/** A ray as a walk along its longer axis: the rows (columns, for rays that are steeper than 45 degrees) of cells in
 * which it enters and leaves every column. It enters a column in rowAt(column) and leaves it in rowAt(column + 1),
 * which is the same row or the next one by rowStep(): these are its cells. Positions come from one slope in units of
 * 2^-32; they lie below the true ones by less than a tenth of a quantum. A ray and its reverse have the same walk. */
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
	std::int64_t rowAt(std::int64_t column) const
	{
		const std::int64_t u = std::max(u0_, std::min(u1_, column * LatticeRay::quantaPerCell));
		return row0_ + ((v0_ + (u - u0_) * slope_) >> rowBits);
	}

	/** A walk over whole columns, from one to the next by an addition: the row changes where the sum overflows. */
	struct Fraction
	{
		std::uint64_t value = 0;      ///< of a row, in 2^-64, counted in the direction of rowStep()
		std::uint64_t perColumn = 0;  ///< at most a row
	};
	/** Where the ray enters a column behind its first one. */
	Fraction fractionAt(std::int64_t column) const
	{
		const std::uint64_t value = std::uint64_t(v0_ + (column * LatticeRay::quantaPerCell - u0_) * slope_)
									<< (64 - rowBits);
		const std::uint64_t slope = std::uint64_t(slope_ < 0 ? -slope_ : slope_);
		// 64 bits do not hold a whole row a column. With all bits set below those of a position, the largest number
		// they hold overflows every time as well, for the 2^19 columns to come, and nothing else does that did not.
		const std::uint64_t perColumn = slope >> fractionBits ? ~std::uint64_t(0) : slope << (64 - fractionBits);
		constexpr std::uint64_t below = (std::uint64_t(1) << (64 - rowBits)) - 1;
		return {slope_ < 0 ? ~value : value | below, perColumn};
	}
	/** The column behind the first one in which the ray leaves for rows from `row` on, by rowStep(); it must do so. */
	std::int64_t columnLeavingFor(std::int64_t row) const;

 private:
	static constexpr int cellBits = 13;
	static constexpr int fractionBits = 32;
	static constexpr int rowBits = cellBits + fractionBits;
	static_assert(LatticeRay::quantaPerCell == std::int64_t(1) << cellBits);

	bool steep_;
	std::int64_t u0_, u1_;  ///< along the longer axis, u0 <= u1
	std::int64_t row0_;     ///< the row at u0
	std::int64_t v0_;       ///< at u0, in 2^-32 quanta above row0_
	std::int64_t slope_;    ///< in 2^-32, at most 1
};

}  // namespace ridgemap
