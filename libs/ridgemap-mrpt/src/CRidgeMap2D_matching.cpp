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

/** One pair of a local point (given in its own frame and in the map frame) and its foot on a wall. */
mrpt::tfest::TMatchingPair makePair(std::size_t localIdx, const TPoint3D& local, const TPoint3D& global,
									const NearestPoint& nearest)
{
	mrpt::tfest::TMatchingPair pair(uint32_t(nearest.sample), uint32_t(localIdx), float(nearest.point.x),
									float(nearest.point.y), float(global.z), float(local.x), float(local.y),
									float(local.z));
	pair.errorSquareAfterTransformation = float(nearest.distance * nearest.distance);
	return pair;
}

/** Pairs every point with its foot; `toMap` brings a point of the other map into the map frame. */
template <class ToMap>
void matchFeet(const PolylineIndex& walls, const mrpt::maps::CPointsMap& points, ToMap&& toMap,
			   const mrpt::maps::TMatchingParams& params, mrpt::tfest::TMatchingPairList& pairs,
			   mrpt::maps::TMatchingExtraResults& extra)
{
	pairs.clear();
	extra = mrpt::maps::TMatchingExtraResults();
	const std::size_t step = std::max<std::size_t>(1, params.decimation_other_map_points);
	const auto &x = points.getPointsBufferRef_x(), &y = points.getPointsBufferRef_y(),
			   &z = points.getPointsBufferRef_z();
	std::size_t considered = 0;
	double sumSqr = 0;
	for (std::size_t i = params.offset_other_map_points; i < x.size(); i += step)
	{
		considered++;
		const TPoint3D local(x[i], y[i], z[i]), global = toMap(local);
		const double gate =
			double(params.maxDistForCorrespondence) +
			double(params.maxAngularDistForCorrespondence) * (global - params.angularDistPivotPoint).norm();
		const auto nearest = walls.nearest({global.x, global.y}, gate);
		if (!nearest) continue;
		pairs.push_back(makePair(i, local, global, *nearest));
		sumSqr += nearest->distance * nearest->distance;
	}
	if (considered > 0) extra.correspondencesRatio = float(double(pairs.size()) / double(considered));
	extra.sumSqrDist = float(sumSqr);
}
}  // namespace

void CRidgeMap2D::determineMatching2D(const mrpt::maps::CMetricMap* otherMap, const mrpt::poses::CPose2D& otherMapPose,
									  mrpt::tfest::TMatchingPairList& correspondences,
									  const mrpt::maps::TMatchingParams& params,
									  mrpt::maps::TMatchingExtraResults& extraResults) const
{
	const auto& points = pointsToMatch(otherMap);
	mrpt::maps::TMatchingParams planar = params;
	planar.angularDistPivotPoint.z = 0;
	const double c = std::cos(otherMapPose.phi()), s = std::sin(otherMapPose.phi());
	const auto toMap = [&](const TPoint3D& p)
	{ return TPoint3D(otherMapPose.x() + c * p.x - s * p.y, otherMapPose.y() + s * p.x + c * p.y, 0); };
	matchFeet(*wallIndex(), points, toMap, planar, correspondences, extraResults);
}

void CRidgeMap2D::determineMatching3D(const mrpt::maps::CMetricMap* otherMap, const mrpt::poses::CPose3D& otherMapPose,
									  mrpt::tfest::TMatchingPairList& correspondences,
									  const mrpt::maps::TMatchingParams& params,
									  mrpt::maps::TMatchingExtraResults& extraResults) const
{
	const auto& points = pointsToMatch(otherMap);
	const auto toMap = [&](const TPoint3D& p) { return otherMapPose.composePoint(p); };
	matchFeet(*wallIndex(), points, toMap, params, correspondences, extraResults);
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
	const auto nearest = nearestWallPoint({x0, y0});
	if (!nearest) return greatest;
	return float(std::min(nearest->distance * nearest->distance, double(greatest)));
}

}  // namespace ridgemap
