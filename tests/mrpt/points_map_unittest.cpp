// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/poses/CPosePDF.h>
#include <mrpt/slam/CICP.h>
#include <ridgemap/CRidgePointsMap.h>

#include "scenes.h"

using namespace ridgemap;
using namespace ridgemap::test;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

namespace
{
CRidgePointsMap makeRoomMap()
{
	CRidgeMap2D map;
	map.insertMeasurements(room());
	return CRidgePointsMap(map);
}

bool samePoints(const mrpt::maps::CPointsMap& a, const mrpt::maps::CPointsMap& b)
{
	return a.size() == b.size() &&
		   std::equal(a.getPointsBufferRef_x().begin(), a.getPointsBufferRef_x().end(),
					  b.getPointsBufferRef_x().begin()) &&
		   std::equal(a.getPointsBufferRef_y().begin(), a.getPointsBufferRef_y().end(),
					  b.getPointsBufferRef_y().begin());
}

mrpt::maps::CSimplePointsMap pointsOfScan(const mrpt::obs::CObservation2DRangeScan& scan)
{
	mrpt::maps::CSimplePointsMap points;
	points.insertionOptions.minDistBetweenLaserPoints = 0;
	points.insertObservation(scan);
	return points;
}
}  // namespace

TEST(PointsMap, HoldsThePointsOfItsRidgeMap)
{
	CRidgePointsMap map;
	EXPECT_TRUE(map.isEmpty());
	EXPECT_TRUE(map.insertObservation(scanOfRoom(0.4, 0.2, -0.5, 3000), CPose3D(0.4, 0.2, 0, -0.5, 0, 0)));
	EXPECT_FALSE(map.isEmpty());
	EXPECT_GT(map.size(), 100u);
	EXPECT_TRUE(samePoints(map, *map.ridgeMap().getAsSimplePointsMap()));
	EXPECT_EQ(map.getAsSimplePointsMap(), &map);
	map.clear();
	EXPECT_EQ(map.size(), 0u);
	EXPECT_TRUE(map.ridgeMap().isEmpty());
}

TEST(PointsMap, IcpFindsThePose)
{
	const CRidgePointsMap map = makeRoomMap();
	const auto points = pointsOfScan(scanOfRoom(0.4, 0.2, -0.5));
	mrpt::slam::CICP icp;
	icp.options.thresholdDist = 1;
	icp.options.thresholdAng = 0.17f;
	icp.options.corresponding_points_decimation = 2;
	for (const auto& start : {CPose2D(0.5, 0.1, -0.4), CPose2D(0.2, 0.4, -0.8)})
	{
		mrpt::slam::CICP::TReturnInfo info;
		const auto pdf = icp.Align(&map, &points, start, info);
		const CPose2D found = pdf->getMeanVal();
		EXPECT_NEAR(found.x(), 0.4, 0.01);
		EXPECT_NEAR(found.y(), 0.2, 0.01);
		EXPECT_NEAR(found.phi(), -0.5, 0.003);
		EXPECT_GT(info.goodness, 0.95);
	}
}

TEST(PointsMap, IndicesOfPairsAreValid)
{
	const CRidgePointsMap map = makeRoomMap();
	const auto points = pointsOfScan(scanOfRoom(0.4, 0.2, -0.5));
	mrpt::tfest::TMatchingPairList pairs;
	mrpt::maps::TMatchingExtraResults extra;
	map.determineMatching2D(&points, CPose2D(0.45, 0.2, -0.5), pairs, {}, extra);
	ASSERT_GT(pairs.size(), 300u);
	for (const auto& pair : pairs) EXPECT_LT(pair.globalIdx, map.size());
}

TEST(PointsMap, CopiesKeepPointsAndOptions)
{
	CRidgePointsMap map = makeRoomMap();
	map.ridgeMap().matchingOptions.yawStarts = 7;
	map.ridgeMap().likelihoodOptions.decimation = 3;
	map.genericMapParams.enableObservationLikelihood = false;
	CRidgePointsMap loaded, assigned;
	readInto(loaded, bytesOf(map));
	assigned = map;
	const CRidgePointsMap copied(map);
	const auto cloned = std::dynamic_pointer_cast<CRidgePointsMap>(map.duplicateGetSmartPtr());
	ASSERT_TRUE(cloned);
	for (const CRidgePointsMap* copy :
		 std::initializer_list<const CRidgePointsMap*>{&loaded, &assigned, &copied, cloned.get()})
	{
		EXPECT_TRUE(samePoints(map, *copy));
		EXPECT_EQ(copy->ridgeMap().matchingOptions.yawStarts, 7u);
		EXPECT_EQ(copy->ridgeMap().likelihoodOptions.decimation, 3u);
		EXPECT_FALSE(copy->genericMapParams.enableObservationLikelihood);
		EXPECT_EQ(copy->ridgeMap().getAsSimplePointsMap(), map.ridgeMap().getAsSimplePointsMap()) << "shared";
	}
	assigned.clear();
	EXPECT_FALSE(map.isEmpty());
}

TEST(PointsMap, TakesOverPointsOfOtherMaps)
{
	mrpt::maps::CSimplePointsMap plain;
	for (const auto& m : room()) plain.insertPoint(float(m.x), float(m.y));
	CRidgePointsMap map;
	static_cast<mrpt::maps::CSimplePointsMap&>(map) = static_cast<const mrpt::maps::CPointsMap&>(plain);
	EXPECT_EQ(map.ridgeMap().core().statistics().measurements, plain.size());
	EXPECT_LT(map.size(), plain.size());
	map.insertPoint(0.5f, 0.5f);
	EXPECT_EQ(map.ridgeMap().core().statistics().measurements, plain.size() + 1);
}

TEST(PointsMap, LikelihoodIsThatOfTheRidgeMap)
{
	CRidgePointsMap map = makeRoomMap();
	const auto scan = scanOfRoom(0.4, 0.2, -0.5);
	const CPose3D pose(0.4, 0.2, 0, -0.5, 0, 0);
	EXPECT_TRUE(map.canComputeObservationLikelihood(scan));
	EXPECT_EQ(map.computeObservationLikelihood(scan, pose), map.ridgeMap().computeObservationLikelihood(scan, pose));
	EXPECT_EQ(map.squareDistanceToClosestCorrespondence(1, 1),
			  map.ridgeMap().squareDistanceToClosestCorrespondence(1, 1));
	map.genericMapParams.enableObservationLikelihood = false;
	EXPECT_EQ(map.computeObservationLikelihood(scan, pose), 0);
}

TEST(PointsMap, IsMadeFromAnIniFile)
{
	registerMapClasses();
	mrpt::config::CConfigFileMemory ini(
		std::string("[map]\nridgePoints_count = 1\n[map_ridgePoints_00_creationOpts]\nsigma = 0.08\n"
					"[map_ridgePoints_00_matchingOpts]\nmethod = feet\nyawStarts = 1\n"));
	mrpt::maps::TSetOfMetricMapInitializers initializers;
	initializers.loadFromConfigFile(ini, "map");
	mrpt::maps::CMultiMetricMap maps;
	maps.setListOfMaps(initializers);
	ASSERT_EQ(maps.maps.size(), 1u);
	const auto map = maps.mapByClass<CRidgePointsMap>();
	ASSERT_TRUE(map);
	EXPECT_EQ(map->ridgeMap().options().sigma, 0.08);
	EXPECT_EQ(map->ridgeMap().matchingOptions.method, MatchingMethod::feet);
	EXPECT_EQ(map->ridgeMap().matchingOptions.yawStarts, 1u);
	ini.write("map_ridgePoints_00_matchingOpts", "method", "magic");
	EXPECT_ANY_THROW(initializers.loadFromConfigFile(ini, "map"));
}
