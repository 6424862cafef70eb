// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/map_options.h>
#include <ridgemap/polyline_index.h>

#include <mutex>
#include <optional>
#include <vector>

namespace ridgemap
{
/** What decides which targets a map offers. */
struct TargetSettings
{
	LikelihoodTarget polylines = LikelihoodTarget::walls;  ///< which polylines
	double spacing = 0.05;                                 ///< greatest distance of points along them [m]
	double loneDistance = -1;  ///< measurements farther than this from the polylines are targets [m]; < 0: none

	bool operator==(const TargetSettings& o) const
	{
		return polylines == o.polylines && spacing == o.spacing && loneDistance == o.loneDistance;
	}
};

/** What scans are matched with: polylines, and measurements where there is no polyline. Immutable once built. */
class MatchingTargets
{
 public:
	/** O(n) in both. @param measurements those far from all polylines become targets. */
	MatchingTargets(const std::vector<Polyline>& polylines, const std::vector<Point2>& measurements,
					const TargetSettings& settings);

	/** The nearest target; nothing if there is none within maxDistance or the query is not finite. */
	std::optional<Foot> nearest(const Point2& query, double maxDistance) const
	{
		return index_.foot(query, maxDistance);
	}
	/** The nearest target that can be seen from a place; see PolylineIndex::visibleFoot(). */
	std::optional<Foot> nearestVisible(const Point2& query, const Point2& from, double maxDistance) const
	{
		return index_.visibleFoot(query, from, maxDistance);
	}
	/** Whether a target is a lone measurement. */
	bool isLone(const Foot& target) const { return index_.isPoint(target.segment); }
	/** Across the polyline at a target, unit length; zero for a measurement. */
	Point2 normal(const Foot& target) const;
	/** Number of the point of points() that is nearest to a target along its polyline. */
	std::size_t pointOf(const Foot& target) const { return index_.sampleOf(target); }

	/** Even points along the polylines, then the lone measurements. */
	const std::vector<Point2>& points() const { return index_.samples(); }
	const TargetSettings& settings() const { return settings_; }

 private:
	TargetSettings settings_;
	PolylineIndex index_;
};

/** A pose in the plane [m, rad]. */
struct PlanarPose
{
	double x = 0, y = 0, phi = 0;

	Point2 operator*(const Point2& p) const;
};

/** Which pairs are allowed: distance + angular * (distance to the pivot), at most `greatest`. */
struct MatchingGate
{
	double distance = 1;  ///< [m]
	double angular = 0;   ///< [m/m]
	double greatest = 2;  ///< [m]
	Point2 pivot;         ///< map frame [m]

	double at(const Point2& p) const;
};

/** Outcome of alignToLines(). */
struct Alignment
{
	PlanarPose pose;
	double score = 0;        ///< sum of 1/(1 + (d/0.1 m)^2) over points nearer than 0.5 m to a target
	unsigned steps = 0;      ///< of the solver
	bool converged = false;  ///< the last step was below 1e-6 m
};

/** Moves points, given in their own frame, so that they come to lie on the lines of the targets: Gauss-Newton from one
 * start. Each step pairs every point with its nearest target within the gate, and minimises the distances along the
 * directions to the feet with weights 1/(1 + (r/c)^2)^2, c = max(robustLeast, robustShare * gate.distance); a lone
 * measurement counts in both directions. Starved or degenerate directions are left as they are. With
 * options.matchSides, polylines that are turned away from the pose are no targets. */
Alignment alignToLines(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& start,
					   const MatchingGate& gate, const TMatchingOptions& options);

/** The same with a gate and weights that become narrower by half from one solution to the next, down to
 * options.robustLeast: finds from farther away what alignToLines() finds exactly. */
Alignment alignNarrowing(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& start,
						 MatchingGate gate, const TMatchingOptions& options);

/** From a start that may be wrong: with a narrow gate (options.nearGate), with the one given, and, unless these two
 * agree and their score reaches options.startShare of the number of points, from starts turned by multiples of
 * options.yawStep, if the gate reaches options.yawLeastGate. An earlier one counts unless a later one ends with a score
 * greater by yawMargin, where scores count less the farther a pose is from the start and the less of the scan fits
 * there (options.startSpread). Two more searches are for maps that hold all that can be seen, see options.shiftStarts
 * and options.slideReach. Some hundred of the points decide, all of them give the answer. */
Alignment alignFromSeveralStarts(const MatchingTargets& targets, const std::vector<Point2>& points,
								 const PlanarPose& start, const MatchingGate& gate, const TMatchingOptions& options);

/** Tells the first call of an alignment from those that follow. Thread-safe; copies start afresh. */
class AlignmentMemory
{
 public:
	AlignmentMemory() = default;
	AlignmentMemory(const AlignmentMemory&) {}
	AlignmentMemory& operator=(const AlignmentMemory&) { return *this; }

	/** Whether a call with this start goes on where the last one ended. */
	bool goesOn(const PlanarPose& start, double gate) const;
	void remember(const PlanarPose& end, double gate);

 private:
	mutable std::mutex mutex_;
	PlanarPose end_;
	double gate_ = -1;
};

}  // namespace ridgemap
