// SPDX-License-Identifier: BSD-3-Clause
#include "lattice.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace ridgemap
{
namespace
{
void checkCoordinates(const Measurement& m, std::size_t index)
{
	if (std::abs(m.x) <= maxCoordinate && std::abs(m.y) <= maxCoordinate) return;
	std::ostringstream s;
	s << "ridge map: measurement " << index << " at (" << m.x << ", " << m.y << ") is not within +-" << maxCoordinate
	  << " m; leave out invalid returns or move the origin of the map";
	throw std::invalid_argument(s.str());
}
}  // namespace

Lattice::Lattice(const Options& options)
	: frame_(options.sigma),
	  grid_(options),
	  spreader_(grid_, options.cutoff),
	  sides_(options.sides && grid_.compacts()),
	  tiles_(int(options.tileEdge / double(Frame::blockEdge)))
{
}

void Lattice::clear()
{
	tiles_.clear();
	changed_.clear();
	measurements_ = directed_ = 0;
	tiles_.setSided(false);
}

std::uint32_t Lattice::binOf(const Measurement& m) const
{
	if (!sides_ || !std::isfinite(m.sensorX) || !std::isfinite(m.sensorY)) return 0;
	return directionBin(Frame::rotateToLattice({m.sensorX - m.x, m.sensorY - m.y}));
}

Lattice::Delta Lattice::makeDelta(BlockIndex block, CellKey key, const CellSums& s)
{
	return {block, key, s.n, s.sx, s.sy, s.sxx, s.sxy, s.syy};
}

std::vector<Lattice::Delta> Lattice::deltas(const std::vector<Measurement>& measurements) const
{
	std::vector<Delta> result;
	result.reserve(measurements.size());
	const std::int64_t perBlock = grid_.cellsPerBlock();
	for (std::size_t i = 0; i < measurements.size(); i++)
	{
		const Measurement& m = measurements[i];
		checkCoordinates(m, i);
		const LatticePoint q = frame_.quantise({m.x, m.y});
		const std::int64_t cx = grid_.index(q.u), cy = grid_.index(q.v);
		const BlockIndex block{floorDiv(cx, perBlock), floorDiv(cy, perBlock)};
		const CellKey key = makeCellKey(binOf(m), cx - block.x * perBlock, cy - block.y * perBlock);
		result.push_back(makeDelta(block, key, grid_.single(q)));
	}
	combine(result);
	return result;
}

void Lattice::insertCells(const std::vector<CellRecord>& cells)
{
	std::vector<Delta> list;
	list.reserve(cells.size());
	const std::int64_t perBlock = grid_.cellsPerBlock();
	// Twice the largest coordinate leaves room for the rotation and the offset of the frame.
	const double largest = 2 * frame_.largestCoordinate() * double(Frame::quantaPerSigma) / double(grid_.edge());
	for (const CellRecord& c : cells)
	{
		if (c.n == 0 || c.n > maxCountPerCell || c.bin >= (sides_ ? directionBins : 1))
			throw std::invalid_argument("ridge map: a stored cell has an impossible count or direction");
		if (std::abs(double(c.cx)) > largest || std::abs(double(c.cy)) > largest)
			throw std::invalid_argument("ridge map: a stored cell lies beyond the largest coordinate");
		const CellSums sums{c.n, c.sx, c.sy, c.sxx, c.sxy, c.syy};
		grid_.checkPossible(sums);
		const BlockIndex block{floorDiv(c.cx, perBlock), floorDiv(c.cy, perBlock)};
		list.push_back(
			makeDelta(block, makeCellKey(c.bin, c.cx - block.x * perBlock, c.cy - block.y * perBlock), sums));
	}
	combine(list);
	apply(std::move(list), +1);
}

void Lattice::combine(std::vector<Delta>& list)
{
	std::sort(list.begin(), list.end(),
			  [](const Delta& a, const Delta& b) { return a.block == b.block ? a.key < b.key : a.block < b.block; });
	std::size_t kept = 0;
	for (std::size_t i = 0; i < list.size(); i++)
	{
		if (kept > 0 && list[kept - 1].block == list[i].block && list[kept - 1].key == list[i].key)
		{
			Delta& sum = list[kept - 1];
			sum.n += list[i].n;
			if (sum.n > maxCountPerCell) continue;  // rejected later; do not let the sums overflow
			sum.sx += list[i].sx;
			sum.sy += list[i].sy;
			sum.sxx += list[i].sxx;
			sum.sxy += list[i].sxy;
			sum.syy += list[i].syy;
		}
		else
			list[kept++] = list[i];
	}
	list.resize(kept);
}

std::size_t Lattice::slot(BlockIndex b) const
{
	const std::int64_t n = tiles_.blocksPerEdge();
	const TileKey t = tiles_.tileOfBlock(b.x, b.y);
	return std::size_t((b.y - t.y * n) * n + b.x - t.x * n);
}

const Block* Lattice::findBlock(BlockIndex b) const
{
	const Tile* tile = tiles_.find(tiles_.tileOfBlock(b.x, b.y));
	return tile ? &tile->blocks[slot(b)] : nullptr;
}

/** The sums of a cell after a change; throws if they cannot be. */
CellSums Lattice::changed(const CellSums& now, const Delta& d, int sign) const
{
	CellSums s = now;
	if (sign > 0)
	{
		if (s.n + d.n > maxCountPerCell)
			throw std::overflow_error("ridge map: more than 2^31 measurements in one cell; the insertion was not done");
		return {std::uint32_t(s.n + d.n), s.sx + d.sx, s.sy + d.sy, s.sxx + d.sxx, s.sxy + d.sxy, s.syy + d.syy};
	}
	const char* missing =
		"ridge map: the map does not hold all measurements that are to be taken out; it was left as it was";
	if (s.n < d.n) throw std::invalid_argument(missing);
	s = {std::uint32_t(s.n - d.n), s.sx - d.sx, s.sy - d.sy, s.sxx - d.sxx, s.sxy - d.sxy, s.syy - d.syy};
	if (s.n == 0 && !(s == CellSums{})) throw std::invalid_argument(missing);
	try
	{
		grid_.checkPossible(s);
	}
	catch (const std::invalid_argument&)
	{
		throw std::invalid_argument(missing);
	}
	return s;
}

void Lattice::apply(std::vector<Delta> list, int sign)
{
	// The list is sorted: what belongs to the same block is looked up once.
	std::vector<CellSums> after;
	after.reserve(list.size());
	const Block* present = nullptr;
	for (std::size_t i = 0; i < list.size(); i++)
	{
		const Delta& d = list[i];
		if (i == 0 || !(d.block == list[i - 1].block)) present = findBlock(d.block);
		const Cell* cell = present ? present->find(d.key) : nullptr;
		after.push_back(changed(cell ? cell->sums : CellSums{}, d, sign));
	}
	Tile* tile = nullptr;
	Block* block = nullptr;
	for (std::size_t i = 0; i < list.size(); i++)
	{
		const Delta& d = list[i];
		if (i == 0 || !(d.block == list[i - 1].block))
		{
			tile = &tiles_.at(tiles_.tileOfBlock(d.block.x, d.block.y));
			block = &tile->blocks[slot(d.block)];
			noteChange(d.block, *block);
		}
		CellSums& sums = block->findOrAdd(d.key);
		if (grid_.compacts()) block->remember(d.key, sums);
		if (sums.n == 0) tile->cellCount++;
		if (after[i].n == 0) tile->cellCount--;
		measurements_ += std::uint64_t(after[i].n) - sums.n;
		if (cellBin(d.key) != 0) directed_ += std::uint64_t(after[i].n) - sums.n;
		sums = after[i];
	}
}

void Lattice::noteChange(BlockIndex index, Block& block)
{
	if (!block.isChanged) changed_.push_back(index);
	block.isChanged = true;
}

/** Calls fn(index, block) for every block with cells, row by row over the whole map. */
template <class Fn>
void Lattice::forEachBlock(Fn fn) const
{
	std::vector<BlockIndex> order;
	const std::int64_t n = tiles_.blocksPerEdge();
	for (const TileKey& key : tiles_.keys())
	{
		const Tile& tile = *tiles_.find(key);
		for (std::size_t i = 0; i < tile.blocks.size(); i++)
			if (!tile.blocks[i].cells.empty())
				order.push_back({key.x * n + std::int64_t(i) % n, key.y * n + std::int64_t(i) / n});
	}
	std::sort(order.begin(), order.end());
	for (const BlockIndex& b : order) fn(b, *findBlock(b));
}

std::size_t Lattice::occupiedCells() const
{
	std::size_t sum = 0;
	for (const TileKey& key : tiles_.keys()) sum += tiles_.find(key)->cellCount;
	return sum;
}

std::vector<Lattice::Delta> Lattice::allCells() const
{
	std::vector<Delta> result;
	result.reserve(occupiedCells());
	forEachBlock(
		[&](BlockIndex b, const Block& block)
		{
			for (const Cell& c : block.cells)
				if (c.sums.n > 0) result.push_back(makeDelta(b, c.key, c.sums));
		});
	return result;
}

std::vector<CellRecord> Lattice::cells() const
{
	std::vector<CellRecord> result;
	result.reserve(occupiedCells());
	const std::int64_t perBlock = grid_.cellsPerBlock();
	forEachBlock(
		[&](BlockIndex b, const Block& block)
		{
			for (const Cell& c : block.cells)
			{
				const CellSums& s = c.sums;
				if (s.n == 0) continue;
				result.push_back({b.x * perBlock + cellColumn(c.key), b.y * perBlock + cellRow(c.key), cellBin(c.key),
								  s.n, s.sx, s.sy, s.sxx, s.sxy, s.syy});
			}
		});
	return result;
}

std::vector<Point2> Lattice::centroids() const
{
	std::vector<Point2> result;
	const double edge = double(Frame::blockEdge);
	forEachBlock(
		[&](BlockIndex b, const Block& block)
		{
			for (const Cell& c : block.cells)
				if (c.sums.n > 0)
					result.push_back(frame_.toMap(Vec2{(double(b.x) + 0.5) * edge, (double(b.y) + 0.5) * edge} +
												  centroidInBlock(c, grid_)));
		});
	return result;
}

Box2 Lattice::boundingBox() const
{
	Box2 box;
	for (const Point2& p : centroids()) box.extend(p);
	return box;
}

}  // namespace ridgemap
