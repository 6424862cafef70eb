// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/options.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "frame.h"

namespace ridgemap
{
constexpr int nodesPerSigma = 4;
constexpr int nodesPerBlock = nodesPerSigma * int(Frame::blockEdge);  ///< along one axis; block edges lie on nodes

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
	explicit CellGrid(const Options& o) : edge_(o.cell > 0 ? std::int64_t(o.cell * double(Frame::quantaPerSigma)) : 1)
	{
	}

	std::int64_t edge() const { return edge_; }
	/** Measurements are added up in cells; else each keeps its own kernel, the paper's raw buffer. */
	bool compacts() const { return edge_ > 1; }
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
};

/** Eight kernels side by side, one SIMD lane each: place relative to the block centre [sigma], the inverse (a b; b c)
 * of the kernel's covariance, and its weight. Unused lanes have weight 0. */
struct KernelGroup
{
	float x[8], y[8], a[8], b[8], c[8], w[8];
};

/** Where the measurements of a cell lie: centroid relative to the block centre [sigma], and from which direction they
 * were seen. */
struct CellPoint
{
	float x, y;
	std::uint32_t bin;
};

/** Values at the nodes of a block, row by row. Copies share them until one is changed: they are most of what a map
 * holds, and particle filters copy maps all the time. */
class SharedNodes
{
 public:
	using Values = std::vector<std::int64_t>;

	bool empty() const { return !values_ || values_->empty(); }
	const std::int64_t* data() const { return values_ ? values_->data() : nullptr; }
	/** For a change: nobody else sees it. */
	Values& own();

	bool operator==(const SharedNodes& o) const
	{
		return empty() || o.empty() ? empty() == o.empty() : *values_ == *o.values_;
	}

 private:
	std::shared_ptr<Values> values_;
};

/** Values at the nodes of a block, of the measurements of one direction bin. */
struct NodeLayer
{
	std::uint32_t bin = 0;
	SharedNodes nodes;
};

/** Number, mean relative to the block centre and central second moments per measurement of a cell [sigma]. */
struct CellMoments
{
	double n = 0;
	Vec2 mean;
	double xx = 0, xy = 0, yy = 0;
};
CellMoments momentsOf(const Cell& cell, const CellGrid& grid);

/** Kernels to be summed directly, in canonical order. */
struct KernelList
{
	std::vector<KernelGroup> groups;
	std::size_t count = 0;  ///< kernels in use; the last group may have free lanes
	float minX = 1e30f, maxX = -1e30f, minY = 1e30f,
		  maxY = -1e30f;  ///< box around them relative to the block centre [sigma]

	/** Appends one kernel: a normal density whose covariance is that of the smoothing kernel plus that of the
	 * measurements about their mean. It has the mass, mean and second moments of the sum of their kernels. */
	void add(const CellMoments& m);
};

/** A square of 4 x 4 sigma with its cells (exact) and what is made from them. Everything is a function of the cells in
 * reach alone. */
struct Block
{
	std::vector<Cell> cells;        ///< sorted by key
	std::vector<Cell> before;       ///< cells changed since the nodes were brought up to date, as they were then
	bool isChanged = false;         ///< cells changed since what is made from them was
	std::vector<CellPoint> points;  ///< one for every cell
	double weight = 0;              ///< sum of the counts
	std::vector<NodeLayer> layers;  ///< L at the nodes of the block by direction bin, those that are not all zero
	KernelList kernels;             ///< of the cells; where they are compacted, made only when asked for

	CellSums& findOrAdd(CellKey key);
	const Cell* find(CellKey key) const;
	/** Takes out cells that hold nothing. */
	void dropEmpty();
	/** Keeps what a cell held when the nodes were last brought up to date. */
	void remember(CellKey key, const CellSums& sums);
	/** Forgets that, but keeps memory for as much as a scan changes. */
	void forgetBefore();
	/** Makes the list of kernels, one for every cell, unless it is there. */
	void makeKernels(const CellGrid& grid);
	/** The nodes of a direction bin, empty where all are zero. Valid until it is asked for another bin. */
	std::vector<std::int64_t>& nodesOf(std::uint32_t bin);
	/** The nodes of a direction bin; nullptr if they are all zero. */
	const std::int64_t* findNodes(std::uint32_t bin) const;
	/** Takes out layers without nodes. */
	void dropEmptyLayers();
	/** Recomputes everything that is made from the cells of this block alone. */
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
