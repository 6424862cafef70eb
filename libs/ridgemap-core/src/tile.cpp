// SPDX-License-Identifier: BSD-3-Clause
#include "tile.h"

#include <algorithm>

#include "shared.h"

namespace ridgemap
{
Tile* TileStore::own(TileKey key)
{
	const auto it = tiles_.find(key);
	return it == tiles_.end() ? nullptr : &ridgemap::own(it->second);
}

Tile& TileStore::at(TileKey key)
{
	if (Tile* present = own(key)) return *present;
	std::shared_ptr<Tile>& slot = tiles_[key];
	slot = std::make_shared<Tile>();
	slot->blocks.resize(std::size_t(blocksPerEdge_) * std::size_t(blocksPerEdge_));
	return *slot;
}

std::vector<TileKey> TileStore::keys() const
{
	std::vector<TileKey> result;
	result.reserve(tiles_.size());
	for (const auto& entry : tiles_) result.push_back(entry.first);
	std::sort(result.begin(), result.end());
	return result;
}

}  // namespace ridgemap
