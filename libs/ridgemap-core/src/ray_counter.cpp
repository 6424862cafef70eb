// SPDX-License-Identifier: BSD-3-Clause
#include "ray_counter.h"

#include <algorithm>
#include <utility>

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

/** Columns of one tile, of which the ray passes no more than two: the second may be the same. */
template <bool steep>
struct RayCounter::Strip
{
	static constexpr std::int64_t edge = CounterTile::edge, along = steep ? edge : 1, across = steep ? 1 : edge;

	std::int64_t firstRow;  ///< of the tile in which the ray enters
	PackedSums *entered, *left;

	Strip(RayCounter& counter, std::int64_t column, std::int64_t row, std::int64_t leaving)
		: firstRow(row & -edge), entered(counter.cellsOf(key(column, row))), left(entered)
	{
		if ((leaving & -edge) != firstRow) left = counter.cellsOf(key(column, leaving));
	}

	static TileKey key(std::int64_t column, std::int64_t row)
	{
		return steep ? CounterTile::keyOf(row, column) : CounterTile::keyOf(column, row);
	}
	PackedSums* cell(std::int64_t column, std::int64_t row) const
	{
		return ((row & -edge) == firstRow ? entered : left) + (column & (edge - 1)) * along +
			   (row & (edge - 1)) * across;
	}

	/** The one or two cells of a column. */
	void countColumn(std::int64_t column, std::int64_t row, std::int64_t leaving, PackedSums sums) const
	{
		*cell(column, row) += sums;
		*cell(column, leaving) += sums & -PackedSums(leaving != row);
	}

	/** The cells of columns from `first` to before `end`, which the ray enters in `row`, all in one tile. */
	void countInTile(const RayWalk& walk, std::int64_t first, std::int64_t end, std::int64_t row, PackedSums sums) const
	{
		const std::int64_t beside = walk.rowStep() * across;
		PackedSums* at = cell(first, row);
		auto [fraction, perColumn] = walk.fractionAt(first);
		for (std::int64_t i = first; i < end; i++)
		{
			// Without a branch, which could not be predicted: where the row stays, zero is added beside it.
			fraction += perColumn;
			const PackedSums leaves = -PackedSums(fraction < perColumn);
			*at += sums;
			at[beside] += sums & leaves;
			at += along + (beside & std::int64_t(leaves));
		}
	}

	/** The same where the ray may go from one tile to the other. */
	void countColumns(const RayWalk& walk, std::int64_t first, std::int64_t end, std::int64_t row,
					  PackedSums sums) const
	{
		const std::int64_t leaving = walk.rowAt(end);
		if ((leaving & -edge) == (row & -edge)) return countInTile(walk, first, end, row, sums);
		const std::int64_t border = walk.rowStep() > 0 ? leaving & -edge : leaving | (edge - 1);
		const std::int64_t crossing = walk.columnLeavingFor(border);
		countInTile(walk, first, crossing, row, sums);
		countColumn(crossing, border - walk.rowStep(), border, sums);
		if (crossing + 1 < end) countInTile(walk, crossing + 1, end, border, sums);
	}
};

template <bool steep>
void RayCounter::count(const RayWalk& walk, PackedSums sums)
{
	const std::int64_t begin = walk.firstColumn(), end = walk.lastColumn();
	std::int64_t row = walk.rowAt(begin);
	for (std::int64_t first = begin, next; first <= end; first = next)
	{
		next = std::min(end, first | (CounterTile::edge - 1)) + 1;
		const std::int64_t leaving = walk.rowAt(next);
		const Strip<steep> strip(*this, first, row, leaving);
		std::int64_t inner = first;
		if (first == begin)
		{
			const std::int64_t start = std::exchange(row, walk.rowAt(++inner));
			strip.countColumn(begin, start, row, sums);
		}
		const std::int64_t innerEnd = std::min(end, next);
		if (inner < innerEnd) strip.countColumns(walk, inner, innerEnd, row, sums);
		if (next > end && end > begin) strip.countColumn(end, walk.rowAt(end), leaving, sums);
		row = leaving;
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
