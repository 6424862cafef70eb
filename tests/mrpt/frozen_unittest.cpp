// SPDX-License-Identifier: BSD-3-Clause
// Maps of polylines without measurements.
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/tfest/TMatchingPair.h>
#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/CRidgePointsMap.h>
#include <ridgemap/simplify.h>

#include <cstdio>
#include <functional>
#include <string>

#include "scenes.h"

namespace ridgemap::test
{
namespace
{
constexpr double micrometre = 1e-6;

CRidgeMap2D roomMap()
{
	CRidgeMap2D map;
	map.insertMeasurements(room());
	return map;
}

std::string messageOf(const std::function<void()>& f)
{
	try
	{
		f();
	}
	catch (const std::exception& e)
	{
		return e.what();
	}
	return "";
}
}  // namespace

TEST(FrozenMap, keepsTheWallsAndWhatQueriesSay)
{
	const CRidgeMap2D map = roomMap();
	CRidgeMap2D frozen = map;
	frozen.freeze();
	EXPECT_FALSE(map.isFrozen());
	ASSERT_TRUE(frozen.isFrozen());
	EXPECT_FALSE(frozen.isEmpty());
	EXPECT_LE(greatestDeviation(map.walls(), frozen.walls(), 0.01), micrometre);
	EXPECT_TRUE(samePolylines(frozen.ridges(), frozen.walls()));
	const auto a = map.nearestWallPoint({1, 1}), b = frozen.nearestWallPoint({1, 1});
	ASSERT_TRUE(a && b);
	EXPECT_NEAR(a->distance, b->distance, micrometre);
	EXPECT_NEAR(map.boundingBox().max.x, frozen.boundingBox().max.x, 0.2);
	EXPECT_GT(frozen.getAsSimplePointsMap()->size(), 100u);

	CRidgeMap2D onWalls = map, exactly = frozen;
	onWalls.likelihoodOptions.target = LikelihoodTarget::walls;
	onWalls.likelihoodOptions.pitch = exactly.likelihoodOptions.pitch = 0;
	const auto scan = scanOfRoom(0, 0, 0);
	EXPECT_NEAR(onWalls.computeObservationLikelihood(scan, mrpt::poses::CPose3D(0.1, 0, 0)),
				exactly.computeObservationLikelihood(scan, mrpt::poses::CPose3D(0.1, 0, 0)), 1e-3);
	mrpt::tfest::TMatchingPairList pairs;
	mrpt::maps::TMatchingParams params;
	mrpt::maps::TMatchingExtraResults extra;
	params.maxDistForCorrespondence = 0.3f;
	frozen.determineMatching2D(map.getAsSimplePointsMap(), mrpt::poses::CPose2D(0.05, 0, 0), pairs, params, extra);
	EXPECT_GT(extra.correspondencesRatio, 0.9f);
}

TEST(FrozenMap, changesAreErrorsThatSayWhy)
{
	CRidgeMap2D map = roomMap(), other = map;
	map.freeze(0.01);
	const auto lines = map.walls();
	const auto scan = scanOfRoom(0, 0, 0);
	for (const auto& change :
		 std::vector<std::function<void()>>{[&] { map.insertObservation(scan); },
											[&] {
												map.insertMeasurements(wall({0, 0}, {1, 0}));
											},
											[&] { map.eraseObservation(scan); },
											[&] {
												map.eraseMeasurements(wall({0, 0}, {1, 0}));
											},
											[&] { map.merge(other); }, [&] { map.subtract(other); },
											[&] { other.merge(map); }})
		EXPECT_NE(messageOf(change).find("frozen"), std::string::npos);
	EXPECT_TRUE(samePolylines(lines, map.walls()));
	map.clear();
	EXPECT_TRUE(map.isEmpty());
	EXPECT_FALSE(map.isFrozen());
	map.merge(other);
	EXPECT_TRUE(samePolylines(map.walls(), other.walls()));
}

TEST(FrozenMap, serializationIsExactAndSmall)
{
	CRidgeMap2D map = roomMap();
	map.likelihoodOptions.sigmaHit = 0.07;
	const auto all = bytesOf(map);
	map.freeze(0.005);
	const auto bytes = bytesOf(map);
	EXPECT_LT(bytes.size(), 2500u);
	EXPECT_LT(bytes.size(), all.size() / 10);
	CRidgeMap2D copy;
	{
		const CRidgeMap2D closed = CRidgeMap2D::fromPolylines(map.walls());
		EXPECT_TRUE(samePolylines(closed.walls(), map.walls())) << "rounding twice changes something";
	}
	readInto(copy, bytes);
	EXPECT_TRUE(copy.isFrozen());
	EXPECT_TRUE(samePolylines(copy.walls(), map.walls()));
	EXPECT_EQ(copy.likelihoodOptions.sigmaHit, 0.07);
	EXPECT_EQ(bytesOf(copy), bytes);
	EXPECT_EQ(&copy.walls(), &map.walls()) << "a copy by serialization shares the polylines";
	readInto(copy, all);
	EXPECT_FALSE(copy.isFrozen());
}

TEST(FrozenMap, damagedDataAreNotLoaded)
{
	CRidgeMap2D map = roomMap();
	map.freeze(0.02);
	const auto bytes = bytesOf(map);
	// Without the last byte, which MRPT itself puts behind the content, the content is whole.
	for (std::size_t i = 0; i + 1 < bytes.size(); i += 7)
	{
		auto cut = bytes;
		cut.resize(i);
		CRidgeMap2D copy;
		EXPECT_ANY_THROW(readInto(copy, cut)) << i;
		EXPECT_TRUE(copy.isEmpty());
	}
}

TEST(FrozenMap, ofGivenPolylines)
{
	Polyline square;
	square.closed = true;
	square.points = {{0, 0}, {2, 0}, {2, 1}, {0, 1}, {0, 0}};
	Polyline dot;
	dot.points = {{5, 5}, {5, 5 + 1e-9}};
	const CRidgeMap2D map = CRidgeMap2D::fromPolylines({square, dot});
	ASSERT_EQ(map.walls().size(), 1u);
	EXPECT_EQ(map.walls()[0].points, square.points);
	EXPECT_TRUE(map.walls()[0].closed);
	EXPECT_EQ(map.box().max, (Point2{2, 1}));
	square.points[1].x = std::nan("");
	EXPECT_THROW(CRidgeMap2D::fromPolylines({square}), std::invalid_argument);
	EXPECT_TRUE(CRidgeMap2D::fromPolylines({}).isFrozen());
}

TEST(FrozenMap, isLoadedByMrptPrograms)
{
	CRidgeMap2D map = roomMap();
	map.freeze(0.02);
	const std::string path = ::testing::TempDir() + "ridgemap_frozen_unittest.ridgemap";
	saveRidgeMap(path, map);
	mrpt::config::CConfigFileMemory ini;
	ini.write("m", "ridgeMap_count", "1");
	ini.write("m_ridgeMap_00_creationOpts", "file", path + "  // a comment");
	ini.write("m_ridgeMap_00_likelihoodOpts", "sigmaHit", "0.07");
	ini.write("m", "ridgePoints_count", "1");
	ini.write("m_ridgePoints_00_creationOpts", "file", path);
	mrpt::maps::TSetOfMetricMapInitializers list;
	list.loadFromConfigFile(ini, "m");
	mrpt::maps::CMultiMetricMap maps;
	maps.setListOfMaps(list);
	const auto loaded = maps.mapByClass<CRidgeMap2D>();
	ASSERT_TRUE(loaded);
	EXPECT_TRUE(samePolylines(loaded->walls(), map.walls()));
	EXPECT_EQ(loaded->likelihoodOptions.sigmaHit, 0.07);
	const auto points = maps.mapByClass<CRidgePointsMap>();
	ASSERT_TRUE(points);
	EXPECT_TRUE(samePolylines(points->ridgeMap().walls(), map.walls()));
	EXPECT_EQ(points->size(), map.getAsSimplePointsMap()->size());
	std::remove(path.c_str());
	EXPECT_NE(messageOf([&] { maps.setListOfMaps(list); }).find(path), std::string::npos);
}

}  // namespace ridgemap::test
