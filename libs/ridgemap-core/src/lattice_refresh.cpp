// SPDX-License-Identifier: BSD-3-Clause
// What is made from the cells, brought up to date: places of measurements, values at nodes.
#include <algorithm>
#include <array>
#include <unordered_map>

#include "lattice.h"
#include "parallel.h"

namespace ridgemap
{
/** Brings the nodes around a block up to date with its cells; returns how many kernels that took. */
template <class NodesOf>
std::size_t Lattice::spreadChanges(Block& block, SpreadScratch& scratch, NodesOf nodesOf) const
{
	std::size_t kernels = 0;
	std::uint32_t bin = 0;
	const auto nodesOfBin = [&](int dx, int dy) -> std::vector<std::int64_t>& { return nodesOf(bin, dx, dy); };
	for (const Cell& old : block.before)
	{
		if (cellBin(old.key) != bin) spreader_.finish(scratch, nodesOfBin);  // cells come bin by bin
		bin = cellBin(old.key);
		const Cell* now = block.find(old.key);
		const CellSums& after = now ? now->sums : CellSums{};
		if (after == old.sums) continue;
		kernels += std::size_t(old.sums.n > 0) + std::size_t(after.n > 0);
		spreader_.spread(old.key, old.sums, after, scratch, nodesOfBin);
	}
	spreader_.finish(scratch, nodesOfBin);
	block.forgetBefore();
	return kernels;
}

/** Brings up to date what is made from the changed blocks of one tile. */
void Lattice::refreshTile(TileChanges& changes, SpreadScratch& scratch)
{
	// A tile is at least as wide as a kernel reaches.
	const std::int64_t n = tiles_.blocksPerEdge();
	std::array<Tile*, 9> around;
	for (int i = 0; i < 9; i++)
		around[std::size_t(i)] = tiles_.findOwned({changes.key.x + i % 3 - 1, changes.key.y + i / 3 - 1});
	const BlockIndex corner{(changes.key.x - 1) * n, (changes.key.y - 1) * n};
	std::vector<bool> touched(std::size_t(9 * n * n), false);
	const auto blockNear = [&](std::int64_t x, std::int64_t y) -> Block&
	{ return around[std::size_t(y / n * 3 + x / n)]->blocks[std::size_t(y % n * n + x % n)]; };
	for (const BlockIndex& b : changes.blocks)
	{
		Block& block = around[4]->blocks[slot(b)];
		block.isChanged = false;
		block.dropEmpty();
		block.rebuild(grid_);
		if (!grid_.compacts()) continue;
		const std::int64_t column = b.x - corner.x, row = b.y - corner.y;
		const auto nodesOf = [&](std::uint32_t bin, int dx, int dy) -> std::vector<std::int64_t>&
		{
			const std::int64_t x = column + dx, y = row + dy;
			touched[std::size_t(y * 3 * n + x)] = true;
			return blockNear(x, y).nodesOf(bin);
		};
		changes.kernels += spreadChanges(block, scratch, nodesOf);
	}
	for (std::int64_t i = 0; i < 9 * n * n; i++)
		if (touched[std::size_t(i)])
		{
			const std::int64_t x = i % (3 * n), y = i / (3 * n);
			blockNear(x, y).dropEmptyLayers();
			changes.touched.push_back({corner.x + x, corner.y + y});
		}
}

std::vector<Lattice::TileChanges> Lattice::changesByTile(const std::vector<BlockIndex>& blocks) const
{
	std::unordered_map<TileKey, std::size_t, TileKeyHash> indices;
	std::vector<TileChanges> result;
	const int perEdge = tiles_.blocksPerEdge(), period = 1 + (2 * spreader_.reach() + perEdge - 1) / perEdge;
	for (const BlockIndex& b : blocks)
	{
		const TileKey key = tiles_.tileOfBlock(b.x, b.y);
		const auto entry = indices.try_emplace(key, result.size());
		if (entry.second)
		{
			result.emplace_back();
			result.back().key = key;
			result.back().colour =
				int(key.x - floorDiv(key.x, period) * period + period * (key.y - floorDiv(key.y, period) * period));
		}
		result[entry.first->second].blocks.push_back(b);
	}
	std::stable_sort(result.begin(), result.end(),
					 [](const TileChanges& a, const TileChanges& b) { return a.colour < b.colour; });
	return result;
}

/** Makes the tiles that changes of these blocks may reach, and parts them from those of copies; returns those that were
 * not there. */
std::vector<TileKey> Lattice::makeTilesInReach(const std::vector<BlockIndex>& blocks)
{
	std::vector<TileKey> made;
	for (const BlockIndex& b : blocks)
	{
		std::int64_t x0 = grid_.cellsPerBlock(), x1 = 0, y0 = x0, y1 = 0;
		for (const Cell& c : blockAt(b).before)
		{
			x0 = std::min(x0, cellColumn(c.key));
			x1 = std::max(x1, cellColumn(c.key));
			y0 = std::min(y0, cellRow(c.key));
			y1 = std::max(y1, cellRow(c.key));
		}
		if (x0 > x1) continue;
		const KernelSpreader::Box first = spreader_.blocksInReach(makeCellKey(0, x0, y0)),
								  last = spreader_.blocksInReach(makeCellKey(0, x1, y1));
		const TileKey low = tiles_.tileOfBlock(b.x + first.x0, b.y + first.y0),
					  high = tiles_.tileOfBlock(b.x + last.x1 - 1, b.y + last.y1 - 1);
		for (TileKey key{low.x, low.y}; key.y <= high.y; key.y++)
			for (key.x = low.x; key.x <= high.x; key.x++)
			{
				if (tiles_.own(key)) continue;
				tiles_.at(key);
				made.push_back(key);
			}
	}
	return made;
}

Lattice::Changes Lattice::refresh(unsigned threads)
{
	Changes changes;
	if (tiles_.isSided() != (directed_ > 0))
	{
		// Everything is to be looked at in another way.
		tiles_.setSided(directed_ > 0);
		changes.values = occupiedBlocks();
		for (const BlockIndex& b : changes.values)
			if (Block& block = blockAt(b); !block.cells.empty()) noteChange(b, block);
	}
	changes.cells = std::move(changed_);
	changed_.clear();
	std::sort(changes.cells.begin(), changes.cells.end());
	const std::vector<TileKey> made = makeTilesInReach(changes.cells);
	std::vector<TileChanges> list = changesByTile(changes.cells);
	std::vector<SpreadScratch> scratch(std::max(1u, threads));
	for (std::size_t first = 0, last; first < list.size(); first = last)
	{
		for (last = first; last < list.size() && list[last].colour == list[first].colour;) last++;
		parallelFor(last - first, threads,
					[&](std::size_t i, std::size_t t) { refreshTile(list[first + i], scratch[t]); });
	}
	for (const TileChanges& tile : list)
	{
		changes.kernels += tile.kernels;
		changes.values.insert(changes.values.end(), tile.touched.begin(), tile.touched.end());
	}
	if (!grid_.compacts()) changes.values = changes.cells;
	std::sort(changes.values.begin(), changes.values.end());
	changes.values.erase(std::unique(changes.values.begin(), changes.values.end()), changes.values.end());
	const auto isEmpty = [](const Block& b) { return b.layers.empty() && b.cells.empty(); };
	for (const TileKey& key : made)
		if (const auto& b = tiles_.find(key)->blocks; std::all_of(b.begin(), b.end(), isEmpty)) tiles_.remove(key);
	return changes;
}

/** All blocks that hold something. */
std::vector<BlockIndex> Lattice::occupiedBlocks() const
{
	std::vector<BlockIndex> result;
	const std::int64_t n = tiles_.blocksPerEdge();
	for (const TileKey& key : tiles_.keys())
	{
		const Tile& tile = *tiles_.find(key);
		for (std::size_t i = 0; i < tile.blocks.size(); i++)
			if (const Block& b = tile.blocks[i]; !b.layers.empty() || !b.cells.empty())
				result.push_back({key.x * n + std::int64_t(i) % n, key.y * n + std::int64_t(i) / n});
	}
	return result;
}

}  // namespace ridgemap
