// SPDX-License-Identifier: BSD-3-Clause
#include "tile_update.h"

#include <algorithm>
#include <memory>
#include <set>
#include <unordered_map>

#include "border.h"
#include "parallel.h"
#include "stopwatch.h"
#include "tracer.h"

namespace ridgemap
{
namespace
{
/** A tile that a change may touch, and what is known of it on the way. */
struct Work
{
	TileKey key;
	BlockMask changed;  ///< blocks in and around the tile that changed
	Tile* tile = nullptr;
	std::unique_ptr<TileTrace> trace;
	bool touched = false, cornerMoved = false, bordersChanged = false;
	FieldWork done;
	double borderSeconds = 0;

	void note(const TileField& field)
	{
		touched = true;
		done.evaluations += field.work().evaluations;
		done.kernels += field.work().kernels;
	}
};

/** Collects the tiles whose field looks at something that changed. */
class Dependents
{
 public:
	Dependents(TileStore& tiles, int halo) : tiles_(tiles), halo_(halo) {}

	/** Marks the blocks in the tiles that are at most `reach` blocks away. */
	void mark(const std::vector<BlockIndex>& blocks, int reach)
	{
		const int perEdge = tiles_.blocksPerEdge();
		for (const BlockIndex& b : blocks)
		{
			const TileKey low = tiles_.tileOfBlock(b.x - reach, b.y - reach),
						  high = tiles_.tileOfBlock(b.x + reach, b.y + reach);
			for (std::int32_t y = low.y; y <= high.y; y++)
				for (std::int32_t x = low.x; x <= high.x; x++)
				{
					const int column = int(b.x - std::int64_t(x) * perEdge) + halo_;
					at({x, y}).changed.add(int(b.y - std::int64_t(y) * perEdge) + halo_, column, column);
				}
		}
	}

	/** In canonical order. */
	std::vector<Work> take()
	{
		std::sort(works_.begin(), works_.end(), [](const Work& a, const Work& b) { return a.key < b.key; });
		return std::move(works_);
	}

 private:
	Work& at(TileKey key)
	{
		// Most blocks lie in the tile of the one before.
		if (last_ < works_.size() && works_[last_].key == key) return works_[last_];
		last_ = indices_.try_emplace(key, works_.size()).first->second;
		if (last_ == works_.size())
		{
			works_.emplace_back();
			works_.back().key = key;
			works_.back().tile = &tiles_.at(key);
			works_.back().changed = BlockMask(tiles_.blocksPerEdge() + 2 * halo_);
		}
		return works_[last_];
	}

	TileStore& tiles_;
	int halo_;
	std::vector<Work> works_;
	std::unordered_map<TileKey, std::size_t, TileKeyHash> indices_;
	std::size_t last_ = 0;
};

/** Tiles whose field can reach something that changed, in canonical order. */
std::vector<Work> dependentTiles(const Lattice::Changes& changes, TileStore& tiles, const Options& options)
{
	const int halo = TileField::haloBlocks(options.cutoff);
	Dependents dependents(tiles, halo);
	dependents.mark(changes.cells, halo);
	dependents.mark(changes.values, CellGrid(options).compacts() ? TileField::haloOfNodes() : halo);
	return dependents.take();
}

/** Groups of tiles that touch each other, as boxes of the map frame: the update regions. */
std::vector<UpdateRegion> findRegions(const std::vector<Work>& works, const Lattice& lattice)
{
	std::set<TileKey> left;
	for (const Work& w : works) left.insert(w.key);
	std::vector<UpdateRegion> regions;
	const double edge = lattice.tiles().tileEdge();
	while (!left.empty())
	{
		UpdateRegion region;
		std::vector<TileKey> open{*left.begin()};
		left.erase(left.begin());
		while (!open.empty())
		{
			const TileKey k = open.back();
			open.pop_back();
			region.tiles++;
			for (const Vec2& c : {Vec2{0, 0}, Vec2{edge, 0}, Vec2{0, edge}, Vec2{edge, edge}})
				region.box.extend(lattice.frame().toMap(lattice.tiles().toLattice(k, c)));
			for (int dy = -1; dy <= 1; dy++)
				for (int dx = -1; dx <= 1; dx++)
				{
					const auto it = left.find({k.x + dx, k.y + dy});
					if (it == left.end()) continue;
					open.push_back(*it);
					left.erase(it);
				}
		}
		regions.push_back(region);
	}
	return regions;
}

bool isDefault(const Tile& t)
{
	const auto hasNodes = [](const Block& b) { return !b.layers.empty(); };
	return t.cellCount == 0 && std::none_of(t.blocks.begin(), t.blocks.end(), hasNodes) && t.pieces.empty() &&
		   t.stubs.empty() && t.corner == Vec2{} && t.bottom.path.size() <= 2 && t.left.path.size() <= 2 &&
		   t.bottom.crossings.empty() && t.left.crossings.empty();
}

/** The three stages of an update. Each looks only at what the stage before has finished, and is skipped where nothing
 * changed among the blocks that it looked at the last time. */
class TileUpdate
{
 public:
	TileUpdate(TileStore& tiles, const Options& options, unsigned threads, std::vector<Work>& works)
		: tiles_(tiles), options_(options), works_(works), scratch_(std::max(1u, threads) - 1)
	{
	}

	void placeCorners(Work& w, std::size_t thread)
	{
		if (!w.tile->cornerReach.intersects(w.changed)) return;
		const Stopwatch watch;
		TileField field(tiles_, w.key, options_, &scratchOf(thread));
		const Vec2 corner = placeCorner(field, options_);
		w.tile->cornerReach = field.reach();
		w.note(field);
		w.cornerMoved = !(corner == w.tile->corner);
		w.tile->corner = corner;
		w.borderSeconds += watch.seconds();
	}

	void layBorders(Work& w, std::size_t thread)
	{
		const TileKey right{w.key.x + 1, w.key.y}, above{w.key.x, w.key.y + 1};
		const bool moved = w.cornerMoved || has(right, &Work::cornerMoved) || has(above, &Work::cornerMoved);
		if (!moved && !w.tile->borderReach.intersects(w.changed)) return;
		const Stopwatch watch;
		const double edge = tiles_.tileEdge();
		TileField field(tiles_, w.key, options_, &scratchOf(thread));
		Edge bottom = layEdge(field, w.tile->corner, Vec2{edge, 0} + cornerOf(right), options_);
		Edge left = layEdge(field, w.tile->corner, Vec2{0, edge} + cornerOf(above), options_);
		w.tile->borderReach = field.reach();
		w.note(field);
		w.bordersChanged = !(bottom == w.tile->bottom && left == w.tile->left);
		w.tile->bottom = std::move(bottom);
		w.tile->left = std::move(left);
		w.borderSeconds += watch.seconds();
	}

	void trace(Work& w, std::size_t thread)
	{
		const TileKey right{w.key.x + 1, w.key.y}, above{w.key.x, w.key.y + 1};
		const bool borders = w.bordersChanged || has(right, &Work::bordersChanged) || has(above, &Work::bordersChanged);
		if (!borders && !w.tile->traceReach.intersects(w.changed)) return;
		TileField field(tiles_, w.key, options_, &scratchOf(thread));
		TileBorder border(tiles_, w.key);
		w.trace = std::make_unique<TileTrace>(traceTile(field, border, options_));
		w.tile->traceReach = field.reach();
		w.note(field);
	}

 private:
	/** That of the calling thread stays from one update to the next (70 KiB, nine times that with sides), so that small
	 * updates do not ask the system for memory. */
	FieldScratch& scratchOf(std::size_t thread)
	{
		static thread_local FieldScratch callers;
		return thread == 0 ? callers : scratch_[thread - 1];
	}

	bool has(TileKey key, bool Work::*flag) const
	{
		const auto it =
			std::lower_bound(works_.begin(), works_.end(), key, [](const Work& w, TileKey k) { return w.key < k; });
		return it != works_.end() && it->key == key && (*it).*flag;
	}

	Vec2 cornerOf(TileKey key) const
	{
		const Tile* t = tiles_.find(key);
		return t ? t->corner : Vec2{};
	}

	TileStore& tiles_;
	const Options& options_;
	std::vector<Work>& works_;
	std::vector<FieldScratch> scratch_;  ///< one for every thread but the caller's
};

/** Puts the new pieces of a tile in the place of the old ones. */
void replacePieces(Work& w, UpdateResult& result, std::vector<ReplacedTile>& replaced)
{
	Tile& tile = *w.tile;
	for (std::size_t r = 0; r < w.trace->stops.size(); r++) result.stops[r] += w.trace->stops[r];
	result.tiles++;
	result.seeds += w.trace->seeds;
	result.traces += w.trace->traces;
	result.seconds += w.trace->seconds;
	tile.stubs = std::move(w.trace->stubs);
	if (tile.pieces == w.trace->pieces) return;
	replaced.push_back({w.key, tile.chainOfPiece});
	tile.pieces = std::move(w.trace->pieces);
	tile.chainOfPiece.assign(tile.pieces.size(), 0);
}
}  // namespace

std::vector<ReplacedTile> updateTiles(Lattice& lattice, const Options& options, unsigned threads, UpdateResult& result)
{
	TileStore& tiles = lattice.tiles();
	const Stopwatch watch;
	const Lattice::Changes changes = lattice.refresh(threads);
	result.seconds.kernels = watch.seconds();
	result.kernels += changes.kernels;
	std::vector<Work> works = dependentTiles(changes, tiles, options);
	TileUpdate update(tiles, options, threads, works);
	parallelFor(works.size(), threads, [&](std::size_t i, std::size_t t) { update.placeCorners(works[i], t); });
	parallelFor(works.size(), threads, [&](std::size_t i, std::size_t t) { update.layBorders(works[i], t); });
	parallelFor(works.size(), threads, [&](std::size_t i, std::size_t t) { update.trace(works[i], t); });

	std::vector<ReplacedTile> replaced;
	for (Work& w : works)
	{
		result.evaluations += w.done.evaluations;
		result.kernels += w.done.kernels;
		result.seconds.borders += w.borderSeconds;
		if (w.trace) replacePieces(w, result, replaced);
	}
	works.erase(std::remove_if(works.begin(), works.end(), [](const Work& w) { return !w.touched; }), works.end());
	result.regions = findRegions(works, lattice);
	for (const Work& w : works)
		if (isDefault(*w.tile)) tiles.remove(w.key);
	return replaced;
}

}  // namespace ridgemap
