// SPDX-License-Identifier: BSD-3-Clause
#include "ray_counter.h"

#include <algorithm>

namespace ridgemap
{
inline PackedSums* RayCounter::cellsOf(TileKey key)
{
	const Known& k = known_[placeOf(key)];
	return k.cells && k.key == key ? k.cells : find(key);
}

PackedSums* RayCounter::find(TileKey key)
{
	CounterTile& tile = tileAt(tiles_, key);
	tile.reserve(reserved_);
	touched_.push_back(key);
	known_[placeOf(key)] = {key, tile.packed()};
	return tile.packed();
}

template <bool steep>
void RayCounter::count(RayWalk walk, PackedSums sums)
{
	constexpr std::int64_t edge = CounterTile::edge, along = steep ? edge : 1, across = steep ? 1 : edge;
	const auto tileAtRow = [&](std::int64_t column, std::int64_t row)
	{ return cellsOf(steep ? CounterTile::keyOf(row, column) : CounterTile::keyOf(column, row)); };
	const auto place = [](std::int64_t column, std::int64_t row)
	{ return (column & (edge - 1)) * along + (row & (edge - 1)) * across; };
	std::int64_t entering = walk.rowAt(walk.firstColumn());
	for (std::int64_t first = walk.firstColumn(), last; first <= walk.lastColumn(); first = last + 1)
	{
		last = std::min(walk.lastColumn(), first | (edge - 1));
		const std::int64_t leaving = walk.rowAt(last + 1);
		PackedSums* const tile = tileAtRow(first, entering);
		if ((entering & -edge) == (leaving & -edge))
		{
			PackedSums* cell = tile + place(first, entering);
			const std::int64_t beside = walk.rowStep() * across;
			walk.forEachColumn(first, last,
							   [=](std::int64_t, std::int64_t row, std::int64_t next) mutable
							   {
								   // Without a branch, which could not be predicted.
								   const std::int64_t changes = -std::int64_t(next != row);
								   *cell += sums;
								   cell += beside & changes;
								   *cell += sums & PackedSums(changes);
								   cell += along;
							   });
		}
		else
		{
			PackedSums* const other = tileAtRow(first, leaving);
			walk.forEachColumn(first, last,
							   [=](std::int64_t column, std::int64_t row, std::int64_t next)
							   {
								   const auto tileOf = [&](std::int64_t r)
								   { return (r & edge) == (entering & edge) ? tile : other; };
								   tileOf(row)[place(column, row)] += sums;
								   tileOf(next)[place(column, next)] += sums & -PackedSums(next != row);
							   });
		}
		entering = leaving;
	}
}

void RayCounter::count(const std::vector<LatticeRay>& rays, int sign)
{
	constexpr std::size_t most = CounterTile::maxReserved;
	for (std::size_t begin = 0; begin < rays.size(); begin += most)
	{
		const std::size_t end = std::min(rays.size(), begin + most);
		known_.fill({});
		reserved_ = std::uint32_t(end - begin);
		for (std::size_t i = begin; i < end; i++)
		{
			const RayWalk walk(rays[i]);
			const PackedSums sums = pack({sign, sign * rays[i].a, sign * rays[i].b});
			walk.steep() ? count<true>(walk, sums) : count<false>(walk, sums);
		}
	}
}

}  // namespace ridgemap
