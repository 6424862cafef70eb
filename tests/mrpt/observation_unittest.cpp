// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <ridgemap/observation_to_measurements.h>

#include <cmath>
#include <limits>

#include "scenes.h"

using namespace ridgemap;
using namespace ridgemap::test;
using mrpt::math::TPoint3D;
using mrpt::poses::CPose3D;

namespace
{
const CPose3D robotPose(10, -4, 0.2, 0.7, 0, 0);
const CPose3D sensorPose(0.3, -0.1, 0.5, 0.4, 0, 0);
constexpr float notANumber = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();

/** Points of a 3-D sensor in its own frame: good ones, then some that must not come through. */
struct Cloud
{
	std::vector<float> x{2, 3, 2.5f, 1, notANumber, 0, 300, 1e30f, 2, 2}, y{0, 1, -1, 2, 1, 0, 0, 0, 0, infinite},
		z{0.1f, 0, -0.2f, 0.3f, 0, 0, 0, 0, 40, 0};
	static constexpr std::size_t good = 4;
};

/** Oracle: pose composition written out. */
void expectPoint(const Measurement& m, const TPoint3D& inSensor, const CPose3D& sensor)
{
	const auto p = robotPose.composePoint(sensor.composePoint(inSensor));
	EXPECT_NEAR(m.x, p.x, 2e-6);
	EXPECT_NEAR(m.y, p.y, 2e-6);
	const auto s = robotPose.composePoint(sensor.translation());
	EXPECT_NEAR(m.sensorX, s.x, 1e-9);
	EXPECT_NEAR(m.sensorY, s.y, 1e-9);
}

void expectCloud(const mrpt::obs::CObservation& obs)
{
	ASSERT_TRUE(canConvertToMeasurements(obs));
	const auto all = observationToMeasurements(obs, robotPose, TInsertionOptions());
	const Cloud cloud;
	ASSERT_EQ(all.size(), Cloud::good);
	for (std::size_t i = 0; i < all.size(); i++) expectPoint(all[i], {cloud.x[i], cloud.y[i], cloud.z[i]}, sensorPose);
	TInsertionOptions low;
	low.minZ = 0.6, low.maxZ = 0.75;  // the sensor is at 0.7 m: heights 0.8, 0.7, 0.5 and 1.0 m
	ASSERT_EQ(observationToMeasurements(obs, robotPose, low).size(), 1u);

	CRidgeMap2D map;
	map.insertMeasurements({{1, 1}});
	const auto before = bytesOf(map);
	EXPECT_TRUE(map.insertObservation(obs, robotPose));
	EXPECT_FALSE(bytesOf(map) == before);
	EXPECT_TRUE(map.eraseObservation(obs, robotPose));
	EXPECT_TRUE(bytesOf(map) == before);
	EXPECT_ANY_THROW(map.eraseObservation(obs, robotPose));
	EXPECT_TRUE(bytesOf(map) == before);
}
}  // namespace

TEST(Observations, Scan2DAgreesWithPointsMapOfMrpt)
{
	auto scan = scanOfRoom(0.5, -0.3, 0.1);
	scan.sensorPose = sensorPose;
	scan.setScanRangeValidity(17, false);
	mrpt::maps::CSimplePointsMap points;
	points.insertionOptions.minDistBetweenLaserPoints = 0;
	points.insertObservation(scan, robotPose);
	const auto all = observationToMeasurements(scan, robotPose, TInsertionOptions());
	ASSERT_EQ(all.size(), points.size());
	ASSERT_EQ(all.size(), 360u);
	for (std::size_t i = 0; i < all.size(); i++)
	{
		TPoint3D p;
		points.getPoint(i, p);
		ASSERT_NEAR(all[i].x, p.x, 1e-5);
		ASSERT_NEAR(all[i].y, p.y, 1e-5);
	}
	expectPoint(all[0], {-scan.getScanRange(0), 0, 0}, sensorPose);
}

TEST(Observations, Scan2DLeavesOutWhatIsNoRange)
{
	auto scan = scanOfRoom(0, 0, 0, 20);
	const float bad[] = {notANumber, infinite, -infinite, -1, 0, 1e30f, 0.01f, 100};
	for (std::size_t i = 0; i < std::size(bad); i++) scan.setScanRange(i, bad[i]);
	const auto all = observationToMeasurements(scan, robotPose, TInsertionOptions());
	EXPECT_EQ(all.size(), 20 - std::size(bad));
	TInsertionOptions wide;
	wide.minRange = 0, wide.maxRange = 1000;
	EXPECT_EQ(observationToMeasurements(scan, robotPose, wide).size(), 20 - std::size(bad) + 2);
	for (const auto& m : all) EXPECT_LE(std::hypot(m.x - m.sensorX, m.y - m.sensorY), 4);
	EXPECT_TRUE(observationToMeasurements(mrpt::obs::CObservation2DRangeScan(), robotPose, wide).empty());
}

TEST(Observations, Scan2DOfOneBeam)
{
	mrpt::obs::CObservation2DRangeScan scan;
	scan.aperture = 0.1f;
	scan.maxRange = 30;
	scan.sensorPose = sensorPose;
	scan.resizeScan(1);
	scan.setScanRange(0, 2.5f);
	scan.setScanRangeValidity(0, true);
	const auto all = observationToMeasurements(scan, robotPose, TInsertionOptions());
	ASSERT_EQ(all.size(), 1u);
	expectPoint(all[0], {2.5, 0, 0}, sensorPose);
	CRidgeMap2D map;
	EXPECT_TRUE(map.insertObservation(scan, robotPose));
	EXPECT_TRUE(std::isfinite(map.computeObservationLikelihood(scan, robotPose)));
	for (const float bad : {notANumber, infinite, -1.0f, 0.0f, 30.0f})
	{
		scan.setScanRange(0, bad);
		EXPECT_TRUE(observationToMeasurements(scan, robotPose, TInsertionOptions()).empty()) << bad;
	}
	scan.setScanRange(0, 2.5f);
	scan.setScanRangeValidity(0, false);
	EXPECT_TRUE(observationToMeasurements(scan, robotPose, TInsertionOptions()).empty());
}

TEST(Observations, Scan2DMustBeLevel)
{
	auto scan = scanOfRoom(0, 0, 0, 50);
	const auto count = [&](double pitch, double roll, double tolerance)
	{
		TInsertionOptions o;
		o.planarityTolerance = tolerance;
		scan.sensorPose = CPose3D(0, 0, 0, 0.3, pitch * pi / 180, roll * pi / 180);
		return observationToMeasurements(scan, CPose3D(), o).size();
	};
	EXPECT_EQ(count(0, 0, 0), 50u);
	EXPECT_EQ(count(4.9, 0, 5), 50u);
	EXPECT_EQ(count(5.1, 0, 5), 0u);
	EXPECT_EQ(count(4, 4, 5), 0u);
	EXPECT_EQ(count(0, 180, 5), 50u) << "hung upside down";
	EXPECT_EQ(count(0, 175.5, 5), 50u);
	EXPECT_EQ(count(60, 0, 90), 50u);
	// A slope under the robot counts, and one that the mounting makes up for does not.
	scan.sensorPose = CPose3D(0, 0, 0, 0, -10 * pi / 180, 0);
	EXPECT_TRUE(observationToMeasurements(scan, CPose3D(), TInsertionOptions()).empty());
	EXPECT_EQ(observationToMeasurements(scan, CPose3D(0, 0, 0, 0, 10 * pi / 180, 0), TInsertionOptions()).size(), 50u);
}

TEST(Observations, LeastDistanceBetweenPoints)
{
	const auto scan = scanOfRoom(0, 0, 0, 2000);
	TInsertionOptions o;
	o.minDistBetweenPoints = 0.1;
	const auto all = observationToMeasurements(scan, CPose3D(), o);
	for (std::size_t i = 1; i < all.size(); i++)
		ASSERT_GE(std::hypot(all[i].x - all[i - 1].x, all[i].y - all[i - 1].y), 0.1);
	EXPECT_GT(all.size(), 150u);
	EXPECT_LE(all.size(), 200u);
}

TEST(Observations, FarFromTheOriginNothingIsLost)
{
	const auto scan = scanOfRoom(0, 0, 0, 100);
	const CPose3D near(0, 0, 0, 0, 0, 0), far(1 << 19, -(1 << 18), 0, 0, 0, 0);
	const auto a = observationToMeasurements(scan, near, TInsertionOptions());
	const auto b = observationToMeasurements(scan, far, TInsertionOptions());
	ASSERT_EQ(a.size(), b.size());
	for (std::size_t i = 0; i < a.size(); i++)
	{
		EXPECT_NEAR(b[i].x - (1 << 19), a[i].x, 1e-9);
		EXPECT_NEAR(b[i].y + (1 << 18), a[i].y, 1e-9);
	}
}

TEST(Observations, PointCloud)
{
	const Cloud cloud;
	auto points = mrpt::maps::CSimplePointsMap::Create();
	for (std::size_t i = 0; i < cloud.x.size(); i++) points->insertPointFast(cloud.x[i], cloud.y[i], cloud.z[i]);
	mrpt::obs::CObservationPointCloud obs;
	EXPECT_TRUE(observationToMeasurements(obs, robotPose, TInsertionOptions()).empty());
	obs.pointcloud = points;
	obs.sensorPose = sensorPose;
	expectCloud(obs);
}

TEST(Observations, LevelSliceIsNotAskedForItsHeight)
{
	auto points = mrpt::maps::CSimplePointsMap::Create();
	for (int i = 0; i < 50; i++) points->insertPointFast(2, 0.1f * float(i), 0);
	mrpt::obs::CObservationPointCloud obs;
	obs.pointcloud = points;
	EXPECT_EQ(observationToMeasurements(obs, CPose3D(), TInsertionOptions()).size(), 50u);
	points->insertPointFast(2, 0, 0.5f);
	points->mark_as_modified();
	EXPECT_EQ(observationToMeasurements(obs, CPose3D(), TInsertionOptions()).size(), 1u);
}

TEST(Observations, Velodyne)
{
	const Cloud cloud;
	mrpt::obs::CObservationVelodyneScan obs;
	obs.sensorPose = sensorPose;
	EXPECT_TRUE(observationToMeasurements(obs, robotPose, TInsertionOptions()).empty());
	obs.point_cloud.x = cloud.x;
	obs.point_cloud.y = cloud.y;
	obs.point_cloud.z = cloud.z;
	obs.point_cloud.intensity.assign(cloud.x.size(), 1);
	expectCloud(obs);
}

TEST(Observations, Scan3DWithPoints)
{
	const Cloud cloud;
	mrpt::obs::CObservation3DRangeScan obs;
	obs.sensorPose = sensorPose;
	EXPECT_TRUE(observationToMeasurements(obs, robotPose, TInsertionOptions()).empty());
	obs.hasPoints3D = true;
	obs.points3D_x = cloud.x;
	obs.points3D_y = cloud.y;
	obs.points3D_z = cloud.z;
	expectCloud(obs);
}

TEST(Observations, Scan3DWithRangeImage)
{
	mrpt::obs::CObservation3DRangeScan obs;
	obs.sensorPose = CPose3D(0, 0, 1, 0, 0, 0);
	obs.hasRangeImage = true;
	obs.range_is_depth = true;
	obs.rangeUnits = 0.001f;
	obs.cameraParams.setIntrinsicParamsFromValues(60, 60, 40, 30);
	obs.cameraParams.ncols = 80, obs.cameraParams.nrows = 60;
	obs.rangeImage_setSize(60, 80);
	obs.rangeImage.fill(2500);
	for (int r = 0; r < 60; r++) obs.rangeImage(r, 5) = 0;
	const auto all = observationToMeasurements(obs, CPose3D(), TInsertionOptions());
	// A plane across the optical axis at 2.5 m; rows between the heights 0.1 and 2 m remain.
	ASSERT_GT(all.size(), 2000u);
	ASSERT_LT(all.size(), 60u * 79u);
	for (const auto& m : all) ASSERT_NEAR(m.x, 2.5, 1e-5);
	EXPECT_TRUE(obs.hasRangeImage);
	EXPECT_FALSE(obs.hasPoints3D) << "the observation itself must stay as it is";
}

TEST(Observations, Sonar)
{
	mrpt::obs::CObservationRange obs;
	obs.minSensorDistance = 0.1f;
	obs.maxSensorDistance = 4;
	obs.sensorConeApperture = float(20 * pi / 180);
	const float ranges[] = {2, 0, -1, notANumber, 5, 0.05f, 1};
	for (std::size_t i = 0; i < std::size(ranges); i++)
	{
		mrpt::obs::CObservationRange::TMeasurement echo;
		echo.sensorPose = mrpt::math::TPose3D(0.2 * double(i), 0, 0.3, 0.5 * double(i), 0, 0);
		echo.sensedDistance = ranges[i];
		obs.sensedData.push_back(echo);
	}
	const auto all = observationToMeasurements(obs, robotPose, TInsertionOptions());
	ASSERT_GT(all.size(), 20u);
	std::size_t first = 0, last = 0;
	for (const auto& m : all)
	{
		for (const std::size_t i : {0, 6})
		{
			const CPose3D sensor = robotPose + CPose3D(obs.sensedData[i].sensorPose);
			if (std::hypot(m.sensorX - sensor.x(), m.sensorY - sensor.y()) > 1e-9) continue;
			(i == 0 ? first : last)++;
			const double range = std::hypot(m.x - sensor.x(), m.y - sensor.y());
			EXPECT_LE(range, ranges[i] + 1e-5);
			EXPECT_GE(range, ranges[i] * std::cos(10.1 * pi / 180));
			double off = std::atan2(m.y - sensor.y(), m.x - sensor.x()) - sensor.yaw();
			EXPECT_LE(std::abs(std::remainder(off, 2 * pi)), 10.1 * pi / 180);
		}
	}
	EXPECT_GT(first, 0u);
	EXPECT_GT(last, 0u);
	EXPECT_EQ(first + last, all.size());
	obs.sensorConeApperture = 0;
	EXPECT_EQ(observationToMeasurements(obs, robotPose, TInsertionOptions()).size(), 2u);
	obs.sensorConeApperture = 1e9f;
	EXPECT_TRUE(observationToMeasurements(obs, robotPose, TInsertionOptions()).empty());
}

TEST(Observations, OtherKindsAreNotTaken)
{
	const mrpt::obs::CObservationImage image;
	EXPECT_FALSE(canConvertToMeasurements(image));
	EXPECT_TRUE(observationToMeasurements(image, robotPose, TInsertionOptions()).empty());
	CRidgeMap2D map;
	EXPECT_FALSE(map.insertObservation(image));
	EXPECT_FALSE(map.eraseObservation(image));
	EXPECT_FALSE(map.canComputeObservationLikelihood(image));
	EXPECT_TRUE(map.isEmpty());
}

TEST(Observations, EraseRestoresTheMapToTheBit)
{
	CRidgeMap2D map;
	std::mt19937 random(11);
	std::uniform_real_distribution<double> unit(-1, 1);
	std::vector<CPose3D> poses;
	for (int i = 0; i < 12; i++) poses.emplace_back(unit(random), unit(random), 0, 3 * unit(random), 0, 0);
	std::vector<std::vector<std::uint8_t>> states{bytesOf(map)};
	const auto scanAt = [](const CPose3D& p) { return scanOfRoom(p.x(), p.y(), p.yaw(), 181); };
	for (const auto& p : poses)
	{
		ASSERT_TRUE(map.insertObservation(scanAt(p), p));
		map.ridges();
		states.push_back(bytesOf(map));
	}
	for (std::size_t i = poses.size(); i-- > 0;)
	{
		ASSERT_TRUE(map.eraseObservation(scanAt(poses[i]), poses[i]));
		CRidgeMap2D fresh;
		for (std::size_t k = 0; k < i; k++) fresh.insertObservation(scanAt(poses[k]), poses[k]);
		ASSERT_TRUE(bytesOf(map) == states[i]);
		ASSERT_TRUE(samePolylines(map.ridges(), fresh.ridges())) << i;
		ASSERT_TRUE(samePolylines(map.walls(), fresh.walls())) << i;
	}
	EXPECT_TRUE(map.isEmpty());
}

TEST(Observations, DisabledInsertionDisablesErasing)
{
	CRidgeMap2D map;
	const auto scan = scanOfRoom(0, 0, 0);
	map.genericMapParams.enableObservationInsertion = false;
	EXPECT_FALSE(map.insertObservation(scan));
	EXPECT_FALSE(map.eraseObservation(scan));
	EXPECT_TRUE(map.isEmpty());
}

TEST(Observations, BadPosesAreRefusedWithTheMapAsItWas)
{
	CRidgeMap2D map;
	const auto scan = scanOfRoom(0, 0, 0);
	map.insertObservation(scan);
	const auto before = bytesOf(map);
	EXPECT_ANY_THROW(map.insertObservation(scan, CPose3D(2e6, 0, 0, 0, 0, 0)));
	EXPECT_TRUE(bytesOf(map) == before);
	try
	{
		EXPECT_FALSE(map.insertObservation(scan, CPose3D(std::nan(""), 0, 0, 0, 0, 0)));
	}
	catch (const std::exception&)
	{
	}
	EXPECT_TRUE(bytesOf(map) == before);
}
