// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <atomic>
#include <thread>

#include "scenes.h"

using namespace ridgemap;
using namespace ridgemap::test;
using mrpt::maps::CMultiMetricMap;
using mrpt::poses::CPose3D;

namespace
{
mrpt::maps::TSetOfMetricMapInitializers initializers(const std::string& text)
{
	mrpt::config::CConfigFileMemory ini(text);
	mrpt::maps::TSetOfMetricMapInitializers all;
	all.loadFromConfigFile(ini, "map");
	return all;
}

const char* const iniText =
	"[map]\nridgeMap_count = 1\npointsMap_count = 1\n"
	"[map_ridgeMap_00_creationOpts]\nsigma = 0.08 // metres\nL_tol = 2\nstepRule = paper\n"
	"enableObservationLikelihood = false\n"
	"[map_ridgeMap_00_insertOpts]\nmaxRange = 40\n"
	"[map_ridgeMap_00_likelihoodOpts]\ndecimation = 4\n"
	"[map_ridgeMap_00_renderOpts]\nshowRidges = true\n";
}  // namespace

TEST(MultiMetricMap, FromAnIniFile)
{
	CMultiMetricMap maps;
	maps.setListOfMaps(initializers(iniText));
	EXPECT_EQ(maps.maps.size(), 2u) << "one ridge map, not one for each of its names";
	const auto map = maps.mapByClass<CRidgeMap2D>();
	ASSERT_TRUE(map);
	EXPECT_EQ(map->options().sigma, 0.08);
	EXPECT_EQ(map->options().lTol, 2);
	EXPECT_EQ(map->options().stepRule, StepRule::paper);
	EXPECT_EQ(map->insertionOptions.maxRange, 40);
	EXPECT_EQ(map->likelihoodOptions.decimation, 4u);
	EXPECT_TRUE(map->renderOptions.showRidges);
	EXPECT_FALSE(map->genericMapParams.enableObservationLikelihood);
	EXPECT_TRUE(map->genericMapParams.enableObservationInsertion);
}

TEST(MultiMetricMap, DefaultIniMakesADefaultMap)
{
	CMultiMetricMap maps;
	maps.setListOfMaps(initializers(defaultIniText()));
	ASSERT_EQ(maps.maps.size(), 1u);
	EXPECT_TRUE(bytesOf(*maps.mapByClass<CRidgeMap2D>()) == bytesOf(CRidgeMap2D()));
}

TEST(MultiMetricMap, MistakesInTheIniFileAreErrors)
{
	EXPECT_ANY_THROW(initializers("[map]\nridgeMap_count=1\n[map_ridgeMap_00_creationOpts]\nsigma = -1\n"));
	EXPECT_ANY_THROW(initializers("[map]\nridgeMap_count=1\n[map_ridgeMap_00_creationOpts]\nsgima = 1\n"));
	EXPECT_ANY_THROW(initializers("[map]\nridgeMap_count=1\n[map_ridgeMap_00_insertionOpts]\nminZ = 1\n"));
}

TEST(MultiMetricMap, InsertsCopiesAndSerializes)
{
	CMultiMetricMap maps;
	maps.setListOfMaps(initializers(iniText));
	const CPose3D pose(0.4, 0.2, 0, -0.5, 0, 0);
	maps.insertObservation(scanOfRoom(0.4, 0.2, -0.5), pose);
	const auto original = maps.mapByClass<CRidgeMap2D>();
	ASSERT_FALSE(original->isEmpty());

	const CMultiMetricMap copy(maps);
	const auto copied = copy.mapByClass<CRidgeMap2D>();
	ASSERT_TRUE(copied);
	EXPECT_NE(copied, original);
	EXPECT_TRUE(bytesOf(*copied) == bytesOf(*original));
	EXPECT_TRUE(samePolylines(copied->ridges(), original->ridges()));

	CMultiMetricMap loaded;
	readInto(loaded, bytesOf(maps));
	ASSERT_TRUE(loaded.mapByClass<CRidgeMap2D>());
	EXPECT_TRUE(bytesOf(loaded) == bytesOf(maps));
	loaded.insertObservation(scanOfRoom(0.4, 0.2, -0.5), pose);
	EXPECT_FALSE(bytesOf(*loaded.mapByClass<CRidgeMap2D>()) == bytesOf(*original)) << "the copy must be a deep one";
}

TEST(MultiMetricMap, CopiesShareWhatIsBuiltUntilOneChanges)
{
	CMultiMetricMap maps;
	maps.setListOfMaps(initializers(iniText));
	const auto original = maps.mapByClass<CRidgeMap2D>();
	original->insertMeasurements(room());
	original->walls();
	CMultiMetricMap copy(maps);
	const auto copied = copy.mapByClass<CRidgeMap2D>();
	EXPECT_EQ(&copied->core(), &original->core()) << "MRPT copies by serializing, and that must not trace anew";
	EXPECT_EQ(CRidgeMap2D(*original).getAsSimplePointsMap(), original->getAsSimplePointsMap());
	const auto before = bytesOf(*original);
	copied->insertMeasurements(wall({0, -1}, {0, 1}));
	EXPECT_NE(&copied->core(), &original->core());
	EXPECT_TRUE(bytesOf(*original) == before);
	EXPECT_NEAR(original->nearestWallPoint({0, 0})->distance, 2, 0.02);
	EXPECT_NEAR(copied->nearestWallPoint({0, 0})->distance, 0, 0.02);

	// An archive must give its own content, whatever became of the map that wrote it.
	original->clear();
	CRidgeMap2D loaded;
	readInto(loaded, before);
	EXPECT_TRUE(bytesOf(loaded) == before);
	EXPECT_NEAR(loaded.nearestWallPoint({0, 0})->distance, 2, 0.02);
	CRidgeMap2D other;
	readInto(other, before);
	EXPECT_EQ(&other.core(), &loaded.core());
	other.clear();
	EXPECT_TRUE(bytesOf(loaded) == before);
}

TEST(MultiMetricMap, CopiesInSeveralThreads)
{
	CRidgeMap2D source;
	source.insertMeasurements(room(1.5, 1));
	const auto bytes = bytesOf(source);
	const auto more = wall({0, -0.5}, {0, 0.5});
	CRidgeMap2D grown(source);
	grown.insertMeasurements(more);
	const auto grownBytes = bytesOf(grown);
	std::atomic<int> wrong{0};
	std::vector<std::thread> threads;
	for (int t = 0; t < 6; t++)
		threads.emplace_back(
			[&]
			{
				for (int i = 0; i < 20; i++)
				{
					CRidgeMap2D mine;
					readInto(mine, bytes);
					wrong += bytesOf(mine) != bytes;
					mine.insertMeasurements(more);
					wrong += bytesOf(mine) != grownBytes;
					mine.eraseMeasurements(more);
					wrong += bytesOf(mine) != bytes;
				}
			});
	for (auto& thread : threads) thread.join();
	EXPECT_EQ(wrong, 0);
	EXPECT_TRUE(bytesOf(source) == bytes);
}

TEST(MultiMetricMap, LoadsASimpleMap)
{
	mrpt::maps::CSimpleMap simple;
	CRidgeMap2D expected;
	for (int i = 0; i < 4; i++)
	{
		const CPose3D pose(0.3 * i, 0.1 * i, 0, 0.4 * i, 0, 0);
		const auto scan = mrpt::obs::CObservation2DRangeScan::Create(scanOfRoom(pose.x(), pose.y(), pose.yaw()));
		mrpt::obs::CSensoryFrame frame;
		frame.insert(scan);
		simple.insert(mrpt::poses::CPose3DPDFGaussian(pose), frame);
		expected.insertObservation(*scan, pose);
	}
	CRidgeMap2D map;
	map.loadFromSimpleMap(simple);
	EXPECT_FALSE(map.isEmpty());
	EXPECT_TRUE(bytesOf(map) == bytesOf(expected));
	ASSERT_FALSE(map.walls().empty());
}
