// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/options.h>

#include <memory>
#include <vector>

#include "field_nodes.h"
#include "kernel_sum.h"
#include "tile.h"

namespace ridgemap
{
/** Counts of the work done through a field. */
struct FieldWork
{
	std::size_t evaluations = 0;
	std::size_t kernels = 0;  ///< summed one by one
};

/** Memory that the fields of one thread use one after the other. */
struct FieldScratch
{
	std::vector<float> nodes;              ///< around the tile, row by row, where they were asked for
	std::vector<std::uint64_t> hasCopied;  ///< blocks that are in `nodes`, one word a row of blocks
	std::vector<BlockView> views;
};

/** The continuous occupancy around one tile, in the frame of the tile [sigma], in kernels.
 *
 * A value is interpolated between nodes, or summed kernel by kernel where measurements are kept apart. It depends only
 * on the point and on the cells within the cut-off, never on the tile through which it is asked for, as long as the
 * point is exact in both frames. Points are confined to `inDomain`: that bounds what a tile's polylines can depend on.
 * Not thread-safe (it counts its work and keeps what it has looked up); make one per tile and thread. A scratch memory
 * that is given must not be used by another field before this one is gone. */
class TileField
{
 public:
	/** How far outside its tile a field may be asked [sigma]. */
	static constexpr double margin = 3;

	TileField(const TileStore& store, TileKey key, const Options& options, FieldScratch* scratch = nullptr);

	/** Number of blocks around a tile that its field can depend on. */
	static int haloBlocks(double cutoff);
	/** Number of blocks around a tile whose nodes its field can depend on. */
	static int haloOfNodes();

	/** No kernel is within reach of the tile. */
	bool empty() const
	{
		if (nonEmpty_ == 0) reach_.addAll();
		return nonEmpty_ == 0;
	}
	/** The blocks on which everything asked since the last call depends. */
	BlockMask takeReach() const
	{
		BlockMask result = reach_;
		reach_ = BlockMask(side_);
		return result;
	}
	double tileEdge() const { return edge_; }
	bool inDomain(Vec2 p) const
	{
		return p.x >= -margin && p.y >= -margin && p.x <= edge_ + margin && p.y <= edge_ + margin;
	}

	/** L and its derivatives at a point of the domain. */
	KernelSums sample(Vec2 p) const { return compacts_ ? sampleNodes(p) : sampleKernels(p); }

	/** Number of measurements in the blocks that come within `radius` of p. */
	double weightNear(Vec2 p, double radius) const;

	/** Calls fn(centroid, count) for the cells in the blocks that come within `radius` of p, in canonical order. */
	template <class Fn>
	void forEachCellNear(Vec2 p, double radius, Fn fn) const
	{
		const Range x = range(p.x, radius), y = range(p.y, radius);
		look(x, y);
		for (int by = y.first; by <= y.last; by++)
			for (int bx = x.first; bx <= x.last; bx++)
			{
				const Block* b = block(bx, by);
				if (!b) continue;
				const Vec2 c = centre(bx, by);
				for (const CellPoint& q : b->points) fn(Vec2{c.x + double(q.x), c.y + double(q.y)}, q.n);
			}
	}

	const FieldWork& work() const { return work_; }

 private:
	struct Range
	{
		int first, last;
	};
	Range range(double coordinate, double radius) const;
	/** Notes that the result depends on these blocks, empty or not. */
	void look(Range x, Range y) const
	{
		for (int by = y.first; by <= y.last; by++) reach_.add(by + halo_, x.first + halo_, x.last + halo_);
	}
	KernelSums sampleNodes(Vec2 p) const;
	KernelSums sampleKernels(Vec2 p) const;
	/** Copies the nodes of these blocks unless that was done before; false if they are all zero. */
	bool provideNodes(Range x, Range y) const;
	void copyBlock(int bx, int by) const;

	const Block* block(int bx, int by) const { return blocks_[std::size_t((by + halo_) * side_ + bx + halo_)]; }
	static Vec2 centre(int bx, int by) { return {4.0 * bx + 2.0, 4.0 * by + 2.0}; }

	bool compacts_;
	double edge_;
	double cutoff_;
	int halo_;                          ///< blocks beyond the tile on each side
	int side_;                          ///< blocks along one side of the neighbourhood
	std::vector<const Block*> blocks_;  ///< row by row; nullptr where there is nothing
	std::size_t nonEmpty_ = 0;
	int stride_;  ///< nodes from one row to the next
	std::unique_ptr<FieldScratch> ownScratch_;
	FieldScratch* scratch_;
	mutable BlockMask reach_;
	mutable FieldWork work_;
};

/** L and its derivatives at a point of the lattice frame [sigma]: the sum over the kernels of all cells in reach, one
 * by one. Slower than a field and without its interpolation; not thread-safe. */
KernelSums sumOfCells(TileStore& store, const Options& options, Vec2 p);

}  // namespace ridgemap
