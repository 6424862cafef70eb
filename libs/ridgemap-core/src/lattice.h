// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/ridge_map.h>

#include <vector>

#include "field_nodes.h"
#include "frame.h"
#include "kernel_block.h"
#include "tile.h"
#include "viewing_direction.h"

namespace ridgemap
{
/** Column and row of a block of cells. */
struct BlockIndex
{
	std::int64_t x = 0, y = 0;
	friend bool operator==(BlockIndex a, BlockIndex b) { return a.x == b.x && a.y == b.y; }
	friend bool operator<(BlockIndex a, BlockIndex b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }
};

/** The measurements of a map: exact integer sums per cell, kept in the blocks of the tiles. Every change is checked as
 * a whole before anything is changed. */
class Lattice
{
 public:
	explicit Lattice(const Options& options);

	const Frame& frame() const { return frame_; }
	const CellGrid& grid() const { return grid_; }
	TileStore& tiles() { return tiles_; }
	const TileStore& tiles() const { return tiles_; }
	std::uint64_t measurements() const { return measurements_; }

	void insert(const std::vector<Measurement>& m) { apply(deltas(m), +1); }
	void erase(const std::vector<Measurement>& m) { apply(deltas(m), -1); }
	void insertCells(const std::vector<CellRecord>& cells);
	void merge(const Lattice& o) { apply(o.allCells(), +1); }
	void subtract(const Lattice& o) { apply(o.allCells(), -1); }
	void clear();

	/** All occupied cells, canonical order: blocks row by row, then by key. */
	std::vector<CellRecord> cells() const;
	std::vector<Point2> centroids() const;
	Box2 boundingBox() const;

	bool hasChanged() const { return !changed_.empty(); }
	/** What changed since the last call. */
	struct Changes
	{
		std::vector<BlockIndex> cells;   ///< blocks whose cells changed
		std::vector<BlockIndex> values;  ///< blocks where L changed; in canonical order, both
		std::size_t kernels = 0;         ///< kernels of cells spread over nodes
	};
	/** Brings up to date what is made from the cells. The result does not depend on the number of threads. */
	Changes refresh(unsigned threads = 1);

 private:
	/** What to add to or take from one cell. */
	struct Delta
	{
		BlockIndex block;
		CellKey key = 0;
		std::uint64_t n = 0;
		std::int64_t sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
	};

	std::vector<Delta> deltas(const std::vector<Measurement>& m) const;
	std::vector<Delta> allCells() const;
	std::size_t occupiedCells() const;
	std::vector<BlockIndex> occupiedBlocks() const;
	/** Bin of the viewing direction; 0 if it is not known or not to be used. */
	std::uint32_t binOf(const Measurement& m) const;
	static Delta makeDelta(BlockIndex block, CellKey key, const CellSums& s);
	/** Sorts by cell and adds up what goes to the same one. */
	static void combine(std::vector<Delta>& deltas);
	void apply(std::vector<Delta> deltas, int sign);
	CellSums changed(const CellSums& now, const Delta& d, int sign) const;
	const Block* findBlock(BlockIndex b) const;
	std::size_t slot(BlockIndex b) const;
	Block& blockAt(BlockIndex b) { return tiles_.at(tiles_.tileOfBlock(b.x, b.y)).blocks[slot(b)]; }
	/** The changed blocks of one tile, and what came of them. */
	struct TileChanges
	{
		TileKey key;
		int colour = 0;  ///< tiles of the same colour reach no common block
		std::vector<BlockIndex> blocks;
		std::vector<BlockIndex> touched;  ///< blocks where L changed, in canonical order
		std::size_t kernels = 0;
	};
	void noteChange(BlockIndex index, Block& block);
	void refreshTile(TileChanges& changes, SpreadScratch& scratch);
	std::vector<TileChanges> changesByTile(const std::vector<BlockIndex>& blocks) const;
	std::vector<TileKey> makeTilesInReach(const std::vector<BlockIndex>& blocks);
	template <class NodesOf>
	std::size_t spreadChanges(Block& block, SpreadScratch& scratch, NodesOf nodesOf) const;
	template <class Fn>
	void forEachBlock(Fn fn) const;

	Frame frame_;
	CellGrid grid_;
	KernelSpreader spreader_;
	bool sides_;  ///< viewing directions are kept
	TileStore tiles_;
	std::uint64_t measurements_ = 0;
	std::uint64_t directed_ = 0;       ///< measurements with a direction bin
	std::vector<BlockIndex> changed_;  ///< blocks whose cells changed since the last refresh, each once
};

}  // namespace ridgemap
