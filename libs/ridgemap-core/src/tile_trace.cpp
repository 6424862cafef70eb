// SPDX-License-Identifier: BSD-3-Clause
// All ridges of one tile: from the crossings of its border, then from the measurements that no ridge covers yet
// (paper section V-A).
#include <algorithm>
#include <optional>

#include "exp_series.h"
#include "seeds.h"
#include "stopwatch.h"
#include "tracer.h"

namespace ridgemap
{
namespace
{
constexpr double coverDistance = 1;    ///< measurements within this of a piece start no ridge [sigma]
constexpr double knownDistance = 0.2;  ///< a search that comes this close to a piece has found nothing new [sigma]
constexpr double shadowWidth = 4;      ///< how far a ridge can outweigh measurements beside it [sigma]
constexpr double shadowShare = 0.4;   ///< of the density of a wall beside it, above which a cell may have its own ridge
constexpr double leastCell = 0.25;    ///< edge by which the density of uncompacted measurements is judged [sigma]
constexpr double seedMargin = 0.5;    ///< measurements up to this far outside a tile may start ridges in it [sigma]
constexpr double leastLength = 0.02;  ///< shorter pieces with two free ends are noise of the arithmetic [sigma]

double lengthOf(const std::vector<RidgeNode>& nodes)
{
	double sum = 0;
	for (std::size_t i = 1; i < nodes.size(); i++) sum += norm(nodes[i].p - nodes[i - 1].p);
	return sum;
}

/** Box around a piece. */
struct Bounds
{
	Vec2 low{1e30, 1e30}, high{-1e30, -1e30};

	void extend(Vec2 p)
	{
		low = {std::min(low.x, p.x), std::min(low.y, p.y)};
		high = {std::max(high.x, p.x), std::max(high.y, p.y)};
	}
	bool isNear(Vec2 p, double d) const
	{
		return p.x > low.x - d && p.y > low.y - d && p.x < high.x + d && p.y < high.y + d;
	}
};

class TileTracer
{
 public:
	TileTracer(const TileField& field, TileBorder& border, const Options& options)
		: field_(field), border_(border), options_(options), tracer_(field, border, options, result_.pieces)
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
		const RidgePoint start = tracer_.evaluate(port.crossing.p);
		if (tracer_.onPolyline(start.p, port.inward)) return;
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
		field_.forEachCellNear(
			{half, half}, half + seedMargin,
			[&](Vec2 q, std::uint32_t n)
			{
				if (q.x >= -seedMargin && q.y >= -seedMargin && q.x <= edge + seedMargin && q.y <= edge + seedMargin)
					starts.push_back({q, n});
			});
		for (const auto& [q, n] : starts)
			if (!covered(q, coverDistance) && !outweighed(q, n)) fromMeasurement(q);
	}

	void fromMeasurement(Vec2 q)
	{
		result_.seeds++;
		Vec2 last = q;
		const auto known = [&](Vec2 p)
		{
			last = p;
			return covered(p, knownDistance) ||
				   std::any_of(barren_.begin(), barren_.end(), [&](Vec2 b) { return norm(p - b) < knownDistance; });
		};
		const std::optional<RidgePoint> seed = findRidge(field_, options_, q, known);
		const bool here = seed && border_.contains(seed->p);
		if (!here && !covered(last, knownDistance)) barren_.push_back(last);
		if (!here || covered(seed->p, knownDistance)) return;
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

	bool covered(Vec2 p, double distance) const
	{
		for (std::size_t k = 0; k < result_.pieces.size(); k++)
		{
			if (!boxes_[k].isNear(p, distance)) continue;
			const std::vector<RidgeNode>& nodes = result_.pieces[k].nodes;
			for (std::size_t i = 1; i < nodes.size(); i++)
				if (footOnSegment(nodes[i - 1].p, nodes[i].p, p).distance < distance) return true;
		}
		return false;
	}

	/** The cell at q lies in the tail of a wall that is so much denser there that no ridge of its own can rise. */
	bool outweighed(Vec2 q, std::uint32_t n) const
	{
		const double cell = options_.cell > 0 ? options_.cell : leastCell;
		const double density = double(n) / (cell * cell);  // measurements per sigma^2
		for (std::size_t k = 0; k < result_.pieces.size(); k++)
		{
			if (!boxes_[k].isNear(q, shadowWidth)) continue;
			const std::vector<RidgeNode>& nodes = result_.pieces[k].nodes;
			for (std::size_t i = 1; i < nodes.size(); i++)
			{
				const RidgeNode &a = nodes[i - 1], &b = nodes[i];
				const double d = footOnSegment(a.p, b.p, q).distance;
				if (d > shadowWidth) continue;
				const double wall = double(std::min(a.info.occupancy, b.info.occupancy)) * expMinusSeries(0.5 * d * d);
				if (density < shadowShare * wall) return true;
			}
		}
		return false;
	}

	void add(Piece&& piece)
	{
		Bounds box;
		for (const RidgeNode& n : piece.nodes) box.extend(n.p);
		boxes_.push_back(box);
		result_.pieces.push_back(std::move(piece));
	}

	const TileField& field_;
	TileBorder& border_;
	const Options& options_;
	TileTrace result_;
	std::vector<Bounds> boxes_;  ///< of the pieces
	std::vector<Vec2> barren_;   ///< where searches ended that found no ridge of this tile
	RidgeTracer tracer_;
};
}  // namespace

TileTrace traceTile(const TileField& field, TileBorder& border, const Options& options)
{
	return TileTracer(field, border, options).run();
}

}  // namespace ridgemap
