// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>

#include <cmath>
#include <limits>

#include "scenes.h"

using namespace ridgemap;
using namespace ridgemap::test;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

namespace
{
CRidgeMap2D makeRoomMap()
{
	CRidgeMap2D map;
	map.insertMeasurements(room());
	return map;
}

/** Pairs points with feet on walls, and with nothing else. */
CRidgeMap2D makeFeetMap()
{
	CRidgeMap2D map = makeRoomMap();
	map.matchingOptions.method = MatchingMethod::feet;
	map.matchingOptions.matchTarget = LikelihoodTarget::walls;
	map.matchingOptions.fallback = false;
	map.matchingOptions.maxGate = 100;
	return map;
}

double exhaustiveDistance(const std::vector<Polyline>& polylines, double x, double y)
{
	double best = std::numeric_limits<double>::infinity();
	for (const auto& w : polylines)
		for (std::size_t i = 1; i < w.points.size(); i++)
		{
			const Point2 &a = w.points[i - 1], &b = w.points[i];
			const double ux = b.x - a.x, uy = b.y - a.y;
			const double t = std::clamp(((x - a.x) * ux + (y - a.y) * uy) / (ux * ux + uy * uy), 0.0, 1.0);
			best = std::min(best, std::hypot(x - a.x - t * ux, y - a.y - t * uy));
		}
	return best;
}

/** Oracle: the formula of the documentation, over all segments. */
double expectedLikelihood(const CRidgeMap2D& map, const std::vector<Polyline>& target,
						  const mrpt::obs::CObservation2DRangeScan& scan, const CPose3D& pose)
{
	const TLikelihoodOptions& o = map.likelihoodOptions;
	double sum = 0;
	for (std::size_t i = 0; i < scan.getScanSize(); i += o.decimation)
	{
		if (!scan.getScanRangeValidity(i)) continue;
		const double n = double(scan.getScanSize() - 1), angle = double(scan.aperture) * (double(i) / n - 0.5);
		const double r = scan.getScanRange(i);
		const auto p = (pose + scan.sensorPose)
						   .composePoint({r * std::cos(angle), (scan.rightToLeft ? r : -r) * std::sin(angle), 0});
		const double d = std::min(o.maxDistance, exhaustiveDistance(target, p.x, p.y));
		sum += std::log(o.zRand / o.zMax + o.zHit * std::exp(-d * d / (2 * o.sigmaHit * o.sigmaHit)));
	}
	return sum;
}

mrpt::maps::CSimplePointsMap pointsOfScan(const mrpt::obs::CObservation2DRangeScan& scan)
{
	mrpt::maps::CSimplePointsMap points;
	points.insertionOptions.minDistBetweenLaserPoints = 0;
	points.insertObservation(scan);
	return points;
}
}  // namespace

TEST(Likelihood, AgreesWithTheFormula)
{
	CRidgeMap2D map = makeRoomMap();
	map.likelihoodOptions.pitch = 0;
	auto scan = scanOfRoom(0.4, 0.2, -0.5, 500);
	scan.sensorPose = CPose3D(0.1, 0.05, 0.4, 0.2, 0, 0);
	scan.setScanRangeValidity(20, false);
	std::mt19937 random(2);
	std::uniform_real_distribution<double> unit(-1, 1);
	for (int i = 0; i < 50; i++)
	{
		const CPose3D pose(unit(random), unit(random), 0, 3 * unit(random), 0, 0);
		map.likelihoodOptions.decimation = unsigned(1 + i % 11);
		map.likelihoodOptions.target = i % 2 ? LikelihoodTarget::walls : LikelihoodTarget::ridges;
		scan.rightToLeft = i % 3 != 0;
		const auto& target = i % 2 ? map.walls() : map.ridges();
		const double expected = expectedLikelihood(map, target, scan, pose);
		EXPECT_NEAR(map.computeObservationLikelihood(scan, pose), expected, 1e-6 * std::abs(expected));
	}
}

TEST(Likelihood, CellsAreAsNearAsTheirPitch)
{
	CRidgeMap2D map = makeRoomMap();
	const TLikelihoodOptions& o = map.likelihoodOptions;
	map.likelihoodOptions.decimation = 1;
	std::mt19937 random(4);
	std::uniform_real_distribution<double> unit(-1, 1);
	for (const double pitch : {1.0, 0.25, 0.02})
		for (int i = 0; i < 300; i++)
		{
			// One beam, so that the error of its distance can be told from the value.
			mrpt::obs::CObservation2DRangeScan beam;
			beam.resizeScan(1);
			beam.setScanRange(0, float(1.1 + unit(random)));
			beam.setScanRangeValidity(0, true);
			const CPose3D pose(4 * unit(random), 4 * unit(random), 0, 3 * unit(random), 0, 0);
			const auto end = pose.composePoint({beam.getScanRange(0), 0, 0});
			const double exact = exhaustiveDistance(map.ridges(), end.x, end.y), off = 0.71 * pitch * 0.05;
			const auto value = [&](double d)
			{
				d = std::clamp(d, 0.0, o.maxDistance);
				return std::log(o.zRand / o.zMax + o.zHit * std::exp(-d * d / (2 * o.sigmaHit * o.sigmaHit)));
			};
			map.likelihoodOptions.pitch = pitch;
			const double found = map.computeObservationLikelihood(beam, pose);
			EXPECT_LE(found, value(exact - off) + 1e-5);
			EXPECT_GE(found, value(exact + off) - 1e-5);
		}
}

TEST(Likelihood, OfTheContinuousOccupancy)
{
	CRidgeMap2D map = makeRoomMap();
	map.likelihoodOptions.useOccupancy = true;
	map.likelihoodOptions.decimation = 1;
	const TLikelihoodOptions& o = map.likelihoodOptions;
	const auto scan = scanOfRoom(0.4, 0.2, -0.5);
	for (const auto& off : {CPose2D(), CPose2D(0.03, 0, 0), CPose2D(0, 0.3, 0.2), CPose2D(50, 0, 0)})
	{
		const CPose3D pose(CPose2D(0.4 + off.x(), 0.2 + off.y(), -0.5 + off.phi()));
		double expected = 0;
		for (std::size_t i = 0; i < scan.getScanSize(); i++)
		{
			const double angle = double(scan.aperture) * (double(i) / double(scan.getScanSize() - 1) - 0.5);
			const auto end =
				pose.composePoint({scan.getScanRange(i) * std::cos(angle), scan.getScanRange(i) * std::sin(angle), 0});
			const double l = map.core().occupancy({end.x, end.y}).value;
			expected += std::log(o.zRand / o.zMax + o.zHit * l / (l + map.options().lTol));
		}
		map.likelihoodOptions.pitch = 0;
		EXPECT_NEAR(map.computeObservationLikelihood(scan, pose), expected, 1e-4 * std::abs(expected));
		map.likelihoodOptions.pitch = 0.02;
		EXPECT_NEAR(map.computeObservationLikelihood(scan, pose), expected, 0.02 * std::abs(expected));
	}
}

TEST(Likelihood, BeamsWithoutReturnFollowTheRaysThatPassed)
{
	// A wall to the east and open space to the north, as seen from the origin; nobody has looked to the west.
	CRidgeMap2D map;
	std::vector<Measurement> wallAhead = wall({3, -1}, {3, 1});
	for (Measurement& m : wallAhead) m.sensorX = m.sensorY = 0;
	map.insertMeasurements(wallAhead);
	mrpt::obs::CObservation2DRangeScan beam;
	beam.maxRange = 20;
	beam.aperture = 1e-6f;
	beam.resizeScan(2);
	for (const std::size_t i : {0u, 1u})
	{
		beam.setScanRange(i, 20);
		beam.setScanRangeValidity(i, false);
	}
	map.insertionOptions.freeRayRange = 10;
	const CPose3D north(0, 0, 0, pi / 2, 0, 0), east, west(-1, 0, 0, pi, 0, 0), both(0, -2.5, 0, pi / 2, 0, 0);
	for (int i = -20; i <= 20; i++) map.insertObservation(beam, CPose3D(0.02 * i, 0, 0, pi / 2, 0, 0));
	TLikelihoodOptions& o = map.likelihoodOptions;
	const auto density = [&](double hit) { return std::log(o.zRand / o.zMax + o.zHit * hit); };
	for (const CPose3D& pose : {north, east, west}) EXPECT_EQ(map.computeObservationLikelihood(beam, pose), 0);
	o.freeBeamRange = 10;
	for (const bool occupancy : {false, true})
		for (const double pitch : {0.0, 0.25})
		{
			o.useOccupancy = occupancy;
			o.pitch = pitch;
			EXPECT_NEAR(map.computeObservationLikelihood(beam, north), density(1), 1e-9);
			EXPECT_NEAR(map.computeObservationLikelihood(beam, west), density(0.5), 1e-9);
			EXPECT_LT(map.computeObservationLikelihood(beam, east), density(0.5));
			// A quarter of the way is unknown; a cell of the counters is 1 % of the way.
			EXPECT_NEAR(map.computeObservationLikelihood(beam, both), density(0.25 * 0.5 + 0.75), 0.01);
		}
	// What ends before the wall has met nothing that it could contradict.
	o.freeBeamRange = 2.5;
	EXPECT_NEAR(map.computeObservationLikelihood(beam, east), density(1), 1e-9);
	// Beams with a return count as ever, and one beam in `decimation` without.
	mrpt::obs::CObservation2DRangeScan scan;
	scan.maxRange = 20;
	scan.aperture = 0.01f;
	scan.resizeScan(20);
	for (std::size_t i = 0; i < 20; i++)
	{
		scan.setScanRange(i, i < 10 ? 20 : 3);
		scan.setScanRangeValidity(i, i >= 10);
	}
	o.decimation = 1;
	const double all = map.computeObservationLikelihood(scan, east);
	o.freeBeamRange = 0;
	EXPECT_NEAR(all - map.computeObservationLikelihood(scan, east), 10 * density(1), 1e-9);
	o.decimation = 5;
	const double ends = map.computeObservationLikelihood(scan, east);
	o.freeBeamRange = 2.5;
	EXPECT_NEAR(map.computeObservationLikelihood(scan, east) - ends, 2 * density(1), 1e-9);
}

TEST(Likelihood, IsGreatestAtTheTruePose)
{
	const CRidgeMap2D map = makeRoomMap();
	const auto scan = scanOfRoom(0.4, 0.2, -0.5);
	const double best = map.computeObservationLikelihood(scan, CPose3D(0.4, 0.2, 0, -0.5, 0, 0));
	for (const auto& off : {CPose2D(0.2, 0, 0), CPose2D(0, -0.2, 0), CPose2D(0, 0, 0.15), CPose2D(2, 2, 2)})
		EXPECT_LT(
			map.computeObservationLikelihood(scan, CPose3D(0.4 + off.x(), 0.2 + off.y(), 0, -0.5 + off.phi(), 0, 0)),
			best);
}

TEST(Likelihood, IsFiniteWhateverComes)
{
	const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
	auto scan = scanOfRoom(0.4, 0.2, -0.5);
	scan.setScanRange(0, std::nanf(""));
	scan.setScanRange(10, std::numeric_limits<float>::infinity());
	scan.setScanRange(20, -5);
	scan.setScanRange(30, 1e30f);
	CRidgeMap2D map = makeRoomMap(), empty;
	empty.likelihoodOptions.freeBeamRange = 50;
	for (const CRidgeMap2D* m : {&map, &empty, &map})
	{
		for (const double v : {0.0, 1e9, 1e300, nan, inf, -inf})
			for (const auto& pose : {CPose3D(v, 0, 0, 0, 0, 0), CPose3D(0, v, v, 0, 0, 0)})
				EXPECT_TRUE(std::isfinite(m->computeObservationLikelihood(scan, pose))) << v;
		EXPECT_EQ(m->computeObservationLikelihood(mrpt::obs::CObservation2DRangeScan(), CPose3D()), 0);
		map.likelihoodOptions.freeBeamRange = 50;
	}
	map.likelihoodOptions.zRand = 0;
	map.likelihoodOptions.decimation = 0;
	map.likelihoodOptions.sigmaHit = 0;
	EXPECT_TRUE(std::isfinite(map.computeObservationLikelihood(scan, CPose3D())));
	map.genericMapParams.enableObservationLikelihood = false;
	EXPECT_EQ(map.computeObservationLikelihood(scan, CPose3D()), 0);
}

TEST(Matching, FeetAgreeWithExhaustiveSearch)
{
	const CRidgeMap2D map = makeFeetMap();
	const auto points = pointsOfScan(scanOfRoom(0.4, 0.2, -0.5));
	const std::size_t targets = map.getAsSimplePointsMap()->size();
	for (const auto& pose : {CPose2D(0.4, 0.2, -0.5), CPose2D(0.5, 0.1, -0.4), CPose2D(-0.6, 0.5, 1)})
		for (const float gate : {0.05f, 0.3f, 2.0f})
			for (const float angular : {0.0f, 0.05f})
			{
				mrpt::maps::TMatchingParams params;
				params.maxDistForCorrespondence = gate;
				params.maxAngularDistForCorrespondence = angular;
				params.angularDistPivotPoint = {pose.x(), pose.y(), 0};
				params.decimation_other_map_points = 3;
				params.offset_other_map_points = 2;
				mrpt::tfest::TMatchingPairList pairs;
				mrpt::maps::TMatchingExtraResults extra;
				map.determineMatching2D(&points, pose, pairs, params, extra);
				std::size_t next = 0, considered = 0;
				double sum = 0;
				for (std::size_t i = 2; i < points.size(); i += 3, considered++)
				{
					float lx, ly;
					points.getPoint(i, lx, ly);
					double x, y;
					pose.composePoint(lx, ly, x, y);
					const double d = exhaustiveDistance(map.walls(), x, y);
					const double limit = gate + angular * std::hypot(x - pose.x(), y - pose.y());
					if (std::abs(d - limit) < 1e-6) continue;
					if (d > limit) continue;
					ASSERT_LT(next, pairs.size());
					const auto& pair = pairs[next++];
					ASSERT_EQ(pair.localIdx, i);
					EXPECT_EQ(pair.local.x, lx);
					EXPECT_EQ(pair.local.y, ly);
					EXPECT_NEAR(std::hypot(pair.global.x - x, pair.global.y - y), d, 1e-5);
					EXPECT_NEAR(pair.errorSquareAfterTransformation, d * d, 1e-5);
					EXPECT_LT(exhaustiveDistance(map.walls(), pair.global.x, pair.global.y), 1e-5);
					ASSERT_LT(pair.globalIdx, targets);
					sum += d * d;
				}
				EXPECT_EQ(next, pairs.size());
				EXPECT_NEAR(extra.correspondencesRatio, double(pairs.size()) / double(considered), 1e-6);
				EXPECT_NEAR(extra.sumSqrDist, sum, 1e-4 * (1 + sum));
			}
}

TEST(Matching, GlobalIndexIsTheNearbyPoint)
{
	const CRidgeMap2D map = makeFeetMap();
	const auto points = pointsOfScan(scanOfRoom(0.4, 0.2, -0.5));
	mrpt::tfest::TMatchingPairList pairs;
	mrpt::maps::TMatchingExtraResults extra;
	map.determineMatching2D(&points, CPose2D(0.4, 0.2, -0.5), pairs, {}, extra);
	ASSERT_GT(pairs.size(), 300u);
	for (const auto& pair : pairs)
	{
		float x, y;
		map.getAsSimplePointsMap()->getPoint(pair.globalIdx, x, y);
		EXPECT_LE(std::hypot(x - pair.global.x, y - pair.global.y), 0.51 * map.options().sigma);
	}
}

TEST(Matching, MatchingIn3DKeepsTheHeight)
{
	const CRidgeMap2D map = makeFeetMap();
	mrpt::maps::CSimplePointsMap points;
	points.insertPoint(2.9f, 0, 0.7f);
	points.insertPoint(0, 0, 0.2f);
	const CPose3D pose(0.02, 0, 0.5, 0, 0, 0);
	mrpt::tfest::TMatchingPairList pairs;
	mrpt::maps::TMatchingExtraResults extra;
	map.determineMatching3D(&points, pose, pairs, {}, extra);
	ASSERT_EQ(pairs.size(), 1u);
	EXPECT_NEAR(pairs[0].global.x, 3, 0.02);
	EXPECT_NEAR(pairs[0].global.y, 0, 0.02);
	EXPECT_NEAR(pairs[0].global.z, 1.2, 1e-5);
	EXPECT_EQ(pairs[0].local.z, 0.7f);
	EXPECT_EQ(extra.correspondencesRatio, 0.5f);
}

TEST(Matching, RatioOfAMapWithItselfIsOne)
{
	const CRidgeMap2D map = makeFeetMap();
	mrpt::maps::TMatchingRatioParams params;
	EXPECT_EQ(map.compute3DMatchingRatio(&map, CPose3D(), params), 1);
	EXPECT_LT(map.compute3DMatchingRatio(&map, CPose3D(0.5, 0.5, 0, 0, 0, 0), params), 0.3);
	const mrpt::maps::COccupancyGridMap2D grid;
	EXPECT_EQ(map.compute3DMatchingRatio(&grid, CPose3D(), params), 0);
	EXPECT_EQ(map.compute3DMatchingRatio(nullptr, CPose3D(), params), 0);
	const mrpt::maps::CSimplePointsMap none;
	EXPECT_EQ(map.compute3DMatchingRatio(&none, CPose3D(), params), 0);
	EXPECT_EQ(CRidgeMap2D().compute3DMatchingRatio(&map, CPose3D(), params), 0);
}

TEST(Matching, NothingToMatch)
{
	const CRidgeMap2D map = makeFeetMap();
	const auto points = pointsOfScan(scanOfRoom(0, 0, 0));
	mrpt::tfest::TMatchingPairList pairs;
	mrpt::maps::TMatchingExtraResults extra;
	CRidgeMap2D().determineMatching2D(&points, CPose2D(), pairs, {}, extra);
	EXPECT_TRUE(pairs.empty());
	EXPECT_EQ(extra.correspondencesRatio, 0);
	mrpt::maps::TMatchingParams params;
	params.decimation_other_map_points = 0;
	params.offset_other_map_points = 1000000;
	map.determineMatching2D(&points, CPose2D(), pairs, params, extra);
	EXPECT_TRUE(pairs.empty());
	const mrpt::maps::COccupancyGridMap2D grid;
	EXPECT_ANY_THROW(map.determineMatching2D(&grid, CPose2D(), pairs, {}, extra));
	EXPECT_ANY_THROW(map.determineMatching3D(nullptr, CPose3D(), pairs, {}, extra));
}
