// SPDX-License-Identifier: BSD-3-Clause
#include "free_tile.h"

#include <algorithm>
#include <cstdlib>

#include "free_ray.h"
#include "shared.h"

namespace ridgemap
{
namespace
{
/** Sums up to this many rays stay packed when a tile is tidied up. */
constexpr std::int64_t smallRays = 1 << 13;

bool isSmall(const PassSums& s)
{
	constexpr std::int64_t most = LatticeRay::directionScale * smallRays;
	return std::abs(s.n) <= smallRays && std::abs(s.a) <= most && std::abs(s.b) <= most;
}
}  // namespace

CounterTile::CounterTile(const CounterTile& o)
	: packed_(o.packed_),
	  wide_(o.wide_ ? std::make_unique<std::array<PassSums, cells>>(*o.wide_) : nullptr),
	  bound_(o.bound_)
{
}

PassSums CounterTile::sums(std::size_t i) const
{
	PassSums s = unpack(packed_[i + edge]);
	if (wide_)
	{
		const PassSums& w = (*wide_)[i];
		s = {s.n + w.n, s.a + w.a, s.b + w.b};
	}
	return s;
}

void CounterTile::set(std::size_t i, const PassSums& s)
{
	const bool small = isSmall(s);
	if (!small && !wide_) wide_ = std::make_unique<std::array<PassSums, cells>>();
	if (wide_) (*wide_)[i] = small ? PassSums{} : s;
	packed_[i + edge] = small ? pack(s) : 0;
	if (small) bound_ = std::max(bound_, std::uint32_t(smallRays));
}

std::size_t CounterTile::used() const
{
	std::size_t count = 0;
	for (std::size_t i = 0; i < cells; i++) count += sums(i) == PassSums{} ? 0 : 1;
	return count;
}

void CounterTile::reserve(std::uint32_t rays)
{
	if (bound_ + rays > maxPackedRays)
	{
		for (std::size_t i = 0; i < cells; i++) set(i, sums(i));
		bound_ = smallRays;
	}
	bound_ += rays;
}

CounterTile& tileAt(CounterTiles& tiles, TileKey key)
{
	std::shared_ptr<CounterTile>& t = tiles[key];
	if (!t) t = std::make_shared<CounterTile>();
	return own(t);
}

}  // namespace ridgemap
