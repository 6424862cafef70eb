// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "kernel_block.h"
#include "vec2.h"

namespace ridgemap
{
/** Column and row of a tile. */
struct TileKey
{
	std::int32_t x = 0;
	std::int32_t y = 0;

	friend bool operator==(TileKey a, TileKey b) { return a.x == b.x && a.y == b.y; }
	friend bool operator!=(TileKey a, TileKey b) { return !(a == b); }
	/** Canonical order: row by row. */
	friend bool operator<(TileKey a, TileKey b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }
};

struct TileKeyHash
{
	std::size_t operator()(TileKey k) const
	{
		std::uint64_t h = (std::uint64_t(std::uint32_t(k.x)) << 32) | std::uint32_t(k.y);
		h ^= h >> 31;
		h *= 0x9e3779b97f4a7c15u;
		return std::size_t(h ^ (h >> 29));
	}
};

/** Where a ridge passes from one tile to the next. In the frame of the tile that owns the edge. */
struct Crossing
{
	Vec2 p;        ///< on the ridge and on the border [sigma]
	Vec2 tangent;  ///< unit tangent of the ridge, either sense
	Vec2 normal;   ///< unit normal of the ridge; in a sided field towards the viewer
	double s = 0;  ///< arc length along the border from the start of the edge [sigma]

	bool operator==(const Crossing& o) const
	{
		return p == o.p && tangent == o.tangent && normal == o.normal && s == o.s;
	}
};

/** The border between two tiles, from corner to corner. Straight, unless a ridge runs along it: borders give way to
 * ridges, so that every crossing is transversal. */
struct Edge
{
	std::vector<Vec2> path;           ///< vertices, frame of the owning tile [sigma]
	std::vector<Crossing> crossings;  ///< in the order of s

	bool operator==(const Edge& o) const { return path == o.path && crossings == o.crossings; }
};

/** Sides of a tile, in the order in which their crossings are traced. */
enum Side : int
{
	bottomSide = 0,
	leftSide = 1,
	topSide = 2,
	rightSide = 3
};

/** One end of a piece. */
struct PieceEnd
{
	StopReason reason = StopReason::belowThreshold;
	int side = -1;      ///< side of the tile on which the piece ends at a crossing, -1: a free end
	int crossing = -1;  ///< number of the crossing on that side

	bool operator==(const PieceEnd& o) const { return reason == o.reason && side == o.side && crossing == o.crossing; }
};

/** A node of a ridge and what the density says there. */
struct RidgeNode
{
	Vec2 p;       ///< frame of the tile [sigma]
	Vec2 normal;  ///< unit normal of the ridge; in a sided field towards the viewer
	VertexInfo info;

	bool operator==(const RidgeNode& o) const { return p == o.p && normal == o.normal && info == o.info; }
};

/** The part of a polyline that lies in one tile. */
struct Piece
{
	std::vector<RidgeNode> nodes;
	PieceEnd start, end;
	bool closed = false;

	bool operator==(const Piece& o) const
	{
		return nodes == o.nodes && start == o.start && end == o.end && closed == o.closed;
	}
};

/** A set of blocks in and around a tile: one word a row, lowest row first, the halo included. */
class BlockMask
{
 public:
	BlockMask() = default;
	/** No block of a neighbourhood of side x side blocks. */
	explicit BlockMask(int side) : side_(side) {}

	/** The columns first..last of a row, counted from the corner of the halo. */
	static std::uint32_t columns(int first, int last)
	{
		return (std::uint32_t(2) << last) - (std::uint32_t(1) << first);
	}
	/** Adds the blocks of columns first..last in a row. */
	void add(int row, int first, int last) { rows_[std::size_t(row)] |= columns(first, last); }
	void addAll() { rows_.fill(~std::uint32_t(0)); }
	/** True also if one of the two was never filled: then nothing is known. */
	bool intersects(const BlockMask& o) const
	{
		if (side_ == 0 || o.side_ == 0) return true;
		for (std::size_t i = 0; i < std::size_t(side_); i++)
			if (rows_[i] & o.rows_[i]) return true;
		return false;
	}

 private:
	static constexpr std::size_t largestSide = 22;  ///< of tiles of 64 sigma with a cut-off of 8 sigma

	int side_ = 0;
	std::array<std::uint32_t, largestSide> rows_{};
};

/** A square of the plane with all that belongs to it: cells and kernels, lower-left corner, lower and left border, and
 * the pieces of polyline. Everything but the cells is a pure function of the cells in and around the tile. */
struct Tile
{
	std::vector<Block> blocks;  ///< row by row
	Vec2 corner;                ///< lower-left corner, frame of the tile; (0,0) unless a ridge passes there [sigma]
	Edge bottom;                ///< from this tile's corner to that of the tile on the right
	Edge left;                  ///< from this tile's corner to that of the tile above
	std::vector<Piece> pieces;
	std::vector<PieceEnd> stubs;              ///< crossings right behind which the ridge ends, with the reason
	std::vector<std::uint64_t> chainOfPiece;  ///< polyline that each piece belongs to, 0: none yet
	std::uint64_t cellCount = 0;
	BlockMask cornerReach, borderReach,
		traceReach;  ///< blocks that were looked at for the corner, the borders, the pieces
};

/** All tiles of a map by their key. Tiles that hold nothing need not exist. Copies share each tile until one of them
 * changes it. */
class TileStore
{
 public:
	explicit TileStore(int blocksPerEdge) : blocksPerEdge_(blocksPerEdge) {}

	int blocksPerEdge() const { return blocksPerEdge_; }
	/** Some measurements tell from which side they were seen. */
	bool isSided() const { return sided_; }
	void setSided(bool sided) { sided_ = sided; }
	double tileEdge() const { return double(blocksPerEdge_ * Frame::blockEdge); }

	const Tile* find(TileKey key) const
	{
		const auto it = tiles_.find(key);
		return it == tiles_.end() ? nullptr : it->second.get();
	}
	/** The same tile for a change, which copies of this store then no longer share; not beside other calls. */
	Tile* own(TileKey key);
	/** A tile that own() or at() gave before, as long as the store has not been copied since. */
	Tile* findOwned(TileKey key) { return const_cast<Tile*>(find(key)); }
	/** The tile of this key for a change, made if need be; as own(). */
	Tile& at(TileKey key);
	void remove(TileKey key) { tiles_.erase(key); }
	void clear() { tiles_.clear(); }
	std::size_t size() const { return tiles_.size(); }
	/** Keys of all tiles in canonical order. */
	std::vector<TileKey> keys() const;

	TileKey tileOfBlock(std::int64_t bx, std::int64_t by) const
	{
		return {std::int32_t(floorDiv(bx, blocksPerEdge_)), std::int32_t(floorDiv(by, blocksPerEdge_))};
	}
	/** A point of the plane, relative to the lower-left corner of a tile, as lattice coordinates. */
	Vec2 toLattice(TileKey key, Vec2 p) const
	{
		return {double(key.x) * tileEdge() + p.x, double(key.y) * tileEdge() + p.y};
	}

 private:
	int blocksPerEdge_;
	bool sided_ = false;
	std::unordered_map<TileKey, std::shared_ptr<Tile>, TileKeyHash> tiles_;
};

}  // namespace ridgemap
