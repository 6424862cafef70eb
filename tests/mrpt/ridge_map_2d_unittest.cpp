// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/poses/CPose3D.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>
#include <utility>

#include "scenes.h"

using namespace ridgemap;
using namespace ridgemap::test;
using mrpt::poses::CPose3D;

namespace
{
const CRidgeMap2D& straightWall()
{
	static const CRidgeMap2D map = []
	{
		CRidgeMap2D m;
		m.insertMeasurements(wall({0, 0}, {4, 0}));
		return m;
	}();
	return map;
}

const CRidgeMap2D& roomMap()
{
	static const CRidgeMap2D map = []
	{
		CRidgeMap2D m;
		m.insertMeasurements(room());
		return m;
	}();
	return map;
}
}  // namespace

TEST(CRidgeMap2D, StraightWallIsOneStraightPolyline)
{
	const CRidgeMap2D& map = straightWall();
	ASSERT_EQ(map.walls().size(), 1u);
	EXPECT_NEAR(map.walls()[0].length(), 4, 0.3);
	for (const auto& p : map.walls()[0].points) EXPECT_NEAR(p.y, 0, 0.02);
	EXPECT_FALSE(map.isEmpty());
	EXPECT_NE(map.asString().find("1600 measurements"), std::string::npos) << map.asString();
}

TEST(CRidgeMap2D, NearestWallPoint)
{
	const CRidgeMap2D& map = straightWall();
	const auto above = map.nearestWallPoint({2, 0.5});
	ASSERT_TRUE(above);
	EXPECT_NEAR(above->distance, 0.5, 0.02);
	EXPECT_NEAR(above->point.x, 2, 0.05);
	EXPECT_EQ(above->polyline, 0u);
	EXPECT_FALSE(map.nearestWallPoint({2, 0.5}, 0.4));
	EXPECT_FALSE(map.nearestWallPoint({std::nan(""), 0}));
	EXPECT_FALSE(CRidgeMap2D().nearestWallPoint({0, 0}));
	EXPECT_NEAR(map.squareDistanceToClosestCorrespondence(2, 0.5f), 0.25, 0.02);
	for (const float far : {std::numeric_limits<float>::infinity(), std::nanf("")})
		EXPECT_EQ(map.squareDistanceToClosestCorrespondence(far, 0), std::numeric_limits<float>::max());
	EXPECT_EQ(CRidgeMap2D().squareDistanceToClosestCorrespondence(0, 0), std::numeric_limits<float>::max());
	EXPECT_EQ(map.squareDistanceToClosestCorrespondence(1e30f, 0), std::numeric_limits<float>::max());
}

TEST(CRidgeMap2D, QueriesSeeEveryChange)
{
	CRidgeMap2D map;
	EXPECT_FALSE(map.nearestWallPoint({0, 0}));
	EXPECT_EQ(map.getAsSimplePointsMap()->size(), 0u);
	const auto low = wall({0, 0}, {4, 0}), high = wall({0, 2}, {4, 2});
	const auto distance = [&] { return map.nearestWallPoint({2, 1.9})->distance; };
	map.insertMeasurements(low);
	EXPECT_NEAR(distance(), 1.9, 0.02);
	map.insertMeasurements(high);
	EXPECT_NEAR(distance(), 0.1, 0.02);
	EXPECT_NEAR(map.nearestRidgePoint({2, 1.9})->distance, 0.1, 0.02);
	const auto points = map.getAsSimplePointsMap()->size();
	map.eraseMeasurements(high);
	EXPECT_NEAR(distance(), 1.9, 0.02);
	EXPECT_LT(map.getAsSimplePointsMap()->size(), points);
	CRidgeMap2D other;
	other.insertMeasurements(high);
	map.merge(other);
	EXPECT_NEAR(distance(), 0.1, 0.02);
	map.subtract(other);
	EXPECT_NEAR(distance(), 1.9, 0.02);
	const auto bytes = bytesOf(other);
	readInto(map, bytes);
	EXPECT_NEAR(distance(), 0.1, 0.02);
	map.clear();
	EXPECT_FALSE(map.nearestWallPoint({2, 1.9}));
	EXPECT_FALSE(map.nearestRidgePoint({2, 1.9}));
}

TEST(CRidgeMap2D, CopiesAreIndependent)
{
	CRidgeMap2D map;
	map.insertionOptions.maxRange = 12;
	map.genericMapParams.enableSaveAs3DObject = false;
	map.insertMeasurements(wall({0, 0}, {2, 0}));
	map.walls();
	const auto bytes = bytesOf(map);
	CRidgeMap2D copy(map), assigned;
	assigned.insertMeasurements(wall({5, 5}, {6, 6}));
	assigned = map;
	EXPECT_TRUE(bytesOf(copy) == bytes);
	EXPECT_TRUE(bytesOf(assigned) == bytes);
	EXPECT_NEAR(assigned.nearestWallPoint({1, 1})->distance, 1, 0.02);
	copy.insertMeasurements(wall({0, 1}, {2, 1}));
	EXPECT_TRUE(bytesOf(map) == bytes);
	EXPECT_NEAR(map.nearestWallPoint({1, 1})->distance, 1, 0.02);
	EXPECT_NEAR(copy.nearestWallPoint({1, 1})->distance, 0, 0.02);

	CRidgeMap2D moved(std::move(map));
	EXPECT_TRUE(bytesOf(moved) == bytes);
	EXPECT_TRUE(map.isEmpty());
	EXPECT_FALSE(map.nearestWallPoint({1, 1}));
	map = std::move(moved);
	EXPECT_TRUE(bytesOf(map) == bytes);
	map = *&map;
	EXPECT_TRUE(bytesOf(map) == bytes);
	const std::unique_ptr<mrpt::rtti::CObject> clone(map.clone());
	EXPECT_TRUE(bytesOf(dynamic_cast<CRidgeMap2D&>(*clone)) == bytes);
}

TEST(CRidgeMap2D, OptionsOfAMapWithMeasurementsAreFixed)
{
	CRidgeMap2D map;
	Options wide;
	wide.sigma = 0.2;
	map.setOptions(wide);
	EXPECT_EQ(map.options().sigma, 0.2);
	map.insertMeasurements({{0, 0}});
	EXPECT_NO_THROW(map.setOptions(wide));
	EXPECT_ANY_THROW(map.setOptions(Options()));
	EXPECT_EQ(map.options().sigma, 0.2);
	map.clear();
	EXPECT_NO_THROW(map.setOptions(Options()));
	CRidgeMap2D other(wide);
	other.insertMeasurements({{0, 0}});
	EXPECT_ANY_THROW(map.merge(other));
	EXPECT_ANY_THROW(map.subtract(other));
	wide.sigma = -1;
	EXPECT_ANY_THROW(CRidgeMap2D{wide});
}

TEST(CRidgeMap2D, BoundingBoxHoldsTheMeasurements)
{
	const auto box = roomMap().boundingBox();
	for (const auto& m : room())
	{
		ASSERT_LE(box.min.x, m.x);
		ASSERT_GE(box.max.x, m.x);
		ASSERT_LE(box.min.y, m.y);
		ASSERT_GE(box.max.y, m.y);
	}
	EXPECT_LT(box.max.x - box.min.x, 6.3);
	EXPECT_LT(box.max.y - box.min.y, 4.3);
	EXPECT_EQ(CRidgeMap2D().boundingBox().max.x, 0);
}

TEST(CRidgeMap2D, PointsMapSamplesTheRidges)
{
	const CRidgeMap2D& map = roomMap();
	const auto* points = map.getAsSimplePointsMap();
	ASSERT_NE(points, nullptr);
	EXPECT_EQ(points, map.getAsSimplePointsMap());
	double length = 0;
	for (const auto& r : map.ridges()) length += r.length();
	EXPECT_GE(double(points->size()), length / map.options().sigma);
	for (std::size_t i = 0; i < points->size(); i++)
	{
		float x, y;
		points->getPoint(i, x, y);
		ASSERT_LT(map.nearestRidgePoint({x, y})->distance, 1e-5);
	}
	// Ridges nowhere farther than half a spacing from a point.
	for (const auto& r : map.ridges())
		for (const auto& p : r.points)
			ASSERT_LE(points->squareDistanceToClosestCorrespondence(float(p.x), float(p.y)),
					  std::pow(0.51 * map.options().sigma, 2));
}

TEST(CRidgeMap2D, Visualization)
{
	CRidgeMap2D map = roomMap();
	mrpt::opengl::CSetOfObjects scene;
	map.getVisualizationInto(scene);
	ASSERT_TRUE(scene.getByName("walls"));
	EXPECT_FALSE(scene.getByName("ridges"));
	std::size_t segments = 0;
	for (const auto& w : map.walls()) segments += w.points.size() - 1;
	const auto lines = scene.getByClass<mrpt::opengl::CSetOfLines>();
	ASSERT_TRUE(lines);
	EXPECT_EQ(lines->getLineCount(), segments);
	EXPECT_EQ(std::as_const(*lines).begin()->point1.x, map.walls()[0].points[0].x);
	map.renderOptions.showRidges = map.renderOptions.showMeasurements = true;
	mrpt::opengl::CSetOfObjects all;
	map.getVisualizationInto(all);
	ASSERT_TRUE(all.getByClass<mrpt::opengl::CPointCloud>());
	EXPECT_EQ(all.getByClass<mrpt::opengl::CPointCloud>()->size(), map.core().cells().size());
	EXPECT_TRUE(all.getByName("ridges"));
	map.genericMapParams.enableSaveAs3DObject = false;
	mrpt::opengl::CSetOfObjects none;
	map.getVisualizationInto(none);
	EXPECT_TRUE(none.empty());
}

TEST(CRidgeMap2D, SavesItsRepresentation)
{
	const auto folder = std::filesystem::temp_directory_path() / ("ridgemap_save_" + std::to_string(::getpid()));
	std::filesystem::create_directories(folder);
	const CRidgeMap2D& map = roomMap();
	const std::string prefix = (folder / "m").string();
	map.saveMetricMapRepresentationToFile(prefix);
	std::ifstream csv(prefix + "_walls.csv");
	std::string line;
	std::getline(csv, line);
	EXPECT_EQ(line, "polyline,x,y");
	for (std::size_t i = 0; i < map.walls().size(); i++)
		for (const auto& p : map.walls()[i].points)
		{
			std::getline(csv, line);
			std::istringstream fields(line);
			std::size_t index;
			char comma;
			Point2 read;
			fields >> index >> comma >> read.x >> comma >> read.y;
			ASSERT_EQ(index, i);
			ASSERT_EQ(read, p) << line;
		}
	EXPECT_FALSE(std::getline(csv, line));
	EXPECT_GT(std::filesystem::file_size(prefix + "_ridges.csv"), 100u);
	EXPECT_GT(std::filesystem::file_size(prefix + ".svg"), 100u);
	mrpt::opengl::COpenGLScene scene;
	EXPECT_TRUE(scene.loadFromFile(prefix + ".3Dscene"));
	EXPECT_TRUE(scene.getByName("walls"));
	EXPECT_ANY_THROW(map.saveMetricMapRepresentationToFile((folder / "no" / "m").string()));
	CRidgeMap2D().saveMetricMapRepresentationToFile((folder / "empty").string());
	EXPECT_TRUE(std::filesystem::exists(folder / "empty.svg"));
	std::filesystem::remove_all(folder);
}

TEST(CRidgeMap2D, ConstQueriesFromManyThreads)
{
	const auto measurements = room(4, 3, 200);
	CRidgeMap2D reference;
	reference.insertMeasurements(measurements);
	const auto scan = scanOfRoom(0.2, 0.1, 0.3);
	const double likelihood = reference.computeObservationLikelihood(scan, CPose3D(0.2, 0.1, 0, 0.3, 0, 0));
	const double distance = reference.nearestWallPoint({1, 1})->distance;
	const std::size_t points = reference.getAsSimplePointsMap()->size();
	const auto bytes = bytesOf(reference);
	for (int round = 0; round < 5; round++)
	{
		CRidgeMap2D fresh;
		fresh.insertMeasurements(measurements);  // nothing is built yet: the threads race for it
		const CRidgeMap2D& map = fresh;
		std::atomic<int> wrong{0};
		std::vector<std::thread> threads;
		for (int t = 0; t < 8; t++)
			threads.emplace_back(
				[&, t]
				{
					for (int i = 0; i < 6; i++) switch ((t + i) % 6)
						{
							case 0:
								wrong += map.nearestWallPoint({1, 1})->distance != distance;
								break;
							case 1:
								wrong += map.computeObservationLikelihood(scan, CPose3D(0.2, 0.1, 0, 0.3, 0, 0)) !=
										 likelihood;
								break;
							case 2:
								wrong += map.getAsSimplePointsMap()->size() != points;
								break;
							case 3:
								wrong += !samePolylines(map.walls(), reference.walls());
								break;
							case 4:
								wrong += bytesOf(map) != bytes;
								break;
							case 5:
								wrong += !(CRidgeMap2D(map).nearestWallPoint({1, 1})->distance == distance);
								break;
						}
				});
		for (auto& thread : threads) thread.join();
		ASSERT_EQ(wrong, 0) << "round " << round;
	}
}
