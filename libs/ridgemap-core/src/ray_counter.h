// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "free_ray.h"
#include "free_tile.h"

namespace ridgemap
{
/** Counts rays into tiles. Within a strip of columns of one tile a ray passes two tiles at most: the cells before and
 * behind the column where it goes from one to the other are counted without lookups and without branches. */
class RayCounter
{
 public:
	explicit RayCounter(CounterTiles& tiles) : tiles_(tiles) {}

	/** Puts rays in (sign +1) or takes them out (-1); O(cells crossed). */
	void count(const std::vector<LatticeRay>& rays, int sign);

	/** Tiles that were changed, some maybe more than once. */
	const std::vector<TileKey>& touched() const { return touched_; }

 private:
	template <bool steep>
	struct Strip;
	template <bool steep>
	void count(const RayWalk& walk, PackedSums sums);
	PackedSums* cellsOf(TileKey key);
	PackedSums* find(TileKey key);

	/** The rays of a scan pass the same tiles again and again: these are found without the map. */
	struct Known
	{
		TileKey key;
		PackedSums* cells = nullptr;
	};
	static constexpr std::int32_t knownAcross = 16;
	static std::size_t placeOf(TileKey key)
	{
		return std::size_t((key.y & (knownAcross - 1)) * knownAcross + (key.x & (knownAcross - 1)));
	}

	CounterTiles& tiles_;
	std::uint32_t reserved_ = 0;  ///< rays that each known tile has room for
	std::array<Known, knownAcross * knownAcross> known_{};
	std::vector<TileKey> touched_;
};

}  // namespace ridgemap
