// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/ridge_map.h>

#include <unordered_map>
#include <vector>

#include "frame.h"
#include "memo.h"
#include "tile.h"

namespace ridgemap
{
/** Tiles whose pieces were replaced, with the polylines that their old pieces belonged to. */
struct ReplacedTile
{
	TileKey key;
	std::vector<PolylineId> oldChains;
};

/** Joins the pieces of all tiles at their crossings into polylines (paper section IV: "connect them at the region's
 * boundary"). Only polylines that touch a replaced tile are assembled anew. Order and direction are canonical. */
class Chains
{
 public:
	/** Brings the polylines up to date; adds to vanished and appeared of the result. */
	void update(TileStore& tiles, const std::vector<ReplacedTile>& replaced, UpdateResult& result);

	/** Forgets all polylines; the next update reports them as vanished. */
	void clear();
	bool hasCleared() const { return !cleared_.empty(); }

	/** All polylines in canonical order. One that has not changed is the same object as in the last call. */
	Lines lines(const TileStore& tiles, const Frame& frame);
	/** One polyline; throws std::out_of_range if there is none of this name. */
	Polyline polyline(PolylineId id, const TileStore& tiles, const Frame& frame) const;

 private:
	struct PieceRef
	{
		TileKey tile;
		int piece = 0;
		bool reversed = false;
	};
	struct Chain
	{
		std::vector<PieceRef> pieces;
		bool closed = false;
		LinePtr line;  ///< once it was asked for
	};

	static bool comesBefore(const PieceRef& a, const PieceRef& b);
	static const PieceEnd& lastEnd(const TileStore& tiles, const PieceRef& r);
	static bool next(const TileStore& tiles, const PieceRef& from, PieceRef& to);
	static Chain assemble(const TileStore& tiles, const PieceRef& any);
	/** From which side a ridge was seen, as in Polyline::side. */
	static int sideOf(const PieceRef& r, const TileStore& tiles);
	static Polyline materialise(const Chain& chain, const TileStore& tiles, const Frame& frame);

	std::unordered_map<PolylineId, Chain> chains_;
	std::vector<PolylineId> cleared_;
	PolylineId nextId_ = 1;
};

/** Number of crossings of a tile's left and bottom border that only one side continues although the ridge goes on. */
std::size_t countUnstitched(const TileStore& tiles, TileKey key);

}  // namespace ridgemap
