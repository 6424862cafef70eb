// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/options.h>

#include <memory>
#include <vector>

#include "field_nodes.h"
#include "kernel_sum.h"
#include "tile.h"
#include "viewing_direction.h"

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
	/** Values at nodes of one direction bin. */
	struct Plane
	{
		std::vector<float> nodes;              ///< around the tile, row by row, where they were asked for
		std::vector<std::uint32_t> hasCopied;  ///< blocks that are in `nodes`, one word a row of blocks
	};
	std::vector<Plane> planes;         ///< by direction bin
	std::vector<const Block*> blocks;  ///< row by row; nullptr where there is nothing
	std::vector<std::uint32_t> bins;   ///< direction bins of the nodes of each block, one bit each
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
	/** The blocks on which everything that was asked depends. */
	const BlockMask& reach() const { return reach_; }
	double tileEdge() const { return edge_; }
	bool inDomain(Vec2 p) const
	{
		return p.x >= -margin && p.y >= -margin && p.x <= edge_ + margin && p.y <= edge_ + margin;
	}

	/** Some measurements in the map tell from which side they were seen: L depends on the side from which it is asked
	 * for. */
	bool isSided() const { return sided_; }

	/** L and its derivatives at a point of the domain, whatever the side from which measurements were seen. */
	KernelSums sample(Vec2 p) const;

	/** L at the node next to a point of the domain, whatever the side: tells cheaply where nothing is near. */
	double nearestNode(Vec2 p) const;

	/** Measurements of a direction bin count for a surface with this normal. */
	bool sees(std::uint32_t bin, Vec2 normal) const { return !sided_ || isSeenFrom(bin, normal); }

	/** Number of measurements in the blocks that come within `radius` of p. */
	double weightNear(Vec2 p, double radius) const;

	/** Calls fn(centroid, direction bin) for the cells in the blocks that come within `radius` of p, in canonical
	 * order. */
	template <class Fn>
	void forEachCellNear(Vec2 p, double radius, Fn fn) const
	{
		anyCellNear(p, radius,
					[&](Vec2 q, std::uint32_t bin)
					{
						fn(q, bin);
						return false;
					});
	}
	/** The same until fn returns true; whether it did. */
	template <class Fn>
	bool anyCellNear(Vec2 p, double radius, Fn fn) const
	{
		const Range x = range(p.x, radius), y = range(p.y, radius);
		look(x, y);
		for (int by = y.first; by <= y.last; by++)
			for (int bx = x.first; bx <= x.last; bx++)
			{
				const Block* b = block(bx, by);
				if (!b) continue;
				const Vec2 c = centre(bx, by);
				for (const CellPoint& q : b->points)
					if (fn(Vec2{c.x + double(q.x), c.y + double(q.y)}, q.bin)) return true;
			}
		return false;
	}

	const FieldWork& work() const { return work_; }

 private:
	friend class FieldPoint;
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
	/** The nodes around a point. */
	struct Taps
	{
		Range x, y;          ///< blocks in which they lie
		int corner;          ///< index of the first one
		float tx, ty;        ///< place between the middle ones
		std::uint32_t bins;  ///< direction bins that are not zero there, one bit each
	};
	/** Interpolates the direction bins of a mask; sums[bin] for each. */
	void provideBins(const Taps& taps, std::uint32_t mask, KernelSums* sums) const;
	KernelSums sampleKernels(Vec2 p) const;
	/** Copies the nodes of a direction bin in these blocks unless that was done before. */
	void provideNodes(std::uint32_t bin, Range x, Range y) const;
	void copyBlock(std::uint32_t bin, int bx, int by) const;
	Taps tapsAt(Vec2 p) const;

	std::size_t index(int bx, int by) const { return std::size_t((by + halo_) * side_ + bx + halo_); }
	const Block* block(int bx, int by) const { return scratch_->blocks[index(bx, by)]; }
	static Vec2 centre(int bx, int by) { return {4.0 * bx + 2.0, 4.0 * by + 2.0}; }

	bool compacts_, sided_;
	double edge_;
	double cutoff_;
	int halo_;  ///< blocks beyond the tile on each side
	int side_;  ///< blocks along one side of the neighbourhood
	std::size_t nonEmpty_ = 0;
	int stride_;  ///< nodes from one row to the next
	std::unique_ptr<FieldScratch> ownScratch_;
	FieldScratch* scratch_;
	mutable BlockMask reach_;
	mutable FieldWork work_;
};

/** How the density changes per radian that the normal of the surface turns to its left. */
struct FieldTurn
{
	double slope = 0;  ///< change of the derivative of L along the normal
	double twist = 0;  ///< change of the mixed second derivative along the normal and what is left of it
};

/** A place of a sided field whose density is looked at from one side after the other. What was seen from each direction
 * is interpolated once. */
class FieldPoint
{
 public:
	FieldPoint(const TileField& field, Vec2 p) : field_(field), p_(p), taps_(field.tapsAt(p)) {}

	Vec2 place() const { return p_; }
	/** L and its derivatives for a surface whose normal gives the direction bins these weights. */
	KernelSums sum(const SideWeights& weights);
	FieldTurn turn(Vec2 normal);

 private:
	/** Interpolates the bins that weigh something unless that was done before; gives those that are there, as a mask.
	 */
	std::uint32_t provide(const double (&weights)[directionBins]);

	const TileField& field_;
	Vec2 p_;
	TileField::Taps taps_;
	std::uint32_t known_ = 0;  ///< bins that are in sums_, one bit each
	KernelSums sums_[directionBins];
};

/** L and its derivatives at a point of the lattice frame [sigma]: the sum over the kernels of all cells in reach, one
 * by one. Slower than a field and without its interpolation; not thread-safe. */
KernelSums sumOfCells(TileStore& store, const Options& options, Vec2 p);

}  // namespace ridgemap
