// SPDX-License-Identifier: BSD-3-Clause
#include "tile_update.h"

#include <algorithm>
#include <set>

#include "border.h"
#include "parallel.h"
#include "tracer.h"

namespace ridgemap
{
namespace
{
/** Tiles whose field can reach one of the blocks, in canonical order. */
std::vector<TileKey> dependentTiles(const std::vector<BlockIndex>& blocks, const TileStore& tiles,
									const Options& options)
{
	const int halo = TileField::haloBlocks(options.cutoff);
	std::set<TileKey> keys;
	for (const BlockIndex& b : blocks)
	{
		const TileKey low = tiles.tileOfBlock(b.x - halo, b.y - halo), high = tiles.tileOfBlock(b.x + halo, b.y + halo);
		for (std::int32_t y = low.y; y <= high.y; y++)
			for (std::int32_t x = low.x; x <= high.x; x++) keys.insert({x, y});
	}
	return {keys.begin(), keys.end()};
}

/** Groups of tiles that touch each other, as boxes of the map frame: the update regions. */
std::vector<UpdateRegion> findRegions(const std::vector<TileKey>& keys, const Lattice& lattice)
{
	std::set<TileKey> left(keys.begin(), keys.end());
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
	return t.cellCount == 0 && t.pieces.empty() && t.stubs.empty() && t.corner == Vec2{} && t.bottom.path.size() <= 2 &&
		   t.left.path.size() <= 2 && t.bottom.crossings.empty() && t.left.crossings.empty();
}
}  // namespace

std::vector<ReplacedTile> updateTiles(Lattice& lattice, const Options& options, unsigned threads, UpdateResult& result)
{
	TileStore& tiles = lattice.tiles();
	const std::vector<TileKey> keys = dependentTiles(lattice.refresh(), tiles, options);
	for (const TileKey& k : keys) tiles.at(k);
	std::vector<TileField> fields;
	fields.reserve(keys.size());
	for (const TileKey& k : keys) fields.emplace_back(tiles, k, options);

	const auto cornerOf = [&](TileKey k)
	{
		const Tile* t = tiles.find(k);
		return t ? t->corner : Vec2{};
	};
	parallelFor(keys.size(), threads,
				[&](std::size_t i) { tiles.find(keys[i])->corner = placeCorner(fields[i], options); });
	parallelFor(keys.size(), threads,
				[&](std::size_t i)
				{
					const TileKey k = keys[i];
					const double edge = tiles.tileEdge();
					Tile& tile = *tiles.find(k);
					tile.bottom = layEdge(fields[i], tile.corner, Vec2{edge, 0} + cornerOf({k.x + 1, k.y}), options);
					tile.left = layEdge(fields[i], tile.corner, Vec2{0, edge} + cornerOf({k.x, k.y + 1}), options);
				});
	std::vector<TileTrace> traces(keys.size());
	parallelFor(keys.size(), threads,
				[&](std::size_t i)
				{
					TileBorder border(tiles, keys[i]);
					traces[i] = traceTile(fields[i], border, options);
				});

	std::vector<ReplacedTile> replaced;
	for (std::size_t i = 0; i < keys.size(); i++)
	{
		Tile& tile = *tiles.find(keys[i]);
		for (std::size_t r = 0; r < traces[i].stops.size(); r++) result.stops[r] += traces[i].stops[r];
		result.seeds += traces[i].seeds;
		result.evaluations += fields[i].work().evaluations;
		result.kernels += fields[i].work().kernels;
		tile.stubs = std::move(traces[i].stubs);
		if (tile.pieces == traces[i].pieces) continue;
		replaced.push_back({keys[i], tile.chainOfPiece});
		tile.pieces = std::move(traces[i].pieces);
		tile.chainOfPiece.assign(tile.pieces.size(), 0);
	}
	for (const TileKey& k : keys)
		if (isDefault(*tiles.find(k))) tiles.remove(k);
	result.tiles += keys.size();
	result.regions = findRegions(keys, lattice);
	return replaced;
}

}  // namespace ridgemap
