// SPDX-License-Identifier: BSD-3-Clause
// Construction of one ridge inside one tile (paper section V).
#pragma once

#include <ridgemap/ridge_map.h>

#include <array>
#include <vector>

#include "field.h"
#include "ridge_point.h"
#include "tile_border.h"

namespace ridgemap
{
/** What tracing a tile came to. */
struct TileTrace
{
	std::vector<Piece> pieces;
	std::vector<PieceEnd> stubs;  ///< crossings right behind which the ridge ends
	std::array<std::size_t, std::size_t(StopReason::count_)> stops{};
	std::size_t seeds = 0;
	std::size_t traces = 0;
	StepTimes seconds;
};

/** Traces all ridges of a tile from the crossings of its border and from the measurements that no ridge covers. The
 * result depends on nothing but the field, the border and the options. */
TileTrace traceTile(const TileField& field, TileBorder& border, const Options& options);

/** Walks along one ridge. */
class RidgeTracer
{
 public:
	RidgeTracer(const TileField& field, TileBorder& border, const Options& options, const std::vector<Piece>& pieces);

	/** Result of following a ridge to one end. */
	struct Walk
	{
		std::vector<RidgeNode> nodes;  ///< begins with the start
		PieceEnd end;
		bool closed = false;
	};

	/** Follows the ridge from a point on it in the given direction. */
	Walk walk(const RidgePoint& start, Vec2 direction) const;

	/** Moves the end of a walk back to the last projected measurement (section V-C). */
	void trimToMeasurements(Walk& walk) const;

	/** Relaxes x along the unit vector `normal` onto the ridge (section V-B2). */
	struct Relaxed
	{
		RidgePoint point;
		double distance = 0;  ///< d_relaxation, the distance corrected
		bool converged = false;
		StopReason reason = StopReason::noConvergence;  ///< why not, if it did not
	};
	Relaxed relax(Vec2 x, Vec2 normal, Vec2 v1, double reach) const;

	/** The point of the ridge with a normal near `normal`, see evaluateRidge(). */
	RidgePoint evaluate(Vec2 p, Vec2 normal) const { return evaluateRidge(field_, p, normal); }
	/** p lies within eps of a polyline of about this direction; in a sided field, seen from the same side. */
	bool onPolyline(Vec2 p, Vec2 direction, Vec2 normal) const;

 private:
	struct Proposal
	{
		Relaxed next;
		TileBorder::Port* port = nullptr;  ///< the crossing that the step ends at
		bool exits = false;                ///< the step leaves the tile where there is no crossing
		Vec2 exit;                         ///< where it does
	};
	struct Verdict
	{
		bool accepted = false;
		double error = 0;  ///< estimated distance between segment and ridge
	};
	struct State;

	RidgeNode node(const RidgePoint& r) const;
	/** The side from which a ridge is seen; zero where that makes no difference. */
	Vec2 sideOf(const RidgePoint& r) const { return field_.isSided() ? r.v1 : Vec2{}; }
	Proposal propose(const State& state, double h) const;
	void finishAtBorder(const State& state, double h, Vec2 outside, Proposal& proposal) const;
	StopReason exitReason(const State& state, Vec2 p) const;
	Verdict verify(const RidgePoint& a, Vec2 tangentA, const RidgePoint& b, Vec2 tangentB) const;
	void insertMiddleNode(const RidgePoint& a, const RidgePoint& b, std::vector<RidgeNode>& nodes) const;
	double nextStep(double h, const Relaxed& relaxed, const Verdict& verdict) const;
	bool closesLoop(const State& state, const RidgePoint& next) const;
	bool measurementNear(const RidgePoint& r, Vec2 tangent) const;

	const TileField& field_;
	TileBorder& border_;
	const Options& options_;
	const std::vector<Piece>& pieces_;
	double eps_;        ///< [sigma]
	double tolerance_;  ///< of the relaxation [sigma]
	/** How closely the end of a ridge is approached, too. At most eps: no point of so short a segment is farther than
	 * that from its ends [sigma]. */
	double leastStep_;
};

}  // namespace ridgemap
