// SPDX-License-Identifier: BSD-3-Clause
// Surfaces along tile borders and through tile corners: one polyline each, drawn once, stitched.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <cmath>

#include "lattice.h"
#include "polylines.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
/** Sigma 1; lattice coordinates go to the map frame by the library's own frame. */
Options unitOptions(double tileEdge = 16)
{
	Options o;
	o.sigma = 1;
	o.tileEdge = tileEdge;
	return o;
}

Point2 inMap(Vec2 q)
{
	return Frame(1).toMap(q);
}

void expectOneStraightLine(const Options& options, Vec2 a, Vec2 b, const std::string& what)
{
	RidgeMap map(options);
	map.insert(exactWall(inMap(a), inMap(b), 0.1));
	ASSERT_EQ(map.ridges().size(), 1u) << what;
	const Polyline& line = map.ridges()[0];
	EXPECT_NEAR(line.length(), norm(b - a), 0.6) << what;
	const Vec2 along = unit(b - a);
	for (const Point2& p : line.points)
		EXPECT_LT(std::abs(cross(Frame(1).toLattice(p) - a, along)), options.effectiveEps()) << what;
	EXPECT_EQ(duplicatedLength(map.ridges(), options), 0) << what;
	EXPECT_EQ(map.statistics().unstitchedCrossings, 0u) << what;
	EXPECT_EQ(map.walls().size(), 1u) << what;
}
}  // namespace

TEST(TileBorder, StraightWallsAlongItAreOneLine)
{
	for (const double tileEdge : {12.0, 16.0, 20.0})
		for (const double offset : {0.0, 1e-9, 1e-6, -1e-3, 0.05, -0.1, 0.3, 0.7})
			for (const double slope : {0.0, 1e-5, 1e-3, -0.02, 0.1})
			{
				const double y = 2 * tileEdge + offset;
				const std::string what = "tile " + std::to_string(tileEdge) + ", offset " + std::to_string(offset) +
										 ", slope " + std::to_string(slope);
				expectOneStraightLine(unitOptions(tileEdge), {5, y}, {60, y + 55 * slope}, what + ", along a row");
				expectOneStraightLine(unitOptions(tileEdge), {y, -33}, {y - 55 * slope, 22}, what + ", along a column");
			}
}

TEST(TileBorder, WallsThroughTileCornersAreOneLine)
{
	for (const double offset : {0.0, 1e-9, 1e-4, 0.02, -0.3})
	{
		expectOneStraightLine(unitOptions(), {-40, -40 + offset}, {40, 40 + offset},
							  "rising " + std::to_string(offset));
		expectOneStraightLine(unitOptions(), {-40, 40 + offset}, {40, -40 + offset},
							  "falling " + std::to_string(offset));
		expectOneStraightLine(unitOptions(), {-32, -16 + offset}, {64, 32 + offset}, "flat " + std::to_string(offset));
	}
}

TEST(TileBorder, WallsThatEndAtItAreOneLine)
{
	for (const double end : {31.5, 31.9, 32.0, 32.1, 32.5, 33.0})
	{
		expectOneStraightLine(unitOptions(), {8, 8}, {8, end}, "up to " + std::to_string(end));
		expectOneStraightLine(unitOptions(), {10, 5}, {end, 9}, "right to " + std::to_string(end));
	}
}

TEST(TileBorder, GridOfWallsOnAllBordersIsConnected)
{
	const Options options = unitOptions();
	std::vector<Measurement> all;
	for (const double k : {0.0, 16.0, 32.0})
		for (const auto& wall :
			 {exactWall(inMap({-10, k}), inMap({42, k}), 0.1), exactWall(inMap({k, -10}), inMap({k, 42}), 0.1)})
			all.insert(all.end(), wall.begin(), wall.end());
	RidgeMap map(options);
	map.insert(all);
	EXPECT_EQ(duplicatedLength(map.ridges(), options), 0);
	EXPECT_NEAR(totalLength(map.walls()), 6 * 52, 9 * 3);
	EXPECT_EQ(danglingEnds(map.walls(), 1.5), 0u);
	const Accuracy a = measureAccuracy(Oracle(all, 1), map.ridges(), options);
	EXPECT_EQ(a.beyondEps, 0u) << "worst " << a.worst;
}

TEST(TileBorder, CirclesThatTouchItAreClosed)
{
	for (const double radius : {4.0, 8.0, 16.0})
		for (const Vec2 centre :
			 {Vec2{0, 0}, {8, 8}, {radius, 8}, {16 - radius, 5}, {radius + 0.01, 3}, {3, 32 + radius}})
		{
			std::vector<Measurement> circle;
			for (double t = 0; t < 2 * 3.14159265358979323846; t += 0.05 / radius)
			{
				const Point2 p = inMap({centre.x + radius * std::cos(t), centre.y + radius * std::sin(t)});
				circle.push_back({p.x, p.y});
			}
			RidgeMap map(unitOptions());
			map.insert(circle);
			ASSERT_EQ(map.ridges().size(), 1u) << "radius " << radius << " at " << centre.x << " " << centre.y;
			EXPECT_TRUE(map.ridges()[0].closed) << "radius " << radius << " at " << centre.x << " " << centre.y;
			EXPECT_EQ(map.statistics().unstitchedCrossings, 0u);
		}
}

}  // namespace ridgemap::test
