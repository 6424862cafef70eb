// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/exceptions.h>
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>
#include <ridgemap/CRidgeMap2D.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ridgemap
{
namespace
{
using mrpt::math::TPoint3D;

/** The points of a map, or null if it has none to give. */
const mrpt::maps::CPointsMap* pointsOf(const mrpt::maps::CMetricMap* map)
{
	if (!map) return nullptr;
	if (const auto* points = dynamic_cast<const mrpt::maps::CPointsMap*>(map)) return points;
	return map->getAsSimplePointsMap();
}

const mrpt::maps::CPointsMap& pointsToMatch(const mrpt::maps::CMetricMap* map)
{
	const auto* points = pointsOf(map);
	ASSERTMSG_(points, "A ridge map is matched with points: give a points map, or a map with getAsSimplePointsMap()");
	return *points;
}

/** The points of the other map that take part. */
struct ChosenPoints
{
	std::vector<std::size_t> indices;
	std::vector<TPoint3D> points;
};

ChosenPoints choose(const mrpt::maps::CPointsMap& map, const mrpt::maps::TMatchingParams& params)
{
	const auto &x = map.getPointsBufferRef_x(), &y = map.getPointsBufferRef_y(), &z = map.getPointsBufferRef_z();
	const std::size_t step = std::max<std::size_t>(1, params.decimation_other_map_points);
	ChosenPoints chosen;
	for (std::size_t i = params.offset_other_map_points; i < x.size(); i += step)
	{
		chosen.indices.push_back(i);
		chosen.points.push_back({x[i], y[i], z[i]});
	}
	return chosen;
}

/** Pairs every point that has a target. `toMap` brings a point into the map frame, `find` looks for its target. */
template <class ToMap, class Find>
void makePairs(const MatchingTargets& targets, const ChosenPoints& chosen, ToMap&& toMap, Find&& find,
			   mrpt::tfest::TMatchingPairList& pairs, mrpt::maps::TMatchingExtraResults& extra)
{
	pairs.clear();
	extra = mrpt::maps::TMatchingExtraResults();
	double sumSqr = 0;
	for (std::size_t i = 0; i < chosen.points.size(); i++)
	{
		const TPoint3D &local = chosen.points[i], global = toMap(local);
		const auto target = find(global);
		if (!target) continue;
		pairs.emplace_back(uint32_t(targets.pointOf(*target)), uint32_t(chosen.indices[i]), float(target->point.x),
						   float(target->point.y), float(global.z), float(local.x), float(local.y), float(local.z));
		pairs.back().errorSquareAfterTransformation = float(target->distanceSqr);
		sumSqr += target->distanceSqr;
	}
	if (!chosen.points.empty()) extra.correspondencesRatio = float(double(pairs.size()) / double(chosen.points.size()));
	extra.sumSqrDist = float(sumSqr);
}

/** Moves the partners so that `pose` becomes the solution of the least squares over the pairs: takes the shift and the
 * turn that a rigid motion could still make good out of the residuals. The rest of them stays, for MRPT estimates the
 * covariance of the pose from it. */
void makeSolution(const PlanarPose& pose, mrpt::tfest::TMatchingPairList& pairs)
{
	Point2 centre, shift;
	const double n = double(pairs.size());
	for (const auto& pair : pairs)
	{
		const Point2 place = pose * Point2{pair.local.x, pair.local.y};
		centre.x += place.x / n;
		centre.y += place.y / n;
		shift.x += (pair.global.x - place.x) / n;
		shift.y += (pair.global.y - place.y) / n;
	}
	double moment = 0, inertia = 0;
	for (const auto& pair : pairs)
	{
		const Point2 place = pose * Point2{pair.local.x, pair.local.y};
		const double x = place.x - centre.x, y = place.y - centre.y;
		moment += x * (pair.global.y - place.y - shift.y) - y * (pair.global.x - place.x - shift.x);
		inertia += x * x + y * y;
	}
	const double turn = inertia > 0 ? moment / inertia : 0;
	for (auto& pair : pairs)
	{
		const Point2 place = pose * Point2{pair.local.x, pair.local.y};
		pair.global.x = float(pair.global.x - shift.x + turn * (place.y - centre.y));
		pair.global.y = float(pair.global.y - shift.y - turn * (place.x - centre.x));
	}
}

/** The alignment of the points with the lines; see CRidgeMap2D::determineMatching2D(). */
PlanarPose solve(const MatchingTargets& targets, const ChosenPoints& chosen, const PlanarPose& start,
				 const MatchingGate& gate, const TMatchingOptions& options, AlignmentMemory& memory)
{
	std::vector<Point2> points;
	points.reserve(chosen.points.size());
	for (const auto& p : chosen.points) points.push_back({p.x, p.y});
	// The first call solves all of the problem; those that follow keep to the solution while the program narrows its
	// gate.
	const bool first = !options.yawFirstOnly || !memory.goesOn(start, gate.distance);
	TMatchingOptions polish = options;
	polish.robustShare = 0;
	const Alignment found = first ? alignFromSeveralStarts(targets, points, start, gate, options)
								  : alignToLines(targets, points, start, gate, polish);
	memory.remember(found.pose, gate.distance);
	return found.pose;
}
}  // namespace

void CRidgeMap2D::determineMatching2D(const mrpt::maps::CMetricMap* otherMap, const mrpt::poses::CPose2D& otherMapPose,
									  mrpt::tfest::TMatchingPairList& correspondences,
									  const mrpt::maps::TMatchingParams& params,
									  mrpt::maps::TMatchingExtraResults& extraResults) const
{
	const ChosenPoints chosen = choose(pointsToMatch(otherMap), params);
	const auto targets = matchingTargets();
	const MatchingGate gate{params.maxDistForCorrespondence,
							params.maxAngularDistForCorrespondence,
							matchingOptions.maxGate,
							{params.angularDistPivotPoint.x, params.angularDistPivotPoint.y}};
	PlanarPose pose{otherMapPose.x(), otherMapPose.y(), otherMapPose.phi()};
	const bool lines = matchingOptions.method == MatchingMethod::lines;
	if (lines) pose = solve(*targets, chosen, pose, gate, matchingOptions, lastAlignment_);
	const double c = std::cos(pose.phi), s = std::sin(pose.phi);
	const auto toMap = [&](const TPoint3D& p)
	{ return TPoint3D(pose.x + c * p.x - s * p.y, pose.y + s * p.x + c * p.y, 0); };
	// Levenberg-Marquardt compares feet with squareDistanceToClosestCorrespondence(), which knows no robot.
	const bool sides = lines && matchingOptions.matchSides;
	const auto find = [&](const TPoint3D& global)
	{
		const Point2 p{global.x, global.y};
		return sides ? targets->nearestVisible(p, {pose.x, pose.y}, gate.at(p)) : targets->nearest(p, gate.at(p));
	};
	makePairs(*targets, chosen, toMap, find, correspondences, extraResults);
	if (lines) makeSolution(pose, correspondences);
}

void CRidgeMap2D::determineMatching3D(const mrpt::maps::CMetricMap* otherMap, const mrpt::poses::CPose3D& otherMapPose,
									  mrpt::tfest::TMatchingPairList& correspondences,
									  const mrpt::maps::TMatchingParams& params,
									  mrpt::maps::TMatchingExtraResults& extraResults) const
{
	const ChosenPoints chosen = choose(pointsToMatch(otherMap), params);
	const auto toMap = [&](const TPoint3D& p) { return otherMapPose.composePoint(p); };
	const auto targets = matchingTargets();
	const auto find = [&](const TPoint3D& p)
	{
		const double turned =
			double(params.maxAngularDistForCorrespondence) * (p - params.angularDistPivotPoint).norm();
		const double gate = std::min(double(params.maxDistForCorrespondence) + turned, matchingOptions.maxGate);
		return targets->nearest({p.x, p.y}, gate);
	};
	makePairs(*targets, chosen, toMap, find, correspondences, extraResults);
}

float CRidgeMap2D::compute3DMatchingRatio(const mrpt::maps::CMetricMap* otherMap,
										  const mrpt::poses::CPose3D& otherMapPose,
										  const mrpt::maps::TMatchingRatioParams& params) const
{
	if (!pointsOf(otherMap)) return 0;
	mrpt::maps::TMatchingParams matching;
	matching.maxDistForCorrespondence = params.maxDistForCorr;
	mrpt::tfest::TMatchingPairList pairs;
	mrpt::maps::TMatchingExtraResults extra;
	determineMatching3D(otherMap, otherMapPose, pairs, matching, extra);
	return extra.correspondencesRatio;
}

float CRidgeMap2D::squareDistanceToClosestCorrespondence(float x0, float y0) const
{
	constexpr float greatest = std::numeric_limits<float>::max();
	const auto nearest = matchingTargets()->nearest({x0, y0}, std::numeric_limits<double>::infinity());
	if (!nearest) return greatest;
	return float(std::min(nearest->distanceSqr, double(greatest)));
}

}  // namespace ridgemap
