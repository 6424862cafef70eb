// SPDX-License-Identifier: BSD-3-Clause
// Maps whose walls leave out what rays passed through: scenes with a person, gaps, and any history.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <cmath>

#include "polylines.h"
#include "random.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
/** A wall at y = 3 seen from around y = 0, and what was seen in between for some of the time. */
std::vector<Measurement> wallWithPerson(Random& random, double sigma)
{
	std::vector<Measurement> all;
	for (int scan = 0; scan < 120; scan++)
	{
		const double sensorX = random.uniform(-2, 2), sensorY = random.uniform(-0.5, 0.5);
		const bool person = scan % 10 == 0;
		for (double x = -3; x < 3; x += 0.03)
		{
			Measurement m{x, 3 + 0.2 * sigma * random.normal(), sensorX, sensorY};
			const double t = (1.2 - sensorY) / (m.y - sensorY), at = sensorX + t * (m.x - sensorX);
			if (person && std::abs(at) < 0.4) m = {at, 1.2 + 0.2 * sigma * random.normal(), sensorX, sensorY};
			all.push_back(m);
		}
	}
	return all;
}

double lengthBelow(const std::vector<Polyline>& lines, double y)
{
	double sum = 0;
	for (const Polyline& line : lines)
		for (std::size_t i = 1; i < line.points.size(); i++)
		{
			const Point2 &a = line.points[i - 1], &b = line.points[i];
			if (0.5 * (a.y + b.y) < y) sum += std::hypot(b.x - a.x, b.y - a.y);
		}
	return sum;
}

/** Random scenes have measurements; here each also has a sensor some way off. */
std::vector<Measurement> seenScene(std::uint64_t seed, double& sigma)
{
	const RandomScene scene = randomScene(seed);
	sigma = scene.sigma;
	Random random(seed + 77);
	auto measurements = scene.measurements;
	const Point2 middle{measurements.front().x, measurements.front().y};
	for (Measurement& m : measurements)
		if (random.chance(0.8))
		{
			m.sensorX = middle.x + sigma * random.uniform(-60, 60);
			m.sensorY = middle.y + sigma * random.uniform(-60, 60);
		}
	return measurements;
}
}  // namespace

TEST(FreeWalls, APersonWhoWalkedByLeavesNoWall)
{
	Random random(1);
	Options options, off;
	off.freeSpace = false;
	const auto measurements = wallWithPerson(random, options.sigma);
	RidgeMap on(options), without(off);
	on.insert(measurements);
	without.insert(measurements);
	EXPECT_GT(lengthBelow(without.walls(), 2), 0.5);
	EXPECT_EQ(lengthBelow(on.walls(), 2), 0);
	EXPECT_GT(totalLength(on.walls()), 5.9);
	EXPECT_GT(lengthBelow(on.clearedWalls(), 2), 0.5);
	EXPECT_LT(totalLength(on.clearedWalls()) - lengthBelow(on.clearedWalls(), 2), 0.05);
	EXPECT_EQ(firstDifference(on.ridges(), without.ridges()), "");
	EXPECT_TRUE(without.freeCells().empty());

	EXPECT_EQ(on.space({0.5, 0.9}).state, SpaceState::free);
	EXPECT_EQ(on.space({0, 1.2}).state, SpaceState::free) << "the person has gone";
	EXPECT_EQ(on.space({0, 3}).state, SpaceState::occupied);
	EXPECT_EQ(on.space({0, 3.6}).state, SpaceState::unknown);
	EXPECT_TRUE(on.isFree({0.5, 0.9}));
	EXPECT_EQ(without.space({0.5, 0.9}).state, SpaceState::unknown);
	EXPECT_EQ(on.space({std::nan(""), 0}).state, SpaceState::unknown);
	EXPECT_NEAR(on.space({0, 3}).hits, on.occupancy({0, 3}).value, 1e-9) << "cells of 2 sigma";
	EXPECT_EQ(on.passes({0.5, 0.9}), on.space({0.5, 0.9}).passes);
}

TEST(FreeWalls, BridgesAndLeadsAreWithdrawnWhereRaysPass)
{
	// Two walls in line, or one that ends before another, and rays through the gap between them.
	for (const bool inLine : {true, false})
		for (const double gap : {4.0, 5.0})
			for (const bool open : {false, true})
			{
				Options options;
				options.attachDistance = 5;
				const double width = gap * options.sigma;
				Random random(8);
				std::vector<Measurement> walls;
				const auto add = [&](Point2 from, Point2 to)
				{
					const double length = std::hypot(to.x - from.x, to.y - from.y);
					for (int i = 0; i < int(400 * length); i++)
					{
						const double t = random.uniform(), noise = 0.012 * random.normal();
						const double across = 0.012 * random.normal();
						walls.push_back({from.x + t * (to.x - from.x) + noise, from.y + t * (to.y - from.y) + across});
					}
				};
				add({-2, 0}, {inLine ? -width / 2 : 2, 0});
				inLine ? add({width / 2, 0}, {2, 0}) : add({0, width}, {0, 2});
				std::vector<FreeRay> rays;
				for (int i = 0; i < 400; i++)
				{
					const double t = (i + 0.5) / 400, x = (t - 0.5) * width, y = (0.5 + 0.5 * t) * width;
					rays.push_back(inLine ? FreeRay{x, -1, x, 1} : FreeRay{-1, y, 1, y});
				}
				RidgeMap map(options);
				map.insert(walls);
				if (open) map.insertFreeRays(rays);
				const double distance =
					SegmentIndex(map.walls(), 0.5).nearest({0, inLine ? 0 : width / 2}, 1) / options.sigma;
				EXPECT_EQ(distance > 1.5, open) << inLine << " " << gap << ": " << distance;
				// What is taken out is the gap, and as much beside it as the counters can tell apart.
				EXPECT_GT(totalLength(map.walls()), (inLine ? 4 : 6) - width - 5 * options.sigma);
			}
}

TEST(FreeWalls, WithoutSensorsOrSwitchedOffNothingChanges)
{
	for (int seed = 0; seed < 4; seed++)
	{
		Options options, off;
		const auto seen = seenScene(std::uint64_t(seed), options.sigma);
		off.sigma = options.sigma;
		off.freeSpace = false;
		options.sides = off.sides = false;  // which know the sensors too
		auto blind = seen;
		for (Measurement& m : blind) m = {m.x, m.y};
		RidgeMap a(options), b(off), c(off);
		a.insert(blind);
		b.insert(seen);
		c.insert(blind);
		EXPECT_EQ(firstDifference(a.walls(), c.walls()), "");
		EXPECT_EQ(firstDifference(b.walls(), c.walls()), "");
	}
}

TEST(FreeWalls, HistoryLeavesNoTraceInTheWalls)
{
	for (int seed = 0; seed < 6; seed++)
	{
		Options options;
		auto all = seenScene(std::uint64_t(100 + seed), options.sigma);
		Random random(std::uint64_t(seed) + 5);
		RidgeMap direct(options);
		direct.insert(all);
		random.shuffle(all);
		const auto middle = all.begin() + std::ptrdiff_t(random.below(all.size()));
		const std::vector<Measurement> first(all.begin(), middle), second(middle, all.end());
		RidgeMap other(options), twice(options);
		other.setThreads(2);
		other.insert(second);
		other.walls();
		RidgeMap half(options);
		half.insert(first);
		other.merge(half);
		EXPECT_EQ(firstDifference(other.walls(), direct.walls()), "") << "merged";
		twice.insert(all);
		twice.insert(all);
		twice.walls();
		twice.subtract(half);
		twice.erase(second);
		EXPECT_EQ(firstDifference(twice.walls(), direct.walls()), "") << "inserted twice, taken out once";
		EXPECT_TRUE(twice.freeCells() == direct.freeCells());
		// A ray alone changes the walls and no ridge, and leaves no trace when it is taken out.
		std::vector<FreeRay> rays;
		for (const Measurement& m : first)
			rays.push_back({m.x - 20 * options.sigma, m.y, m.x + 20 * options.sigma, m.y});
		twice.insertFreeRays(rays);
		EXPECT_EQ(firstDifference(twice.ridges(), direct.ridges()), "");
		EXPECT_NE(firstDifference(twice.walls(), direct.walls()), "");
		twice.eraseFreeRays(rays);
		EXPECT_EQ(firstDifference(twice.walls(), direct.walls()), "");
	}
}

TEST(FreeWalls, ErrorsLeaveTheMapAsItWas)
{
	Options options;
	const auto all = seenScene(9, options.sigma);
	RidgeMap map(options);
	map.insert(all);
	const auto cells = map.cells();
	const auto freeCells = map.freeCells();
	auto other = all;
	other.front().sensorX = other.front().x + 500 * options.sigma;
	other.front().sensorY = other.front().y;
	EXPECT_THROW(map.erase(other), std::invalid_argument);
	EXPECT_THROW(map.erase({{all.front().x, all.front().y + 500 * options.sigma}}), std::invalid_argument);
	EXPECT_THROW(map.insert({{2e6, 0, 0, 0}}), std::invalid_argument);
	EXPECT_THROW(map.insert({{0, 0, 2e6, 0}}), std::invalid_argument);
	EXPECT_TRUE(map.freeCells() == freeCells);
	EXPECT_EQ(firstDifference(map.cells(), cells), "");
	map.erase(all);
	EXPECT_TRUE(map.empty());
}

}  // namespace ridgemap::test
