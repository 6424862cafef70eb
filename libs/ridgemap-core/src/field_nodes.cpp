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
/** Largest count of a cell whose values fit into 32 bits. */
constexpr double largestSmall = 1900;
constexpr std::uint64_t largeLoad = 4;  ///< of the low parts of two kernels
constexpr std::uint64_t largestHighLoad = std::uint64_t(1) << 31;

/** Bound on the difference of two kernels at any place [kernel peaks]. */
double largestDifference(const CellMoments& a, const CellMoments& b)
{
	const double most = std::max(a.n, b.n), all = a.n + b.n;
	if (a.n == 0 || b.n == 0) return all;
	// A normal density of variance 1 or more changes by less than 1 for each unit that a moment changes.
	const double moved = std::abs(a.mean.x - b.mean.x) + std::abs(a.mean.y - b.mean.y) + std::abs(a.xx - b.xx) +
						 std::abs(a.xy - b.xy) + std::abs(a.yy - b.yy);
	constexpr double rounding = 1.0 / (1 << 18);  // of places and values in single precision
	return std::min(all, std::abs(a.n - b.n) + most * (moved + rounding));
}

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

KernelSpreader::Change::Change(CellKey cell, const CellSums& sumsBefore, const CellSums& sumsAfter,
							   const CellGrid& grid)
	: key(cell), load(largeLoad), highLoad(0)
{
	if (sumsBefore.n > 0) before = momentsOf({key, sumsBefore}, grid);
	if (sumsAfter.n > 0) after = momentsOf({key, sumsAfter}, grid);
	const double most = std::max(before.n, after.n), difference = largestDifference(before, after) + 1;
	magnitude = difference > double(largestLoad) ? Magnitude::large
				: most > largestSmall            ? Magnitude::smallDifference
												 : Magnitude::small;
	if (magnitude == Magnitude::large)
		highLoad = std::uint64_t(most);
	else
		load = std::uint64_t(std::ceil(difference));
}

bool KernelSpreader::Change::fits(const SpreadScratch& s) const
{
	return s.load + load <= largestLoad && s.highLoad + highLoad <= largestHighLoad;
}

void KernelSpreader::add(const Change& c, SpreadScratch& s) const
{
	s.load += c.load;
	s.highLoad += c.highLoad;
	s.wide = s.wide || c.magnitude == Magnitude::large;
	const auto side = std::size_t((2 * reach_ + 1) * nodesPerBlock);
	s.low.resize(side * side, 0);
	if (s.wide) s.high.resize(side * side, 0);

	const Window w = windowOf(c.key);
	const auto profile = [&](const CellMoments& m, KernelProfile& p) -> const KernelProfile*
	{
		if (m.n == 0) return nullptr;
		const double half = 0.5 * double(Frame::blockEdge), h = 1.0 / nodesPerSigma;
		const double vx = 1 + m.xx, vy = 1 + m.yy;
		makeProfile({float(h * w.x0 - half - m.mean.x), float(h * w.y0 - half - m.mean.y), float(vx), float(vy),
					 float(m.xy), float(nodesPerKernel * m.n / std::sqrt(vx * vy))},
					*w.reach, p);
		return &p;
	};
	addChanges(changesAt(s, w.x0, w.y0), c.magnitude, *w.reach, profile(c.after, s.after), profile(c.before, s.before));
	const Box b = blocksInReach(c.key);
	const bool fresh = s.x0 == s.x1;
	s.x0 = fresh ? b.x0 : std::min(s.x0, b.x0);
	s.x1 = fresh ? b.x1 : std::max(s.x1, b.x1);
	s.y0 = fresh ? b.y0 : std::min(s.y0, b.y0);
	s.y1 = fresh ? b.y1 : std::max(s.y1, b.y1);
}

}  // namespace ridgemap
