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
constexpr int nodesPerSigma = 4;
constexpr int nodesPerBlock = nodesPerSigma * int(Frame::blockEdge);  ///< along one axis; block edges lie on nodes
constexpr double nodesPerKernel = double(1 << 20);                    ///< value at a node of a kernel's peak

/** The kernel of one cell at the nodes of a window around it: its value at node (i, j) is x[i] y[j] + dx[i] dy[j]. In
 * row j only the columns [first[j], last[j]) are in reach; both are multiples of four. */
struct KernelWindow
{
	static constexpr int capacity = 80;  ///< nodes along one axis: 2 (8 + 1/2) sigma, rounded up to multiples of four
	alignas(32) double x[capacity], dx[capacity];
	double y[capacity], dy[capacity];
	int first[capacity], last[capacity];
};

/** Adds the values of a kernel, each rounded to the nearest integer, to the nodes of a block, stored row by row. The
 * lower left node of the block is node (originX, originY) of the window; rows y0 to y1 - 1 of the block are in the
 * window. The negative of a window takes away exactly what the window added. */
void addToNodes(std::int64_t* nodes, const KernelWindow& window, int originX, int originY, int y0, int y1);

/** Nodes along one axis that interpolation between two of them needs. */
struct NodeTaps
{
	static constexpr int count = 8;
	static constexpr int before = count / 2 - 1, after = count / 2;  ///< seen from the node to the left or below
};

/** Copies the nodes of a block [kernels] into rows `stride` apart, rounded to single precision. */
void copyNodes(const std::int64_t* nodes, float* to, int stride);

/** L and its derivatives [kernels, sigma] between nodes by the weights of interpolation_table.h: `corner` is the first
 * of 8 x 8 nodes in rows `stride` apart; tx and ty, in [0, 1), count from the fourth node, in node spacings. IEEE
 * single precision that is never contracted: the same bits on every machine. */
KernelSums interpolateNodes(const float* corner, int stride, float tx, float ty);

/** Spreads the kernels of cells over the nodes. */
class KernelSpreader
{
 public:
	KernelSpreader(const CellGrid& grid, double cutoff);

	/** How many blocks away from its own a cell reaches. */
	int reach() const { return reach_; }

	/** Adds (sign +1) what a cell holds or takes it away (-1). `nodesOf(bx, by)` gives the nodes of the block that many
	 * blocks to the right of and above that of the cell. */
	template <class NodesOf>
	void spread(const Cell& cell, int sign, NodesOf nodesOf) const
	{
		KernelWindow window;
		const Place p = fill(cell, sign, window);
		const int n = nodesPerBlock;
		for (int by = int(floorDiv(p.y0, n)); by * n < p.y1; by++)
			for (int bx = int(floorDiv(p.x0, n)); bx * n < p.x1; bx++)
				addToNodes(nodesOf(bx, by), window, bx * n - p.x0, by * n - p.y0, std::max(0, p.y0 - by * n),
						   std::min(n, p.y1 - by * n));
	}

 private:
	/** A window of nodes, counted from the corner of the cell's block. */
	struct Place
	{
		int x0, x1, y0, y1;
	};
	Place fill(const Cell& cell, int sign, KernelWindow& window) const;

	CellGrid grid_;
	double radius_;  ///< farthest node that a cell reaches, from the cell's centre [node spacings]
	int reach_;
	std::vector<double>
		halfWidths_;  ///< of the disc of that radius, for every fourth of a spacing away from its centre
};

}  // namespace ridgemap
