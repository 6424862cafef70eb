// SPDX-License-Identifier: BSD-3-Clause
// The continuous occupancy at the nodes of a grid: every cell adds the values of its kernel, rounded to integers.
// Integer sums are exact in any order, so that a change costs what the changed cells cost, however much the place has
// seen, and leaves no trace when it is taken back.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel_block.h"
#include "kernel_sum.h"

namespace ridgemap
{
constexpr double nodesPerKernel = double(1 << 20);  ///< value at a node of a kernel's peak

/** The kernel of one cell in a window of nodes: its value at column i and row j is x[i] y[j] + dx[i] dy[j]. */
struct KernelProfile
{
	static constexpr int capacity = 80;  ///< nodes along one axis: 2 (8 + 1/2) sigma, rounded out to multiples of 8
	alignas(32) float x[capacity], dx[capacity], y[capacity], dy[capacity];
};

/** A normal density seen from the first node of a window. */
struct KernelShape
{
	float x0, y0;  ///< place of the first node, from the mean [sigma]
	float vx, vy;  ///< variances [sigma^2]
	float xy;      ///< covariance, which enters to first order [sigma^2]
	float weight;  ///< value at the mean
};

/** Which part of the window of a cell is in reach: in row j the columns [first[j], last[j]), both multiples of 8.
 * The window begins at node (x0, y0); x0 is a multiple of 8. */
struct KernelReach
{
	int x0, y0, columns, rows;
	int first[KernelProfile::capacity], last[KernelProfile::capacity];
};

/** Changes of nodes as 32-bit numbers: low + 2^21 high. High parts are used only for large counts. */
struct NodeChanges
{
	static constexpr int highShift = 21;
	std::int32_t* low;
	std::int32_t* high;
	int stride;  ///< nodes from one row to the next
};

/** The values of a kernel in the columns and rows of a window. */
void makeProfile(const KernelShape& shape, const KernelReach& reach, KernelProfile& profile);

/** How large what is added up may become. All give the same integers. */
enum class Magnitude
{
	small,            ///< values and the sums of their changes stay below 2^31
	smallDifference,  ///< values up to 2^51, sums of their changes below 2^31
	large             ///< values up to 2^51 and their sums: high parts are used
};

/** Adds the values of `after` and takes away those of `before`, either of which may be nullptr, each rounded to an
 * integer. `to` points to the first node of the window. */
void addChanges(const NodeChanges& to, Magnitude magnitude, const KernelReach& reach, const KernelProfile* after,
				const KernelProfile* before);

/** The changes of the nodes of a block are not all zero. */
bool areChanged(const NodeChanges& changes, bool wide);
/** Adds changes to the nodes of a block and makes them zero; false if all nodes are zero then. */
bool applyChanges(const NodeChanges& changes, bool wide, std::int64_t* nodes);

/** Nodes along one axis that interpolation between two of them needs. */
struct NodeTaps
{
	static constexpr int count = 8;
	static constexpr int before = count / 2 - 1, after = count / 2;  ///< seen from the node to the left or below
};

/** Copies the nodes of a block [kernels] into rows `stride` apart, rounded to single precision. */
void copyNodes(const std::int64_t* nodes, float* to, int stride);

/** A square of 8 x 8 nodes, and where to put what is interpolated from it. */
struct NodeSquare
{
	const float* corner;  ///< first node
	KernelSums* sums;
};

/** L and its derivatives [kernels, sigma] between the nodes of each square by the weights of interpolation_table.h:
 * rows are `stride` apart; tx and ty, in [0, 1), count from the fourth node, in node spacings. IEEE single precision
 * that is never contracted: the same bits on every machine, whatever the other squares. */
void interpolateNodes(const NodeSquare* squares, std::size_t count, int stride, float tx, float ty);

/** Changes of the nodes around one block, and memory for making them. For one thread at a time. */
class SpreadScratch
{
 private:
	friend class KernelSpreader;
	std::vector<std::int32_t> low, high;   ///< of all blocks in reach, row by row; zero in between
	bool wide = false;                     ///< high parts were used
	std::uint64_t load = 0, highLoad = 0;  ///< bounds on what is in them
	int x0 = 0, x1 = 0, y0 = 0, y1 = 0;  ///< blocks that may have changed, from that of the cells: [x0, x1) x [y0, y1)
	KernelProfile after, before;
};

/** Spreads the kernels of cells over the nodes. */
class KernelSpreader
{
 public:
	KernelSpreader(const CellGrid& grid, double cutoff);

	/** How many blocks away from its own a cell reaches. */
	int reach() const { return reach_; }
	/** Blocks that a cell reaches, from its own: [x0, x1) x [y0, y1). */
	struct Box
	{
		int x0, x1, y0, y1;
	};
	Box blocksInReach(CellKey key) const;

	/** Changes a cell from one content to another; all cells until finish() belong to one block. `nodesOf(bx, by)`
	 * gives the nodes of the block that many blocks to the right of and above that one, empty where all are zero; it is
	 * asked for blocks whose nodes change. */
	template <class NodesOf>
	void spread(CellKey key, const CellSums& before, const CellSums& after, SpreadScratch& scratch,
				NodesOf nodesOf) const
	{
		const Change change(key, before, after, grid_);
		if (!change.fits(scratch)) finish(scratch, nodesOf);
		add(change, scratch);
	}

	template <class NodesOf>
	void finish(SpreadScratch& s, NodesOf nodesOf) const
	{
		for (int by = s.y0; by < s.y1; by++)
			for (int bx = s.x0; bx < s.x1; bx++)
			{
				const NodeChanges changes = changesAt(s, bx * nodesPerBlock, by * nodesPerBlock);
				if (!areChanged(changes, s.wide)) continue;
				std::vector<std::int64_t>& nodes = nodesOf(bx, by);
				if (nodes.empty()) nodes.assign(std::size_t(nodesPerBlock * nodesPerBlock), 0);
				if (!applyChanges(changes, s.wide, nodes.data())) nodes = std::vector<std::int64_t>();
			}
		s.x0 = s.x1 = s.y0 = s.y1 = 0;
		s.load = s.highLoad = 0;
		s.wide = false;
	}

 private:
	/** A cell that changes, and bounds on what that adds to any node. */
	struct Change
	{
		Change(CellKey key, const CellSums& sumsBefore, const CellSums& sumsAfter, const CellGrid& grid);
		/** Nothing overflows when this is added to what is there. */
		bool fits(const SpreadScratch& scratch) const;

		CellKey key;
		CellMoments before, after;
		Magnitude magnitude;
		std::uint64_t load, highLoad;  ///< of low and of high parts [kernel peaks]
	};
	void add(const Change& change, SpreadScratch& scratch) const;
	/** Where the window of a cell begins, counted from the corner of its block, and its rows. */
	struct Window
	{
		int x0, y0;
		const KernelReach* reach;
	};
	Window windowOf(CellKey key) const;
	KernelReach reachOf(Vec2 centre) const;
	/** Where the changes of a node are, counted from the corner of the cells' block. */
	NodeChanges changesAt(SpreadScratch& s, int x, int y) const
	{
		const int stride = (2 * reach_ + 1) * nodesPerBlock,
				  at = (y + reach_ * nodesPerBlock) * stride + x + reach_ * nodesPerBlock;
		return {s.low.data() + at, s.high.empty() ? nullptr : s.high.data() + at, stride};
	}
	Vec2 centreOf(CellKey key) const;

	CellGrid grid_;
	double radius_;  ///< farthest node that a cell reaches, from the cell's centre [node spacings]
	int reach_;
	int columns_, rows_;  ///< cells in the least square whose edges are cells and, along rows, multiples of 8 nodes
	std::vector<KernelReach> reaches_;  ///< of the cells of that square, row by row, counted from its corner
};

}  // namespace ridgemap
