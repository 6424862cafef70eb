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
inline PackedSums* RayCounter::cellAt(std::int64_t column, std::int64_t row)
{
	const std::int64_t cx = steep ? row : column, cy = steep ? column : row;
	return cellsOf(CounterTile::keyOf(cx, cy)) + CounterTile::slot(cx, cy);
}

template <bool steep>
inline void RayCounter::countColumn(std::int64_t column, std::int64_t row, std::int64_t leaving, PackedSums sums)
{
	*cellAt<steep>(column, row) += sums;
	if (leaving != row) *cellAt<steep>(column, leaving) += sums;
}

template <bool steep>
inline void RayCounter::countInTile(const RayWalk& walk, std::int64_t first, std::int64_t end, std::int64_t row,
									PackedSums sums)
{
	constexpr std::int64_t edge = CounterTile::edge, along = steep ? edge : 1, across = steep ? 1 : edge;
	const std::int64_t beside = walk.rowStep() * across;
	PackedSums* cell = cellAt<steep>(first, row);
	auto [fraction, perColumn] = walk.fractionAt(first);
	for (std::int64_t i = first; i < end; i++)
	{
		// Without a branch, which could not be predicted: where the row stays, zero is added beside it.
		fraction += perColumn;
		const PackedSums leaves = -PackedSums(fraction < perColumn);
		*cell += sums;
		cell[beside] += sums & leaves;
		cell += along + (beside & std::int64_t(leaves));
	}
}

template <bool steep>
void RayCounter::count(const RayWalk& walk, PackedSums sums)
{
	constexpr std::int64_t edge = CounterTile::edge;
	const std::int64_t begin = walk.firstColumn(), end = walk.lastColumn();
	std::int64_t row = walk.rowAt(begin + 1);
	countColumn<steep>(begin, walk.rowAt(begin), row, sums);
	if (begin == end) return;
	for (std::int64_t first = begin + 1, next; first < end; first = next)
	{
		next = std::min(end, (first | (edge - 1)) + 1);
		const std::int64_t leaving = walk.rowAt(next);
		if ((row & -edge) == (leaving & -edge))
			countInTile<steep>(walk, first, next, row, sums);
		else
		{
			const std::int64_t border = walk.rowStep() > 0 ? leaving & -edge : leaving | (edge - 1);
			const std::int64_t crossing = walk.columnLeavingFor(border);
			if (first < crossing) countInTile<steep>(walk, first, crossing, row, sums);
			countColumn<steep>(crossing, border - walk.rowStep(), border, sums);
			if (crossing + 1 < next) countInTile<steep>(walk, crossing + 1, next, border, sums);
		}
		row = leaving;
	}
	countColumn<steep>(end, row, walk.rowAt(end + 1), sums);
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
