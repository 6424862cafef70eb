// SPDX-License-Identifier: BSD-3-Clause
#include "tile.h"

#include <algorithm>

namespace ridgemap
{
TileStore::TileStore(const TileStore& o) : blocksPerEdge_(o.blocksPerEdge_), sided_(o.sided_)
{
	tiles_.reserve(o.tiles_.size());
	for (const auto& entry : o.tiles_) tiles_.emplace(entry.first, std::make_unique<Tile>(*entry.second));
}

TileStore& TileStore::operator=(const TileStore& o)
{
	TileStore copy(o);
	*this = std::move(copy);
	return *this;
}

Tile& TileStore::at(TileKey key)
{
	std::unique_ptr<Tile>& slot = tiles_[key];
	if (!slot)
	{
		slot = std::make_unique<Tile>();
		slot->blocks.resize(std::size_t(blocksPerEdge_) * std::size_t(blocksPerEdge_));
	}
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
