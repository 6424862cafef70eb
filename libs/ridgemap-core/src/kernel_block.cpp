// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_block.h"

#include <algorithm>
#include <stdexcept>

namespace ridgemap
{
namespace
{
constexpr std::int64_t momentShift = 16;  ///< offsets are divided by this before they are multiplied

/** Rounds to the nearest multiple of 16 quanta, halves upwards. */
std::int64_t coarse(std::int64_t offset)
{
	return floorDiv(offset + momentShift / 2, momentShift);
}

bool keyLess(const Cell& c, CellKey k)
{
	return c.key < k;
}

/** One kernel: a normal density whose covariance is that of the smoothing kernel plus that of the cell's
 * measurements about their mean. It has the mass, mean and second moments of the sum of their kernels. */
struct Kernel
{
	float x, y, a, b, c, w;
};

Kernel makeKernel(const Cell& cell, const CellGrid& grid)
{
	const double n = cell.sums.n;
	const Vec2 m = centroidInBlock(cell, grid);
	const double unit = double(momentShift) / double(Frame::quantaPerSigma);
	const double mx = double(cell.sums.sx) / n / double(Frame::quantaPerSigma);
	const double my = double(cell.sums.sy) / n / double(Frame::quantaPerSigma);
	const double vx = std::max(0.0, double(cell.sums.sxx) / n * unit * unit - mx * mx);
	const double vy = std::max(0.0, double(cell.sums.syy) / n * unit * unit - my * my);
	double vxy = double(cell.sums.sxy) / n * unit * unit - mx * my;
	const double limit = std::sqrt(vx * vy);
	vxy = std::max(-limit, std::min(limit, vxy));
	const double det = (1 + vx) * (1 + vy) - vxy * vxy;
	return {float(m.x),
			float(m.y),
			float((1 + vy) / det),
			float(-vxy / det),
			float((1 + vx) / det),
			float(n / std::sqrt(det))};
}
}  // namespace

CellSums CellGrid::single(const LatticePoint& p) const
{
	const std::int64_t dx = p.u - centre(index(p.u)), dy = p.v - centre(index(p.v));
	const std::int64_t cx = coarse(dx), cy = coarse(dy);
	return {1, dx, dy, cx * cx, cx * cy, cy * cy};
}

void CellGrid::checkPossible(const CellSums& s) const
{
	const std::int64_t half = edge_ / 2, n = s.n;
	const std::int64_t halfCoarse = coarse(half), maxSquare = halfCoarse * halfCoarse;
	const auto outside = [](std::int64_t v, std::int64_t lo, std::int64_t hi) { return v < lo || v > hi; };
	bool bad = outside(s.sx, -n * half, n * half) || outside(s.sy, -n * half, n * half);
	bad = bad || outside(s.sxx, 0, n * maxSquare) || outside(s.syy, 0, n * maxSquare);
	bad = bad || outside(s.sxy, -n * maxSquare, n * maxSquare);
	// Cauchy-Schwarz for the rounded offsets, whose sums differ from sx / 16 by at most n / 2.
	const auto shortOf = [&](std::int64_t second, std::int64_t first)
	{
		const double least = std::max(0.0, std::abs(double(first)) / double(momentShift) - 0.5 * double(n));
		return double(second) * double(n) < least * least * (1 - 1e-9);
	};
	bad = bad || shortOf(s.sxx, s.sx) || shortOf(s.syy, s.sy);
	bad = bad || double(s.sxy) * double(s.sxy) > double(s.sxx) * double(s.syy) * (1 + 1e-9);
	if (bad) throw std::invalid_argument("ridge map: these cell sums belong to no set of measurements");
}

CellSums& Block::findOrAdd(CellKey key)
{
	auto it = std::lower_bound(cells.begin(), cells.end(), key, keyLess);
	if (it == cells.end() || it->key != key) it = cells.insert(it, Cell{key, {}});
	return it->sums;
}

const Cell* Block::find(CellKey key) const
{
	const auto it = std::lower_bound(cells.begin(), cells.end(), key, keyLess);
	return it != cells.end() && it->key == key ? &*it : nullptr;
}

void Block::dropEmpty()
{
	cells.erase(std::remove_if(cells.begin(), cells.end(), [](const Cell& c) { return c.sums.n == 0; }), cells.end());
}

void Block::rebuild(const CellGrid& grid)
{
	kernels.assign((cells.size() + 7) / 8, KernelGroup{});
	weight = 0;
	minX = minY = 1e30f;
	maxX = maxY = -1e30f;
	for (std::size_t i = 0; i < cells.size(); i++)
	{
		const Kernel k = makeKernel(cells[i], grid);
		KernelGroup& g = kernels[i / 8];
		const std::size_t lane = i % 8;
		g.x[lane] = k.x;
		g.y[lane] = k.y;
		g.a[lane] = k.a;
		g.b[lane] = k.b;
		g.c[lane] = k.c;
		g.w[lane] = k.w;
		minX = std::min(minX, k.x);
		maxX = std::max(maxX, k.x);
		minY = std::min(minY, k.y);
		maxY = std::max(maxY, k.y);
		weight += double(cells[i].sums.n);
	}
}

std::size_t Block::memoryBytes() const
{
	return sizeof(Block) + cells.capacity() * sizeof(Cell) + kernels.capacity() * sizeof(KernelGroup);
}

Vec2 centroidInBlock(const Cell& cell, const CellGrid& grid)
{
	const double n = cell.sums.n;
	const double half = 0.5 * double(Frame::quantaPerBlock);
	const double cx = double(grid.centre(cellColumn(cell.key))) - half,
				 cy = double(grid.centre(cellRow(cell.key))) - half;
	return {(cx + double(cell.sums.sx) / n) / double(Frame::quantaPerSigma),
			(cy + double(cell.sums.sy) / n) / double(Frame::quantaPerSigma)};
}

}  // namespace ridgemap
