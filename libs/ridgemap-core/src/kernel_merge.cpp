// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_merge.h"

#include <algorithm>

namespace ridgemap
{
namespace
{
/** Moments of some measurements: number, mean relative to the block centre, central moments per measurement [sigma]. */
struct Moments
{
	double n = 0;
	Vec2 mean;
	double xx = 0, xy = 0, yy = 0;
	double xxx = 0, xxy = 0, xyy = 0, yyy = 0;
	double xxxx = 0, xxyy = 0, yyyy = 0;  ///< of the fourth moments those that count
};

Moments momentsOf(const Cell& cell, const CellGrid& grid)
{
	Moments m;
	m.n = cell.sums.n;
	m.mean = centroidInBlock(cell, grid);
	const double quantum = double(Frame::quantaPerSigma), unit = double(CellSums::momentShift) / quantum;
	const double mx = double(cell.sums.sx) / m.n / quantum, my = double(cell.sums.sy) / m.n / quantum;
	m.xx = std::max(0.0, double(cell.sums.sxx) / m.n * unit * unit - mx * mx);
	m.yy = std::max(0.0, double(cell.sums.syy) / m.n * unit * unit - my * my);
	const double limit = std::sqrt(m.xx * m.yy);
	m.xy = std::max(-limit, std::min(limit, double(cell.sums.sxy) / m.n * unit * unit - mx * my));
	// The cell keeps no higher moments; those of evenly spread measurements stand in for the fourth.
	m.xxxx = 1.8 * m.xx * m.xx;
	m.xxyy = m.xx * m.yy + 2 * m.xy * m.xy;
	m.yyyy = 1.8 * m.yy * m.yy;
	return m;
}

/** Moments of the union; those of the parts about their own means are shifted to the common mean. */
Moments unite(const Moments* const* parts, int count)
{
	if (count == 1) return *parts[0];
	Moments u;
	for (int i = 0; i < count; i++)
	{
		u.n += parts[i]->n;
		u.mean = u.mean + parts[i]->n * parts[i]->mean;
	}
	u.mean = (1 / u.n) * u.mean;
	for (int i = 0; i < count; i++)
	{
		const Moments& p = *parts[i];
		const double w = p.n / u.n;
		const Vec2 d = p.mean - u.mean;
		u.xx += w * (p.xx + d.x * d.x);
		u.xy += w * (p.xy + d.x * d.y);
		u.yy += w * (p.yy + d.y * d.y);
		u.xxx += w * (p.xxx + d.x * (3 * p.xx + d.x * d.x));
		u.xxy += w * (p.xxy + d.y * (p.xx + d.x * d.x) + 2 * d.x * p.xy);
		u.xyy += w * (p.xyy + d.x * (p.yy + d.y * d.y) + 2 * d.y * p.xy);
		u.yyy += w * (p.yyy + d.y * (3 * p.yy + d.y * d.y));
		u.xxxx += w * (p.xxxx + d.x * (4 * p.xxx + d.x * (6 * p.xx + d.x * d.x)));
		u.xxyy += w * (p.xxyy + 2 * d.x * p.xyy + 2 * d.y * p.xxy + d.x * d.x * p.yy + d.y * d.y * p.xx +
					   4 * d.x * d.y * p.xy + d.x * d.x * d.y * d.y);
		u.yyyy += w * (p.yyyy + d.y * (4 * p.yyy + d.y * (6 * p.yy + d.y * d.y)));
	}
	return u;
}

/** What one kernel in place of these measurements changes of L at most: it has the third and fourth moments of a normal
 * density, not theirs (Gram-Charlier series; |He3| <= 1.4, He4 <= 3, He2 He2 <= 1 where it matters). */
double mergeError(const Moments& m)
{
	const double third = std::abs(m.xxx) + 3 * std::abs(m.xxy) + 3 * std::abs(m.xyy) + std::abs(m.yyy);
	const double fourth = 3 * std::abs(m.xxxx - 3 * m.xx * m.xx) + 3 * std::abs(m.yyyy - 3 * m.yy * m.yy) +
						  6 * std::abs(m.xxyy - m.xx * m.yy - 2 * m.xy * m.xy);
	return m.n * (1.4 * third / 6 + fourth / 24);
}

/** Pyramid of moments over the cells of one block and one direction bin. */
class Pyramid
{
 public:
	Pyramid(Block& block, const CellGrid& grid) : block_(block), tolerance_(grid.mergeTolerance() * block.weight)
	{
		int side = int(grid.cellsPerBlock());
		for (; side >= int(Frame::blockEdge); side /= 2)
			levels_.push_back({side, std::vector<Moments>(std::size_t(side * side))});
	}

	void add(const Cell& cell, const CellGrid& grid)
	{
		Level& l = levels_.front();
		l.nodes[std::size_t(cellRow(cell.key) * l.side + cellColumn(cell.key))] = momentsOf(cell, grid);
	}

	void finish()
	{
		for (std::size_t k = 1; k < levels_.size(); k++)
			for (int y = 0; y < levels_[k].side; y++)
				for (int x = 0; x < levels_[k].side; x++) gather(k, x, y);
		const Level& top = levels_.back();
		for (int y = 0; y < top.side; y++)
			for (int x = 0; x < top.side; x++) emit(levels_.size() - 1, x, y);
	}

 private:
	struct Level
	{
		int side;
		std::vector<Moments> nodes;
	};

	const Moments& at(std::size_t level, int x, int y) const
	{
		return levels_[level].nodes[std::size_t(y * levels_[level].side + x)];
	}

	void gather(std::size_t level, int x, int y)
	{
		const Moments* parts[4];
		int count = 0;
		for (int i = 0; i < 4; i++)
		{
			const Moments& m = at(level - 1, 2 * x + i % 2, 2 * y + i / 2);
			if (m.n > 0) parts[count++] = &m;
		}
		if (count > 0) levels_[level].nodes[std::size_t(y * levels_[level].side + x)] = unite(parts, count);
	}

	void emit(std::size_t level, int x, int y)
	{
		const Moments& m = at(level, x, y);
		if (!(m.n > 0)) return;
		if (level == 0 || mergeError(m) <= tolerance_)
		{
			appendKernel(block_, m);
			return;
		}
		for (int i = 0; i < 4; i++) emit(level - 1, 2 * x + i % 2, 2 * y + i / 2);
	}

 public:
	/** Appends one kernel: a normal density whose covariance is that of the smoothing kernel plus that of the
	 * measurements about their mean. It has the mass, mean and second moments of the sum of their kernels. */
	static void appendKernel(Block& b, const Moments& m)
	{
		const std::size_t lane = b.kernelCount % 8;
		if (lane == 0) b.kernels.push_back(KernelGroup{});
		b.kernelCount++;
		KernelGroup& g = b.kernels.back();
		const double det = (1 + m.xx) * (1 + m.yy) - m.xy * m.xy;
		g.x[lane] = float(m.mean.x);
		g.y[lane] = float(m.mean.y);
		g.a[lane] = float((1 + m.yy) / det);
		g.b[lane] = float(-m.xy / det);
		g.c[lane] = float((1 + m.xx) / det);
		g.w[lane] = float(m.n / std::sqrt(det));
		b.minX = std::min(b.minX, g.x[lane]);
		b.maxX = std::max(b.maxX, g.x[lane]);
		b.minY = std::min(b.minY, g.y[lane]);
		b.maxY = std::max(b.maxY, g.y[lane]);
	}

 private:
	Block& block_;
	double tolerance_;
	std::vector<Level> levels_;
};
}  // namespace

void makeKernels(Block& block, const CellGrid& grid)
{
	block.kernels.clear();
	block.kernelCount = 0;
	block.minX = block.minY = 1e30f;
	block.maxX = block.maxY = -1e30f;
	if (grid.edge() == 1)
	{
		for (const Cell& c : block.cells) Pyramid::appendKernel(block, momentsOf(c, grid));
		return;
	}
	if (block.cells.empty()) return;
	Pyramid pyramid(block, grid);
	for (const Cell& c : block.cells) pyramid.add(c, grid);
	pyramid.finish();
}

}  // namespace ridgemap
