// SPDX-License-Identifier: BSD-3-Clause
#include "chains.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace ridgemap
{
namespace
{
/** The tile beyond a side, and which of its sides that is. */
std::pair<TileKey, int> beyond(TileKey key, int side)
{
	switch (side)
	{
		case bottomSide:
			return {{key.x, key.y - 1}, topSide};
		case topSide:
			return {{key.x, key.y + 1}, bottomSide};
		case leftSide:
			return {{key.x - 1, key.y}, rightSide};
		default:
			return {{key.x + 1, key.y}, leftSide};
	}
}

/** Number of the piece that ends at a crossing, and whether it ends (not starts) there; -1: none. */
std::pair<int, bool> pieceAt(const Tile* tile, int side, int crossing)
{
	if (tile)
		for (std::size_t i = 0; i < tile->pieces.size(); i++)
		{
			const Piece& p = tile->pieces[i];
			if (p.start.side == side && p.start.crossing == crossing) return {int(i), false};
			if (p.end.side == side && p.end.crossing == crossing) return {int(i), true};
		}
	return {-1, false};
}

/** The ridge ends right behind this crossing. */
bool endsAt(const Tile* tile, int side, int crossing)
{
	return tile && std::any_of(tile->stubs.begin(), tile->stubs.end(),
							   [&](const PieceEnd& s) { return s.side == side && s.crossing == crossing; });
}
}  // namespace

bool Chains::comesBefore(const PieceRef& a, const PieceRef& b)
{
	return a.tile == b.tile ? a.piece < b.piece : a.tile < b.tile;
}

const PieceEnd& Chains::lastEnd(const TileStore& tiles, const PieceRef& r)
{
	const Piece& p = tiles.find(r.tile)->pieces[std::size_t(r.piece)];
	return r.reversed ? p.start : p.end;
}

bool Chains::next(const TileStore& tiles, const PieceRef& from, PieceRef& to)
{
	const PieceEnd& end = lastEnd(tiles, from);
	if (end.side < 0) return false;
	const auto [key, side] = beyond(from.tile, end.side);
	const auto [piece, atItsEnd] = pieceAt(tiles.find(key), side, end.crossing);
	if (piece < 0) return false;
	to = {key, piece, atItsEnd};
	return true;
}

Chains::Chain Chains::assemble(const TileStore& tiles, const PieceRef& any)
{
	const auto same = [](const PieceRef& a, const PieceRef& b) { return a.tile == b.tile && a.piece == b.piece; };
	Chain chain;
	PieceRef first = any;
	first.reversed = true;  // walk against the piece to its beginning
	PieceRef step;
	bool loop = false;
	while (next(tiles, first, step))
	{
		first = step;
		if (same(first, any))
		{
			loop = true;
			break;
		}
	}
	first.reversed = !first.reversed;
	chain.pieces.push_back(first);
	while (next(tiles, chain.pieces.back(), step) && !same(step, first)) chain.pieces.push_back(step);
	const Piece& only = tiles.find(any.tile)->pieces[std::size_t(any.piece)];
	chain.closed = loop || only.closed;

	std::vector<PieceRef>& p = chain.pieces;
	const auto reverse = [&]
	{
		std::reverse(p.begin(), p.end());
		for (PieceRef& r : p) r.reversed = !r.reversed;
	};
	if (loop)
	{
		std::rotate(p.begin(), std::min_element(p.begin(), p.end(), comesBefore), p.end());
		if (p.front().reversed)
		{
			reverse();
			std::rotate(p.begin(), p.end() - 1, p.end());
		}
	}
	else if (p.size() > 1 ? comesBefore(p.back(), p.front()) : p.front().reversed)
		reverse();
	return chain;
}

void Chains::clear()
{
	for (const auto& entry : chains_) cleared_.push_back(entry.first);
	chains_.clear();
}

void Chains::update(TileStore& tiles, const std::vector<ReplacedTile>& replaced, UpdateResult& result)
{
	std::sort(cleared_.begin(), cleared_.end());
	result.vanished.insert(result.vanished.end(), cleared_.begin(), cleared_.end());
	cleared_.clear();
	std::set<PolylineId> gone;
	std::vector<PieceRef> pending;
	for (const ReplacedTile& r : replaced)
	{
		gone.insert(r.oldChains.begin(), r.oldChains.end());
		const Tile* tile = tiles.find(r.key);
		for (std::size_t i = 0; tile && i < tile->pieces.size(); i++)
		{
			pending.push_back({r.key, int(i), false});
			// A neighbour that ended here so far is continued now.
			for (const bool reversed : {false, true})
			{
				PieceRef other;
				if (!next(tiles, {r.key, int(i), reversed}, other)) continue;
				gone.insert(tiles.find(other.tile)->chainOfPiece[std::size_t(other.piece)]);
			}
		}
	}
	gone.erase(0);
	for (const PolylineId id : gone)
	{
		for (const PieceRef& r : chains_.at(id).pieces)
		{
			const Tile* tile = tiles.find(r.tile);
			if (!tile || std::size_t(r.piece) >= tile->chainOfPiece.size()) continue;
			if (tile->chainOfPiece[std::size_t(r.piece)] != id) continue;
			tiles.own(r.tile)->chainOfPiece[std::size_t(r.piece)] = 0;
			pending.push_back(r);
		}
		chains_.erase(id);
		result.vanished.push_back(id);
	}
	std::sort(pending.begin(), pending.end(), comesBefore);
	for (const PieceRef& r : pending)
	{
		if (tiles.find(r.tile)->chainOfPiece[std::size_t(r.piece)] != 0) continue;
		Chain chain = assemble(tiles, r);
		const PolylineId id = nextId_++;
		for (const PieceRef& q : chain.pieces) tiles.own(q.tile)->chainOfPiece[std::size_t(q.piece)] = id;
		chains_.emplace(id, std::move(chain));
		result.appeared.push_back(id);
	}
}

int Chains::sideOf(const PieceRef& r, const TileStore& tiles)
{
	const std::vector<RidgeNode>& nodes = tiles.find(r.tile)->pieces[std::size_t(r.piece)].nodes;
	const Vec2 direction = (r.reversed ? -1.0 : 1.0) * (nodes[1].p - nodes[0].p);
	return cross(direction, nodes[0].normal) > 0 ? 1 : -1;
}

Polyline Chains::materialise(const Chain& chain, const TileStore& tiles, const Frame& frame)
{
	Polyline line;
	line.closed = chain.closed;
	const auto add = [&](TileKey key, const RidgeNode& node)
	{
		const Point2 q = frame.toMap(tiles.toLattice(key, node.p));
		if (!line.points.empty() && q == line.points.back()) return;
		line.points.push_back(q);
		line.info.push_back(node.info);
	};
	for (std::size_t i = 0; i < chain.pieces.size(); i++)
	{
		const PieceRef& r = chain.pieces[i];
		const std::vector<RidgeNode>& nodes = tiles.find(r.tile)->pieces[std::size_t(r.piece)].nodes;
		// The crossing between two pieces is written once, as the earlier piece has it.
		for (std::size_t k = i == 0 ? 0 : 1; k < nodes.size(); k++)
			add(r.tile, nodes[r.reversed ? nodes.size() - 1 - k : k]);
	}
	if (tiles.isSided()) line.side = sideOf(chain.pieces.front(), tiles);
	if (line.closed && line.points.size() > 1) line.points.back() = line.points.front();
	PieceRef front = chain.pieces.front();
	front.reversed = !front.reversed;
	line.startReason = line.closed ? StopReason::closedLoop : lastEnd(tiles, front).reason;
	line.endReason = line.closed ? StopReason::closedLoop : lastEnd(tiles, chain.pieces.back()).reason;
	return line;
}

Lines Chains::lines(const TileStore& tiles, const Frame& frame)
{
	std::vector<Chain*> order;
	for (auto& entry : chains_) order.push_back(&entry.second);
	std::sort(order.begin(), order.end(),
			  [](const Chain* a, const Chain* b) { return comesBefore(a->pieces[0], b->pieces[0]); });
	Lines result;
	for (Chain* c : order)
	{
		if (!c->line) c->line = std::make_shared<const Polyline>(materialise(*c, tiles, frame));
		if (c->line->points.size() >= 2) result.push_back(c->line);
	}
	return result;
}

Polyline Chains::polyline(PolylineId id, const TileStore& tiles, const Frame& frame) const
{
	const auto it = chains_.find(id);
	if (it == chains_.end())
		throw std::out_of_range("ridge map: no polyline of this name; it has vanished in an update");
	return materialise(it->second, tiles, frame);
}

std::size_t countUnstitched(const TileStore& tiles, TileKey key)
{
	const Tile* tile = tiles.find(key);
	std::size_t count = 0;
	const auto countSide = [&](const Edge& edge, int side)
	{
		const auto [other, otherSide] = beyond(key, side);
		for (int k = 0; k < int(edge.crossings.size()); k++)
		{
			count += (pieceAt(tile, side, k).first < 0 && !endsAt(tile, side, k)) ||
					 (pieceAt(tiles.find(other), otherSide, k).first < 0 && !endsAt(tiles.find(other), otherSide, k));
		}
	};
	countSide(tile->bottom, bottomSide);
	countSide(tile->left, leftSide);
	return count;
}

}  // namespace ridgemap
