// SPDX-License-Identifier: BSD-3-Clause
// Inputs without a proper surface, and surfaces drowned in outliers.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <cmath>

#include "polylines.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
Options unitOptions(double cell = 0.5, SeedRule seedRule = SeedRule::projection)
{
	Options o;
	o.sigma = 1;
	o.cell = cell;
	o.seedRule = seedRule;
	return o;
}

std::vector<Measurement> repeated(Measurement m, std::size_t n)
{
	return std::vector<Measurement>(n, m);
}
}  // namespace

TEST(NoMeasurement, IsAnEmptyMap)
{
	RidgeMap map;
	EXPECT_TRUE(map.empty());
	EXPECT_TRUE(map.ridges().empty());
	EXPECT_TRUE(map.walls().empty());
	EXPECT_TRUE(map.cells().empty());
	EXPECT_TRUE(map.boundingBox().empty());
	EXPECT_EQ(map.statistics().measurements, 0u);
	EXPECT_EQ(map.statistics().tiles, 0u);
	map.insert({});
	const UpdateResult result = map.update();
	EXPECT_EQ(result.tiles + result.evaluations + result.seeds + result.appeared.size() + result.regions.size(), 0u);
	EXPECT_THROW(map.ridge(0), std::out_of_range);
	EXPECT_THROW(map.ridge(1), std::out_of_range);
}

TEST(FewMeasurements, BelowTheThresholdAreNoRidge)
{
	RidgeMap map(unitOptions());
	map.insert({{3, 4}});
	EXPECT_TRUE(map.ridges().empty());
	EXPECT_FALSE(map.boundingBox().empty());
	EXPECT_NEAR(map.boundingBox().min.x, 3, 1e-5);
	map.insert({{3.5, 4}});
	EXPECT_TRUE(map.ridges().empty());
	EXPECT_NEAR(map.occupancy({3.25, 4}).value, 2 * std::exp(-0.5 * 0.0625), 1e-4);
}

TEST(TwoPlaces, HaveTheSegmentBetweenThem)
{
	for (const double cell : {0.0, 0.25})
	{
		// Each place is seen five times; at a distance of 1.6 sigma the density between them has one maximum.
		RidgeMap map(unitOptions(cell));
		map.insert(repeated({10, 5}, 5));
		map.insert(repeated({11.6, 5}, 5));
		ASSERT_EQ(map.ridges().size(), 1u) << "cell " << cell;
		EXPECT_NEAR(map.ridges()[0].length(), 1.6, 0.3);
		for (const Point2& p : map.ridges()[0].points) EXPECT_NEAR(p.y, 5, 0.02);
		EXPECT_TRUE(map.walls().empty()) << "shorter than what is pruned";
	}
}

TEST(EqualMeasurements, AreNoWall)
{
	for (const double cell : {0.0, 0.5})
		for (const SeedRule rule : {SeedRule::projection, SeedRule::maximum})
			for (const std::size_t n : {3u, 4u, 100u, 100000u})
			{
				RidgeMap map(unitOptions(cell, rule));
				map.insert(repeated({-7.1, 2.9}, n));
				EXPECT_EQ(map.statistics().cells, 1u);
				EXPECT_EQ(map.statistics().measurements, n);
				EXPECT_NEAR(map.occupancy({-7.1, 2.9}).value, double(n), 1e-5 * double(n));
				// A single peak has no direction: at most a stub within the cell, and no wall.
				EXPECT_LT(totalLength(map.ridges()), 1) << n << " measurements, cell " << cell;
				EXPECT_TRUE(map.walls().empty());
			}
}

TEST(EqualMeasurements, BesideAWallDoNoHarm)
{
	RidgeMap map(unitOptions());
	map.insert(exactWall({0, 0}, {40, 0}, 0.1));
	map.insert(repeated({20, 12}, 1000));
	ASSERT_EQ(map.walls().size(), 1u);
	EXPECT_NEAR(map.walls()[0].length(), 40, 0.6);
}

TEST(Blob, OfNormalScatterEndsAndStaysInside)
{
	Random random(11);
	std::vector<Measurement> blob;
	for (int i = 0; i < 1000; i++)
	{
		const double x = 2 * random.normal(), y = 2 * random.normal();
		blob.push_back({x, y});
	}
	RidgeMap map(unitOptions());
	map.insert(blob);
	const Oracle oracle(blob, 1);
	const Accuracy a = measureAccuracy(oracle, map.ridges(), map.options());
	EXPECT_GT(a.samples, 100u);
	EXPECT_EQ(a.beyondEps, 0u) << "worst " << a.worst;
	EXPECT_EQ(map.statistics().stops[std::size_t(StopReason::workLimit)], 0u);
	for (const Polyline& line : map.ridges())
		for (const Point2& p : line.points) EXPECT_LT(std::hypot(p.x, p.y), 15);
}

TEST(Outliers, OfNinetyPercentLeaveTheWall)
{
	SceneBuilder builder(12, 1, 0.35, 10);
	const auto measurements = builder.wall({-30, 0}, {30, 0}).outliers(5400, {-60, -60}, {60, 60}).finish();
	ASSERT_EQ(measurements.size(), 6000u);
	Options options = unitOptions();
	options.lTol = 10;  // the outliers alone have a mean density of 2.4 kernels
	RidgeMap map(options);
	map.insert(measurements);
	const SegmentIndex index(map.walls(), 2);
	for (double x = -28; x <= 28; x += 0.1) EXPECT_LT(index.nearest({x, 0}, 5), 0.8) << "x = " << x;
	double elsewhere = 0;
	for (const Polyline& wall : map.walls())
		for (const Point2& p : wall.points) elsewhere = std::max(elsewhere, std::abs(p.y));
	EXPECT_LT(elsewhere, 4);
	EXPECT_LT(totalLength(map.walls()), 70);
}

TEST(Outliers, OfNinetyPercentAreStillExact)
{
	SceneBuilder builder(13, 1, 0.35, 10);
	const auto measurements = builder.wall({-15, 0}, {15, 0}).outliers(2700, {-40, -40}, {40, 40}).finish();
	RidgeMap map(unitOptions());
	map.insert(measurements);
	const Accuracy a = measureAccuracy(Oracle(measurements, 1), map.ridges(), map.options());
	EXPECT_GT(a.samples, 1000u);
	EXPECT_EQ(a.beyondEps, 0u) << "of " << a.samples << ", worst " << a.worst << " eps at (" << a.worstPlace.x << ", "
							   << a.worstPlace.y << ")";
}

}  // namespace ridgemap::test
