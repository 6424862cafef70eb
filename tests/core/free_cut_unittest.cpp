// SPDX-License-Identifier: BSD-3-Clause
// Walls leave out what rays passed through; ridges do not care.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <cmath>

#include "free_cut.h"
#include "polylines.h"
#include "random.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
/** A straight line along x with a vertex every 0.1 m and the same density everywhere. */
Polyline lineAt(double y, double fromX, double toX, double occupancy)
{
	Polyline line;
	const int n = int(std::lround((toX - fromX) / 0.1));
	for (int i = 0; i <= n; i++)
	{
		line.points.push_back({fromX + (toX - fromX) * i / n, y});
		line.info.push_back(VertexInfo{float(occupancy), 0.9f, 0.01f, {}, {}});
	}
	return line;
}

/** Rays in steps of `spacing` along x, from y = -2 to y = 2, leaning by `lean` in x. */
std::vector<FreeRay> curtain(double fromX, double toX, double spacing, double lean = 0)
{
	std::vector<FreeRay> rays;
	for (double x = fromX; x <= toX; x += spacing) rays.push_back({x - lean, -2, x + lean, 2});
	return rays;
}

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

TEST(FreeCut, StaysWhereHitsOutweighPasses)
{
	const Options options;
	const double spacing = 0.004;
	for (const double lean : {0.0, 1.0, 2.0})
	{
		FreeSpace space(options);
		space.insert(curtain(-4, 4, spacing, lean));
		const double passes = passesAcross(space, space.frame().toLattice({0, 0}), Frame::rotateToLattice({1, 0}));
		// In closed form: the rays that fall on a cell of 2 sigma as it lies to them, times cos^2.
		const Vec2 d = unit(Frame::rotateToLattice({lean, 2}));
		const double width = 2 * options.sigma * (std::abs(d.x) + std::abs(d.y));
		const double cosine = 2 / std::sqrt(lean * lean + 4);
		EXPECT_NEAR(passes, cosine * cosine * width / (spacing * cosine), 0.03 * passes) << lean;
		for (const double share : {0.9, 1.1})
		{
			std::vector<Polyline> removed;
			const auto kept = cutFree({lineAt(0, -1, 1, share * passes)}, space, options, &removed);
			EXPECT_EQ(kept.size(), share > 1 ? 1u : 0u) << lean;
			EXPECT_EQ(removed.size(), share > 1 ? 0u : 1u) << lean;
		}
	}
}

TEST(FreeCut, TheDensityIsInterpolatedBetweenVertices)
{
	const Options options;
	FreeSpace space(options);
	space.insert(curtain(-5, 5, 0.004));
	const double passes = passesAcross(space, space.frame().toLattice({0, 0}), Frame::rotateToLattice({1, 0}));
	// From twice the density that outweighs the passes down to hardly any: that much is left in the middle.
	Polyline line = lineAt(0, -4, 4, 2 * passes);
	line.points = {line.points.front(), line.points.back()};
	line.info = {line.info.front(), line.info.back()};
	line.info[1].occupancy = float(0.001 * passes);  // 0 would say that it is not known
	const auto kept = cutFree({line}, space, options);
	ASSERT_EQ(kept.size(), 1u);
	EXPECT_NEAR(kept[0].length(), 4, 10 * options.sigma);
}

TEST(FreeCut, PartsOfASingleSegmentAreSegments)
{
	const Options options;
	FreeSpace space(options);
	space.insert(curtain(-1, 1, 0.004));
	Polyline line = lineAt(0, -4, 4, 3);
	line.points = {line.points.front(), line.points.back()};
	line.info = {line.info.front(), line.info.back()};
	std::vector<Polyline> removed;
	const auto kept = cutFree({line}, space, options, &removed);
	ASSERT_EQ(kept.size(), 2u);
	ASSERT_EQ(removed.size(), 1u);
	for (const Polyline& part : {kept[0], kept[1], removed[0]}) EXPECT_EQ(part.points.size(), 2u);
	EXPECT_NEAR(kept[0].length(), 3, 5 * options.sigma);
	EXPECT_NEAR(kept[1].length(), 3, 5 * options.sigma);
	EXPECT_NEAR(removed[0].length(), 2, 5 * options.sigma);
}

TEST(FreeCut, TauIsTheShareOfHits)
{
	Options options;
	FreeSpace space(options);
	space.insert(curtain(-4, 4, 0.004));
	const double passes = passesAcross(space, space.frame().toLattice({0, 0}), Frame::rotateToLattice({1, 0}));
	for (const double tau : {0.0, 0.2, 0.5, 0.8})
	{
		options.freeSpaceTau = tau;
		const double least = passes * tau / (1 - tau);
		EXPECT_EQ(cutFree({lineAt(0, -1, 1, 1.1 * least + 0.001)}, space, options).size(), 1u);
		EXPECT_EQ(cutFree({lineAt(0, -1, 1, 0.9 * least + (tau > 0 ? 0 : 1e-9))}, space, options).size(),
				  tau > 0 ? 0u : 1u);
	}
}

TEST(FreeCut, FewOrGrazingRaysAreNoEvidence)
{
	const Options options;
	FreeSpace few(options), grazing(options);
	few.insert(curtain(-4, 4, 0.11));  // about one a cell
	EXPECT_EQ(cutFree({lineAt(0, -1, 1, 0.01)}, few, options).size(), 1u);
	for (int i = 0; i < 40; i++) grazing.insert(std::vector<FreeRay>{{-4, -0.02 + 0.001 * i, 4, -0.02 + 0.001 * i}});
	EXPECT_EQ(cutFree({lineAt(0, -1, 1, 3)}, grazing, options).size(), 1u);
	EXPECT_GT(grazing.interpolated(grazing.frame().toLattice({0, 0}))[0], 20);
}

TEST(FreeCut, CutsWhereTheRaysBegin)
{
	const Options options;
	FreeSpace space(options);
	space.insert(curtain(0.5, 1.5, 0.002));
	std::vector<Polyline> removed;
	const Polyline line = lineAt(0, -2, 3, 5);
	const auto kept = cutFree({line}, space, options, &removed);
	ASSERT_EQ(kept.size(), 2u);
	ASSERT_EQ(removed.size(), 1u);
	// Half of the window and of a cell are unsure.
	EXPECT_NEAR(removed[0].points.front().x, 0.5, 3 * options.sigma);
	EXPECT_NEAR(removed[0].points.back().x, 1.5, 3 * options.sigma);
	EXPECT_EQ(kept[0].points.back(), removed[0].points.front());
	EXPECT_EQ(kept[1].points.front(), removed[0].points.back());
	EXPECT_EQ(kept[0].endReason, StopReason::passedThrough);
	EXPECT_EQ(kept[0].startReason, line.startReason);
	EXPECT_NEAR(totalLength(kept) + totalLength(removed), line.length(), 1e-12);
	for (const VertexInfo& v : removed[0].info) EXPECT_NEAR(v.occupancy, 5, 1e-5);
}

TEST(FreeCut, AGapBelowTwoSigmaIsNotCut)
{
	Options options;
	options.freeSpaceWindow = 0;
	for (const bool narrow : {true, false})
	{
		FreeSpace space(options);
		const double half = (narrow ? 0.2 : 2) * options.sigma;
		space.insert(curtain(-half, half, 0.0005));
		// As strong as what a narrow beam leaves beside itself.
		const double passes = passesAcross(space, space.frame().toLattice({0, 0}), Frame::rotateToLattice({1, 0}));
		const auto kept = cutFree({lineAt(0, -2, 2, (narrow ? 0.95 : 0.5) * passes)}, space, options);
		EXPECT_EQ(kept.size(), narrow ? 1u : 2u);
	}
}

TEST(FreeCut, AWallIsNotShortenedWhereRaysPassBesideItsEnd)
{
	const Options options;
	const Polyline line = lineAt(0, -2, 2, 5);
	for (const double beyond : {0.0, 1.25, 6.0})
	{
		FreeSpace space(options);
		// Rays through a door; cells and window carry them over the last stretch of the wall.
		const double from = 2 - beyond * options.sigma;
		space.insert(curtain(from, 4, 0.007));
		std::vector<Polyline> removed;
		const auto kept = cutFree({line}, space, options, &removed);
		ASSERT_EQ(kept.size(), 1u);
		if (beyond < 2)
			EXPECT_EQ(kept[0].points.back(), line.points.back());
		else
			EXPECT_NEAR(kept[0].points.back().x, from, 3 * options.sigma);
		EXPECT_EQ(removed.size(), beyond < 2 ? 0u : 1u);
		// What was led to another wall has no end of its own there.
		Polyline led = line;
		led.info.back().origin = VertexOrigin::junction;
		EXPECT_EQ(cutFree({led}, space, options)[0].points.back() == line.points.back(), beyond < 1);
	}
}

TEST(FreeCut, AClosedLineHasNoBeginning)
{
	Options options;
	FreeSpace space(options);
	std::vector<FreeRay> rays;
	for (double x = -0.3; x < 0.5; x += 0.003) rays.push_back({x, 0, x, 3});
	space.insert(rays);
	std::vector<double> lengths;
	const int n = 180;
	for (const int turn : {0, 17, 45, 90, 133})
	{
		Polyline ring;
		ring.closed = true;
		for (int i = 0; i <= n; i++)
		{
			const double angle = 2 * 3.14159265358979323846 * ((i + turn) % n) / n;
			ring.points.push_back({std::cos(angle), std::sin(angle)});
			ring.info.push_back(VertexInfo{5, 0.9f, 0.01f, {}, {}});
		}
		std::vector<Polyline> removed;
		const auto kept = cutFree({ring}, space, options, &removed);
		ASSERT_EQ(kept.size(), 1u) << turn;
		ASSERT_EQ(removed.size(), 1u) << turn;
		EXPECT_FALSE(kept[0].closed);
		EXPECT_NEAR(kept[0].length() + removed[0].length(), ring.length(), 1e-9);
		EXPECT_NEAR(kept[0].length(), lengths.empty() ? kept[0].length() : lengths.front(), 2 * options.sigma);
		lengths.push_back(kept[0].length());
		EXPECT_NEAR(kept[0].points.back().x, removed[0].points.front().x, 1e-9);
		EXPECT_NEAR(kept[0].points.back().y, removed[0].points.front().y, 1e-9);
	}
	EXPECT_LT(lengths.front(), 2 * 3.1416 - 0.8);
}

TEST(FreeCut, APersonWhoWalkedByLeavesNoWall)
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

TEST(FreeCut, BridgesAndLeadsAreWithdrawnWhereRaysPass)
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

TEST(FreeCut, WithoutSensorsOrSwitchedOffNothingChanges)
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

TEST(FreeCut, HistoryLeavesNoTraceInTheWalls)
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

TEST(FreeCut, ErrorsLeaveTheMapAsItWas)
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
