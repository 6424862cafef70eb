// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/poses/CPosePDF.h>
#include <mrpt/slam/CICP.h>
#include <ridgemap/CRidgePointsMap.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

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

TEST(PointsMap, AnswersAsItsRidgeMap)
{
	const CRidgePointsMap map = makeRoomMap();
	const auto points = pointsOfScan(scanOfRoom(0.4, 0.2, -0.5));
	mrpt::tfest::TMatchingPairList pairs[2], spatial[2];
	mrpt::maps::TMatchingExtraResults extra[4];
	mrpt::maps::TMatchingParams params;
	params.maxDistForCorrespondence = 0.3f;
	map.determineMatching2D(&points, CPose2D(0.41, 0.2, -0.5), pairs[0], params, extra[0]);
	CRidgeMap2D(map.ridgeMap()).determineMatching2D(&points, CPose2D(0.41, 0.2, -0.5), pairs[1], params, extra[1]);
	EXPECT_GT(pairs[0].size(), 200u);
	EXPECT_TRUE(pairs[0] == pairs[1]);
	const CPose3D inSpace(0.41, 0.2, 0.1, -0.5, 0, 0);
	map.determineMatching3D(&points, inSpace, spatial[0], params, extra[2]);
	CRidgeMap2D(map.ridgeMap()).determineMatching3D(&points, inSpace, spatial[1], params, extra[3]);
	EXPECT_GT(spatial[0].size(), 200u);
	EXPECT_TRUE(spatial[0] == spatial[1]);
	mrpt::maps::TMatchingRatioParams ratio;
	ratio.maxDistForCorr = 0.1f;
	EXPECT_EQ(map.compute3DMatchingRatio(&points, inSpace, ratio),
			  map.ridgeMap().compute3DMatchingRatio(&points, inSpace, ratio));
	EXPECT_NEAR(map.squareDistanceToClosestCorrespondence(2, 0), 1, 0.05);
	EXPECT_EQ(map.asString(), map.ridgeMap().asString() + ", as " + std::to_string(map.size()) + " points");
}

TEST(PointsMap, LoadsScansAsItInsertsThem)
{
	const auto scan = scanOfRoom(0.4, 0.2, -0.5, 3000);
	const CPose3D pose(0.4, 0.2, 0, -0.5, 0, 0);
	CRidgePointsMap inserted, loaded;
	inserted.insertObservation(scan, pose);
	loaded.loadFromRangeScan(scan, pose);
	EXPECT_GT(loaded.size(), 100u);
	EXPECT_TRUE(samePoints(inserted, loaded));
	mrpt::obs::CObservation3DRangeScan cloud;
	cloud.hasPoints3D = true;
	for (int i = 0; i < 500; i++)
	{
		cloud.points3D_x.push_back(1);
		cloud.points3D_y.push_back(0.002f * float(i));
		cloud.points3D_z.push_back(0);
	}
	CRidgePointsMap spatial;
	spatial.loadFromRangeScan(cloud, pose);
	EXPECT_EQ(spatial.ridgeMap().core().statistics().measurements, 500u);
}

TEST(PointsMap, IsDrawnAndSavedWithItsPoints)
{
	namespace fs = std::filesystem;
	const CRidgePointsMap map = makeRoomMap();
	mrpt::opengl::CSetOfObjects drawn, expected;
	map.getVisualizationInto(drawn);
	map.ridgeMap().getVisualizationInto(expected);
	EXPECT_GT(expected.size(), 0u);
	EXPECT_EQ(drawn.size(), expected.size());
	const fs::path folder = fs::temp_directory_path() / ("ridgemap_points_" + std::to_string(::getpid()));
	fs::create_directories(folder);
	map.saveMetricMapRepresentationToFile((folder / "a").string());
	std::ifstream text(folder / "a.txt");
	std::size_t lines = 0;
	for (std::string line; std::getline(text, line);) lines += line.empty() ? 0 : 1;
	EXPECT_EQ(lines, map.size());
	EXPECT_TRUE(fs::exists(folder / "a_walls.csv"));
	EXPECT_THROW(map.saveMetricMapRepresentationToFile((folder / "no such folder" / "a").string()), std::exception);
	fs::remove_all(folder);
}

TEST(PointsMap, DefinitionShowsItsOptions)
{
	CRidgePointsMap::TMapDefinition definition;
	definition.map.options.creation.sigma = 0.125;
	std::ostringstream out;
	definition.dumpToTextStream(out);
	EXPECT_NE(out.str().find("0.125"), std::string::npos) << out.str();
	for (const char* option : {"sigma", "maxRange", "matchTarget"})
		EXPECT_NE(out.str().find(option), std::string::npos) << option;
}
