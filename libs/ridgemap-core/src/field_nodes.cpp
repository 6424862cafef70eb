// SPDX-License-Identifier: BSD-3-Clause
#include "field_nodes.h"

#include <algorithm>
#include <cmath>

namespace ridgemap
{
namespace
{
/** Bound on what a number of 32 bits may take up, in kernel peaks; what is left covers tilted kernels. */
constexpr std::uint64_t largestLoad = 1000;
/** Counts up to this, before and after together, need no high parts. */
constexpr std::uint64_t largestNarrow = 400;
constexpr std::uint64_t wideLoad = 4;  ///< of the low parts of two kernels
constexpr std::uint64_t largestHighLoad = std::uint64_t(1) << 31;

int roundDownToEight(double x)
{
	return roundDown(x) & ~7;
}
}  // namespace

KernelSpreader::KernelSpreader(const CellGrid& grid, double cutoff)
	: grid_(grid), radius_((cutoff + grid.halfExtent()) * nodesPerSigma)
{
	reach_ = int(std::ceil(radius_ / nodesPerBlock));
	const double nodesPerCell = double(grid.edge()) / double(Frame::quantaPerSigma) * nodesPerSigma;
	columns_ = grid.compacts() ? int(8 / nodesPerCell) : 0;
	rows_ = grid.compacts() ? int(std::max(1.0, 1 / nodesPerCell)) : 0;
	for (int row = 0; row < rows_; row++)
		for (int column = 0; column < columns_; column++)
			reaches_.push_back(reachOf(centreOf(makeCellKey(0, column, row))));
}

/** Centre of a cell from the corner of its block [node spacings]. */
Vec2 KernelSpreader::centreOf(CellKey key) const
{
	const double quantaPerNode = double(Frame::quantaPerSigma) / nodesPerSigma;
	return {double(grid_.centre(cellColumn(key))) / quantaPerNode, double(grid_.centre(cellRow(key))) / quantaPerNode};
}

KernelSpreader::Box KernelSpreader::blocksInReach(CellKey key) const
{
	const Vec2 c = centreOf(key);
	const auto block = [](double node) { return roundDown(node / nodesPerBlock); };
	return {block(c.x - radius_), block(c.x + radius_) + 1, block(c.y - radius_), block(c.y + radius_) + 1};
}

KernelSpreader::Window KernelSpreader::windowOf(CellKey key) const
{
	const std::int64_t column = cellColumn(key), row = cellRow(key), firstColumn = column / columns_ * columns_,
					   firstRow = row / rows_ * rows_;
	const KernelReach& r = reaches_[std::size_t((row - firstRow) * columns_ + column - firstColumn)];
	const double nodesPerCell = 8.0 / columns_;
	return {r.x0 + int(double(firstColumn) * nodesPerCell), r.y0 + int(double(firstRow) * nodesPerCell), &r};
}

KernelReach KernelSpreader::reachOf(Vec2 c) const
{
	KernelReach r;
	r.x0 = roundDownToEight(c.x - radius_);
	r.columns = roundDownToEight(c.x + radius_) + 8 - r.x0;
	r.y0 = roundUp(c.y - radius_);
	r.rows = roundDown(c.y + radius_) + 1 - r.y0;
	for (int j = 0; j < r.rows; j++)
	{
		const double dy = r.y0 + j - c.y, reach = std::sqrt(radius_ * radius_ - dy * dy);
		r.first[j] = roundDownToEight(c.x - reach) - r.x0;
		r.last[j] = roundDownToEight(c.x + reach) + 8 - r.x0;
	}
	return r;
}

bool KernelSpreader::hasRoom(const CellSums& before, const CellSums& after, const SpreadScratch& s) const
{
	const std::uint64_t n = std::uint64_t(before.n) + after.n;
	if (n <= largestNarrow) return s.load + n <= largestLoad;
	return s.load + wideLoad <= largestLoad && s.highLoad + std::max(before.n, after.n) <= largestHighLoad;
}

void KernelSpreader::add(CellKey key, const CellSums& before, const CellSums& after, SpreadScratch& s) const
{
	const std::uint64_t n = std::uint64_t(before.n) + after.n;
	const bool wide = n > largestNarrow;
	s.load += wide ? wideLoad : n;
	s.highLoad += wide ? std::max(before.n, after.n) : 0;
	s.wide = s.wide || wide;
	const auto side = std::size_t((2 * reach_ + 1) * nodesPerBlock);
	s.low.resize(side * side, 0);
	if (wide) s.high.resize(side * side, 0);

	const Window w = windowOf(key);
	const auto profile = [&](const CellSums& sums, KernelProfile& p) -> const KernelProfile*
	{
		if (sums.n == 0) return nullptr;
		const CellMoments m = momentsOf({key, sums}, grid_);
		const double half = 0.5 * double(Frame::blockEdge), h = 1.0 / nodesPerSigma;
		const double vx = 1 + m.xx, vy = 1 + m.yy;
		makeProfile({float(h * w.x0 - half - m.mean.x), float(h * w.y0 - half - m.mean.y), float(vx), float(vy),
					 float(m.xy), float(nodesPerKernel * m.n / std::sqrt(vx * vy))},
					*w.reach, p);
		return &p;
	};
	addChanges(changesAt(s, w.x0, w.y0), wide, *w.reach, profile(after, s.after), profile(before, s.before));
	const Box b = blocksInReach(key);
	const bool fresh = s.x0 == s.x1;
	s.x0 = fresh ? b.x0 : std::min(s.x0, b.x0);
	s.x1 = fresh ? b.x1 : std::max(s.x1, b.x1);
	s.y0 = fresh ? b.y0 : std::min(s.y0, b.y0);
	s.y1 = fresh ? b.y1 : std::max(s.y1, b.y1);
}

}  // namespace ridgemap
