// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_block.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "shared.h"

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

void Block::remember(CellKey key, const CellSums& sums)
{
	if (before.empty() || before.back().key < key) return before.push_back({key, sums});  // as scans come, in order
	const auto it = std::lower_bound(before.begin(), before.end(), key, keyLess);
	if (it->key != key) before.insert(it, Cell{key, sums});
}

void Block::forgetBefore()
{
	constexpr std::size_t usual = 8;
	if (before.capacity() > usual)
		before = std::vector<Cell>();
	else
		before.clear();
}

SharedNodes::Values& SharedNodes::own()
{
	if (!values_) values_ = std::make_shared<Values>();
	return ridgemap::own(values_);
}

std::vector<std::int64_t>& Block::nodesOf(std::uint32_t bin)
{
	auto it = layers.begin();
	while (it != layers.end() && it->bin < bin) ++it;
	if (it == layers.end() || it->bin != bin) it = layers.insert(it, {bin, {}});
	return it->nodes.own();
}

const std::int64_t* Block::findNodes(std::uint32_t bin) const
{
	for (const NodeLayer& l : layers)
		if (l.bin == bin) return l.nodes.data();
	return nullptr;
}

void Block::dropEmptyLayers()
{
	const auto isEmpty = [](const NodeLayer& l) { return l.nodes.empty(); };
	layers.erase(std::remove_if(layers.begin(), layers.end(), isEmpty), layers.end());
}

void Block::rebuild(const CellGrid& grid)
{
	points.clear();
	weight = 0;
	for (const Cell& c : cells)
	{
		const Vec2 p = centroidInBlock(c, grid);
		points.push_back({float(p.x), float(p.y), cellBin(c.key)});
		weight += double(c.sums.n);
	}
	kernels = KernelList();
	if (!grid.compacts()) makeKernels(grid);
}

void Block::makeKernels(const CellGrid& grid)
{
	if (kernels.count == cells.size()) return;
	for (const Cell& c : cells) kernels.add(momentsOf(c, grid));
}

std::size_t Block::memoryBytes() const
{
	return sizeof(Block) + (cells.capacity() + before.capacity()) * sizeof(Cell) +
		   points.capacity() * sizeof(CellPoint) +
		   layers.size() * nodesPerBlock * nodesPerBlock * sizeof(std::int64_t) +
		   kernels.groups.capacity() * sizeof(KernelGroup);
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

CellMoments momentsOf(const Cell& cell, const CellGrid& grid)
{
	CellMoments m;
	m.n = cell.sums.n;
	m.mean = centroidInBlock(cell, grid);
	const double quantum = double(Frame::quantaPerSigma), unit = double(CellSums::momentShift) / quantum;
	const double mx = double(cell.sums.sx) / m.n / quantum, my = double(cell.sums.sy) / m.n / quantum;
	m.xx = std::max(0.0, double(cell.sums.sxx) / m.n * unit * unit - mx * mx);
	m.yy = std::max(0.0, double(cell.sums.syy) / m.n * unit * unit - my * my);
	const double limit = std::sqrt(m.xx * m.yy);
	m.xy = std::max(-limit, std::min(limit, double(cell.sums.sxy) / m.n * unit * unit - mx * my));
	return m;
}

void KernelList::add(const CellMoments& m)
{
	const std::size_t lane = count % 8;
	if (lane == 0) groups.push_back(KernelGroup{});
	count++;
	KernelGroup& g = groups.back();
	const double det = (1 + m.xx) * (1 + m.yy) - m.xy * m.xy;
	g.x[lane] = float(m.mean.x);
	g.y[lane] = float(m.mean.y);
	g.a[lane] = float((1 + m.yy) / det);
	g.b[lane] = float(-m.xy / det);
	g.c[lane] = float((1 + m.xx) / det);
	g.w[lane] = float(m.n / std::sqrt(det));
	minX = std::min(minX, g.x[lane]);
	maxX = std::max(maxX, g.x[lane]);
	minY = std::min(minY, g.y[lane]);
	maxY = std::max(maxY, g.y[lane]);
}

}  // namespace ridgemap
