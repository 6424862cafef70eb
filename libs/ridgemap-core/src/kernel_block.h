// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/options.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "frame.h"

namespace ridgemap
{
/** Exact sums over the measurements of one cell. Offsets from the cell centre in quanta; products of offsets divided by
 * 16 first, so that 2^31 measurements fit. */
struct CellSums
{
	static constexpr std::int64_t momentShift = 16;  ///< offsets are divided by this before they are multiplied

	std::uint32_t n = 0;
	std::int64_t sx = 0, sy = 0;
	std::int64_t sxx = 0, sxy = 0, syy = 0;

	bool operator==(const CellSums& o) const
	{
		return n == o.n && sx == o.sx && sy == o.sy && sxx == o.sxx && sxy == o.sxy && syy == o.syy;
	}
};

/** Address of a cell inside its block: direction bin, row, column. Its order is the canonical order of summation. */
using CellKey = std::uint64_t;

struct Cell
{
	CellKey key = 0;
	CellSums sums;
};

/** How cells lie in the lattice: edge in quanta (a power of two; 1 keeps every measurement apart). */
class CellGrid
{
 public:
	explicit CellGrid(const Options& o)
		: edge_(o.cell > 0 ? std::int64_t(o.cell * double(Frame::quantaPerSigma)) : 1),
		  mergeTolerance_(0.8e-3 * std::min(0.02, o.effectiveEps() / o.sigma) *
						  std::min(1.0, 64 * o.cell * o.cell * o.cell))
	{
	}

	std::int64_t edge() const { return edge_; }
	/** Largest error of a kernel that stands for several cells, as a share of all kernels of its block. */
	double mergeTolerance() const { return mergeTolerance_; }
	/** Half the extent of a cell [sigma]: how far a measurement may lie from the place of its kernel. */
	double halfExtent() const { return edge_ > 1 ? 0.5 * double(edge_) / double(Frame::quantaPerSigma) : 0; }
	std::int64_t cellsPerBlock() const { return Frame::quantaPerBlock / edge_; }
	std::int64_t index(std::int64_t quanta) const { return floorDiv(quanta, edge_); }
	/** Centre of a cell in quanta, as measured from the lattice origin. */
	std::int64_t centre(std::int64_t index) const { return index * edge_ + edge_ / 2; }

	/** Sums of a single measurement in its cell. */
	CellSums single(const LatticePoint& p) const;

	/** Throws std::invalid_argument if no set of measurements in one cell can have these sums. */
	void checkPossible(const CellSums& s) const;

 private:
	std::int64_t edge_;
	double mergeTolerance_;
};

/** Eight kernels side by side, one SIMD lane each: place relative to the block centre [sigma], the inverse (a b; b c)
 * of the kernel's covariance, and its weight. Unused lanes have weight 0. */
struct KernelGroup
{
	float x[8], y[8], a[8], b[8], c[8], w[8];
};

/** Where the measurements of a cell lie: centroid relative to the block centre [sigma], and how many they are. */
struct CellPoint
{
	float x, y;
	std::uint32_t n;
};

/** A square of 4 x 4 sigma with its cells (exact) and what is made from them by rebuild(): the kernels to be summed and
 * the places of the measurements. Both are a function of the cells alone, in canonical order. */
struct Block
{
	std::vector<Cell> cells;        ///< sorted by key
	std::vector<CellPoint> points;  ///< one for every cell
	std::vector<KernelGroup> kernels;
	std::size_t kernelCount = 0;                   ///< kernels in use; the last group may have free lanes
	float minX = 0, maxX = 0, minY = 0, maxY = 0;  ///< box of the kernels relative to the block centre [sigma]
	double weight = 0;                             ///< sum of the counts

	CellSums& findOrAdd(CellKey key);
	const Cell* find(CellKey key) const;
	/** Takes out cells that hold nothing. */
	void dropEmpty();
	/** Recomputes everything that is made from the cells. */
	void rebuild(const CellGrid& grid);
	std::size_t memoryBytes() const;
};

/** Place of a cell's centroid relative to the centre of its block [sigma]. */
Vec2 centroidInBlock(const Cell& cell, const CellGrid& grid);

/** Key of the cell at column lx and row ly of its block. */
inline CellKey makeCellKey(std::uint32_t bin, std::int64_t lx, std::int64_t ly)
{
	return (CellKey(bin) << 44) | (CellKey(ly) << 22) | CellKey(lx);
}
inline std::int64_t cellColumn(CellKey k)
{
	return std::int64_t(k & ((CellKey(1) << 22) - 1));
}
inline std::int64_t cellRow(CellKey k)
{
	return std::int64_t((k >> 22) & ((CellKey(1) << 22) - 1));
}
inline std::uint32_t cellBin(CellKey k)
{
	return std::uint32_t(k >> 44);
}

}  // namespace ridgemap
