// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_block.h"

#include <algorithm>
#include <stdexcept>

#include "kernel_merge.h"

namespace ridgemap
{
namespace
{
constexpr std::int64_t momentShift = CellSums::momentShift;

/** Rounds to the nearest multiple of 16 quanta, halves upwards. */
std::int64_t coarse(std::int64_t offset)
{
	return floorDiv(offset + momentShift / 2, momentShift);
}

bool keyLess(const Cell& c, CellKey k)
{
	return c.key < k;
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
	// A single measurement leaves no freedom.
	if (n == 1)
	{
		const std::int64_t cx = coarse(s.sx), cy = coarse(s.sy);
		bad = bad || s.sxx != cx * cx || s.sxy != cx * cy || s.syy != cy * cy;
	}
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
	points.clear();
	weight = 0;
	for (const Cell& c : cells)
	{
		const Vec2 p = centroidInBlock(c, grid);
		points.push_back({float(p.x), float(p.y), c.sums.n});
		weight += double(c.sums.n);
	}
	makeKernels(*this, grid);
}

std::size_t Block::memoryBytes() const
{
	return sizeof(Block) + cells.capacity() * sizeof(Cell) + kernels.capacity() * sizeof(KernelGroup) +
		   points.capacity() * sizeof(CellPoint);
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
