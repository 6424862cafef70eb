// SPDX-License-Identifier: BSD-3-Clause
// Sums over the rays through cells, and their storage in tiles.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>

#include "tile.h"

namespace ridgemap
{
/** What is known of the rays through a cell: their number n, A = sum round(128 cos 2 phi), B = sum round(128 sin 2 phi)
 * over their angles phi, exact. */
struct PassSums
{
	std::int64_t n = 0, a = 0, b = 0;

	friend bool operator==(const PassSums& x, const PassSums& y) { return x.n == y.n && x.a == y.a && x.b == y.b; }
};

/** The sums of up to maxPackedRays rays in 64 bits, n + 2^16 A + 2^40 B modulo 2^64: sums of packed sums are the packed
 * sums. */
using PackedSums = std::uint64_t;
constexpr std::uint32_t maxPackedRays = (1 << 15) - 1;

inline PackedSums pack(const PassSums& s)
{
	return std::uint64_t(s.n) + (std::uint64_t(s.a) << 16) + (std::uint64_t(s.b) << 40);
}

inline PassSums unpack(PackedSums p)
{
	PassSums s;
	s.n = std::int16_t(p);
	p -= std::uint64_t(s.n);
	s.a = std::int64_t(p << 24) >> 40;
	p -= std::uint64_t(s.a) << 16;
	s.b = std::int64_t(p) >> 40;
	return s;
}

/** A square of cells: 8 bytes a cell. What does not fit is moved to sums of 64 bits, which few tiles need. */
class CounterTile
{
 public:
	static constexpr int edgeBits = 5;
	static constexpr std::int64_t edge = 1 << edgeBits;  ///< in cells
	static constexpr std::size_t cells = std::size_t(edge * edge);

	static TileKey keyOf(std::int64_t cx, std::int64_t cy)
	{
		return {std::int32_t(cx >> edgeBits), std::int32_t(cy >> edgeBits)};
	}
	static std::size_t slot(std::int64_t cx, std::int64_t cy)
	{
		return std::size_t((cy & (edge - 1)) * edge + (cx & (edge - 1)));
	}

	CounterTile() = default;
	CounterTile(const CounterTile& o);

	PassSums sums(std::size_t i) const;
	void set(std::size_t i, const PassSums& s);
	std::size_t used() const;  ///< cells that rays passed
	std::size_t memoryBytes() const { return sizeof(*this) + (wide_ ? sizeof(*wide_) : 0); }

	/** Makes room for up to maxReserved more rays through each cell, put in or taken out. */
	void reserve(std::uint32_t rays);
	static constexpr std::uint32_t maxReserved = 1 << 14;
	/** The packed sums of the cells, to be changed as reserve() allows; nothing may be added to `edge` numbers before
	 * and behind them but zero. */
	PackedSums* packed() { return packed_.data() + edge; }

 private:
	std::array<PackedSums, cells + 2 * edge> packed_{};
	std::unique_ptr<std::array<PassSums, cells>> wide_;
	std::uint32_t bound_ = 0;  ///< so many rays, at most, made each of the packed sums
};

/** Copies share each tile until one of them changes it. */
using CounterTiles = std::unordered_map<TileKey, std::shared_ptr<CounterTile>, TileKeyHash>;

/** The tile of this key for a change, made if need be; copies then no longer share it. */
CounterTile& tileAt(CounterTiles& tiles, TileKey key);

}  // namespace ridgemap
