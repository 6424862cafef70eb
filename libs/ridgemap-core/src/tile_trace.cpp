// SPDX-License-Identifier: BSD-3-Clause
// All ridges of one tile: from the crossings of its border, then from the measurements that no ridge covers yet
// (paper section V-A).
#include <algorithm>
#include <optional>

#include "place_set.h"
#include "seeds.h"
#include "stopwatch.h"
#include "tracer.h"

namespace ridgemap
{
namespace
{
constexpr double coverDistance = 1;    ///< measurements within this of a piece start no ridge [sigma]
constexpr double knownDistance = 0.2;  ///< a search that comes this close to a piece has found nothing new [sigma]
constexpr double besidePath =
	0.45;  ///< a search this close to the path of one that came to a known place would follow it [sigma]
constexpr double seedMargin = 0.5;    ///< measurements up to this far outside a tile may start ridges in it [sigma]
constexpr double behindReach = 2;     ///< how far behind a crossing a ridge is taken to go on [sigma]
constexpr double leastLength = 0.02;  ///< shorter pieces with two free ends are noise of the arithmetic [sigma]

double lengthOf(const std::vector<RidgeNode>& nodes)
{
	double sum = 0;
	for (std::size_t i = 1; i < nodes.size(); i++) sum += norm(nodes[i].p - nodes[i - 1].p);
	return sum;
}

class TileTracer
{
 public:
	TileTracer(const TileField& field, TileBorder& border, const Options& options)
		: field_(field),
		  border_(border),
		  options_(options),
		  covered_(field.tileEdge(), TileField::margin),
		  searched_(field.tileEdge(), TileField::margin),
		  tracer_(field, border, options, result_.pieces)
	{
	}

	TileTrace run()
	{
		const Stopwatch watch;
		for (TileBorder::Port& port : border_.ports()) fromCrossing(port);
		result_.seconds.crossings = watch.seconds();
		fromMeasurements();
		result_.seconds.seeds = watch.seconds() - result_.seconds.crossings;
		return std::move(result_);
	}

 private:
	void fromCrossing(TileBorder::Port& port)
	{
		if (port.consumed) return;
		port.consumed = true;
		const RidgePoint start = tracer_.evaluate(port.crossing.p, port.crossing.normal);
		if (tracer_.onPolyline(start.p, port.inward, start.v1)) return;
		result_.traces++;
		RidgeTracer::Walk walk = tracer_.walk(start, port.inward);
		Piece piece;
		piece.start = {StopReason::crossing, port.side, port.index};
		finish(walk);
		piece.end = walk.end;
		piece.nodes = std::move(walk.nodes);
		if (piece.nodes.size() >= 2)
			add(std::move(piece));
		else
		{
			result_.stubs.push_back({piece.end.reason, port.side, port.index});
			port.consumed = false;  // another ridge may end here
		}
	}

	void fromMeasurements()
	{
		const double edge = field_.tileEdge(), half = 0.5 * edge;
		// Collected first: tracing must not depend on how far the loop over kernels has come.
		std::vector<std::pair<Vec2, std::uint32_t>> starts;
		field_.forEachCellNear({half, half}, half + seedMargin,
							   [&](Vec2 q, std::uint32_t bin)
							   {
								   const double least = std::min(q.x, q.y), most = std::max(q.x, q.y);
								   if (least >= -seedMargin && most <= edge + seedMargin && !startsNothing(q, bin))
									   starts.push_back({q, bin});
							   });
		for (const auto& [q, bin] : starts)
		{
			if (startsNothing(q, bin)) continue;
			noteKnown();
			if (!searched_.contains(q, bin)) fromMeasurement(q, bin);
		}
	}

	/** Looks for a ridge from one measurement, unless an earlier search came past. */
	void fromMeasurement(Vec2 q, std::uint32_t bin)
	{
		result_.seeds++;
		path_.clear();
		path_.push_back(q);
		const auto known = [&](Vec2 p)
		{
			path_.push_back(p);
			return searched_.contains(p, bin);
		};
		const Search search = findRidge(field_, options_, q, bin > 0 ? binDirection(bin) : Vec2{1, 0}, known);
		// Where this search came past, another one would end in the same place; unless this one ran out of its reach,
		// which would take another one farther, but not to a ridge that is its own.
		const std::uint32_t mask = std::uint32_t(1) << bin;
		for (const Vec2& p : path_)
			if (search.outcome == Search::known)
				searched_.addDisc(p, besidePath, mask);
			else if (search.outcome != Search::gaveUp || norm(p - q) < 0.5 * searchReach)
				searched_.add(p, mask);
		const std::optional<RidgePoint>& seed = search.ridge;
		if (!seed || !border_.contains(seed->p)) return;
		result_.traces++;
		const Vec2 tangent = seed->tangent(seed->v2);
		RidgeTracer::Walk forward = tracer_.walk(*seed, tangent);
		finish(forward);
		Piece piece;
		if (forward.closed)
		{
			piece.closed = true;
			piece.start.reason = piece.end.reason = StopReason::closedLoop;
			piece.nodes = std::move(forward.nodes);
			add(std::move(piece));
			return;
		}
		RidgeTracer::Walk backward = tracer_.walk(*seed, -tangent);
		finish(backward);
		piece.start = backward.end;
		piece.end = forward.end;
		piece.nodes.assign(backward.nodes.rbegin(), backward.nodes.rend());
		piece.nodes.insert(piece.nodes.end(), forward.nodes.begin() + 1, forward.nodes.end());
		const bool freeEnds = piece.start.side < 0 && piece.end.side < 0;
		if (piece.nodes.size() >= 2 && (!freeEnds || lengthOf(piece.nodes) >= leastLength)) add(std::move(piece));
	}

	/** Trims a free end and takes the crossing that a walk reached. */
	void finish(RidgeTracer::Walk& walk)
	{
		if (walk.end.side >= 0)
		{
			for (TileBorder::Port& port : border_.ports())
				if (port.side == walk.end.side && port.index == walk.end.crossing) port.consumed = true;
			const auto isHere = [&](const PieceEnd& s)
			{ return s.side == walk.end.side && s.crossing == walk.end.crossing; };
			result_.stubs.erase(std::remove_if(result_.stubs.begin(), result_.stubs.end(), isHere),
								result_.stubs.end());
		}
		else if (!walk.closed && walk.end.reason != StopReason::hitPolyline)
			tracer_.trimToMeasurements(walk);
		result_.stops[std::size_t(walk.end.reason)]++;
	}

	void add(Piece&& piece)
	{
		const std::vector<RidgeNode>& n = piece.nodes;
		for (std::size_t i = 1; i < n.size(); i++)
		{
			const std::uint32_t mask = binsSeenBy(n[i].normal);
			covered_.addCapsule(n[i - 1].p, n[i].p, coverDistance, mask);
			if (i == 1 && piece.start.side >= 0) behind_.push_back({n[0].p, unit(n[0].p - n[1].p), mask});
			if (i + 1 == n.size() && piece.end.side >= 0) behind_.push_back({n[i].p, unit(n[i].p - n[i - 1].p), mask});
		}
		result_.pieces.push_back(std::move(piece));
	}

	/** Searches need to come no closer than this to the pieces that there are. In most tiles there are no searches. */
	void noteKnown()
	{
		for (; known_ < result_.pieces.size(); known_++)
		{
			const std::vector<RidgeNode>& n = result_.pieces[known_].nodes;
			for (std::size_t i = 1; i < n.size(); i++)
				searched_.addCapsule(n[i - 1].p, n[i].p, knownDistance, binsSeenBy(n[i].normal));
		}
	}

	std::uint32_t binsSeenBy(Vec2 normal) const
	{
		if (!field_.isSided()) return (std::uint32_t(1) << directionBins) - 1;
		std::uint32_t mask = 0;
		for (std::uint32_t bin = 0; bin < directionBins; bin++) mask |= std::uint32_t(field_.sees(bin, normal)) << bin;
		return mask;
	}

	/** The measurement lies outside the tile, beside a ridge that goes on there. */
	bool isBehindCrossing(Vec2 q, std::uint32_t bin) const
	{
		if (std::min(q.x, q.y) >= 0 && std::max(q.x, q.y) <= field_.tileEdge()) return false;
		const auto isBeside = [&](const Behind& b)
		{
			const Vec2 d = q - b.crossing;
			return (b.mask >> bin & 1) && dot(d, b.outward) > 0 && std::abs(cross(b.outward, d)) <= coverDistance &&
				   dot(d, d) <= behindReach * behindReach;
		};
		return std::any_of(behind_.begin(), behind_.end(), isBeside);
	}

	bool startsNothing(Vec2 q, std::uint32_t bin) const
	{
		return covered_.contains(q, bin) || isBehindCrossing(q, bin);
	}

	/** Where a piece leaves the tile. */
	struct Behind
	{
		Vec2 crossing, outward;
		std::uint32_t mask;  ///< direction bins that it explains
	};

	const TileField& field_;
	TileBorder& border_;
	const Options& options_;
	TileTrace result_;
	PlaceSets covered_;      ///< by direction bin: measurements here start no ridge
	PlaceSets searched_;     ///< by direction bin: a search that comes here finds nothing new
	std::size_t known_ = 0;  ///< pieces that are in searched_
	std::vector<Behind> behind_;
	std::vector<Vec2> path_;  ///< of the present search
	RidgeTracer tracer_;
};
}  // namespace

TileTrace traceTile(const TileField& field, TileBorder& border, const Options& options)
{
	return TileTracer(field, border, options).run();
}

}  // namespace ridgemap
