// SPDX-License-Identifier: BSD-3-Clause
// The cells that a ray counts in, against exact arithmetic: those that it shares a stretch with, but for a quantum,
// which is sigma/4096, where it passes the corner of a cell.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "free_ray.h"
#include "random.h"
#include "ray_cells.h"

namespace ridgemap::test
{
namespace
{
using Wide = __int128;
using CellSet = std::set<std::pair<std::int64_t, std::int64_t>>;

/** The part of 0..1 for which from + t (to - from) is inside low..high, as two fractions over |to - from|. */
struct Stretch
{
	bool any = false, all = false;
	Wide first = 0, last = 0;
	Wide over = 1;
};

Stretch inside(std::int64_t from, std::int64_t to, std::int64_t low, std::int64_t high)
{
	if (from == to)
	{
		const bool in = from >= low && from < high;
		return {in, in, 0, 1, 1};
	}
	const std::int64_t d = to > from ? to - from : from - to;
	const std::int64_t a = to > from ? low - from : from - high;
	Stretch s{true, false, std::max<Wide>(a, 0), std::min<Wide>(Wide(a) + (high - low), d), d};
	s.any = s.first < s.last;
	return s;
}

/** Whether a cell, grown by some quanta on all sides, shares a stretch of more than a point with the ray. */
bool shares(const LatticeRay& r, std::int64_t cx, std::int64_t cy, std::int64_t grown)
{
	const std::int64_t left = cx * LatticeRay::quantaPerCell - grown, low = cy * LatticeRay::quantaPerCell - grown;
	const std::int64_t edge = LatticeRay::quantaPerCell + 2 * grown;
	const Stretch x = inside(r.from.u, r.to.u, left, left + edge), y = inside(r.from.v, r.to.v, low, low + edge);
	if (!x.any || !y.any) return false;
	if (x.all || y.all) return true;
	const Wide first = std::max(x.first * y.over, y.first * x.over), last = std::min(x.last * y.over, y.last * x.over);
	return first < last;
}

CellSet bruteForce(const LatticeRay& r, std::int64_t grown)
{
	const auto cell = [](std::int64_t v) { return floorDiv(v, LatticeRay::quantaPerCell); };
	CellSet cells;
	for (auto y = cell(std::min(r.from.v, r.to.v)) - 1; y <= cell(std::max(r.from.v, r.to.v)) + 1; y++)
		for (auto x = cell(std::min(r.from.u, r.to.u)) - 1; x <= cell(std::max(r.from.u, r.to.u)) + 1; x++)
			if (shares(r, x, y, grown)) cells.insert({x, y});
	return cells;
}

void expectSameCells(const LatticeRay& r)
{
	CellSet walked;
	std::size_t calls = 0;
	forEachCell(r,
				[&](std::int64_t x, std::int64_t y)
				{
					walked.insert({x, y});
					calls++;
				});
	ASSERT_EQ(calls, walked.size()) << "a cell came twice";
	const CellSet must = bruteForce(r, -1), may = bruteForce(r, 1);
	const auto describe = [&]
	{ return ::testing::Message() << r.from.u << "," << r.from.v << " to " << r.to.u << "," << r.to.v; };
	ASSERT_TRUE(std::includes(walked.begin(), walked.end(), must.begin(), must.end())) << describe();
	ASSERT_TRUE(std::includes(may.begin(), may.end(), walked.begin(), walked.end())) << describe();
}

CellSet cellsOf(const LatticeRay& r)
{
	CellSet walked;
	forEachCell(r, [&](std::int64_t x, std::int64_t y) { walked.insert({x, y}); });
	return walked;
}
}  // namespace

TEST(FreeRay, CellsAreThoseOfTheDefinition)
{
	Random random(1);
	for (int i = 0; i < 20000; i++)
	{
		const double reach = random.chance(0.3) ? 3e3 : 2e5;
		// Multiples of eighths of a cell make rays along borders and through corners common.
		const std::int64_t grain = random.chance(0.5) ? 1 : LatticeRay::quantaPerCell >> random.below(4);
		const auto coordinate = [&] { return std::int64_t(random.uniform(-reach, reach)) / grain * grain; };
		LatticeRay r;
		r.from = {coordinate(), coordinate()};
		r.to = {random.chance(0.1) ? r.from.u : coordinate(), random.chance(0.1) ? r.from.v : coordinate()};
		if (r.from.u == r.to.u && r.from.v == r.to.v) continue;
		expectSameCells(r);
	}
}

TEST(FreeRay, ReversedRaysPassTheSameCells)
{
	Random random(2);
	for (int i = 0; i < 5000; i++)
	{
		const auto coordinate = [&] { return std::int64_t(random.uniform(-1e5, 1e5)); };
		LatticeRay r, back;
		r.from = back.to = {coordinate(), coordinate()};
		r.to = back.from = {coordinate(), coordinate()};
		ASSERT_TRUE(cellsOf(r) == cellsOf(back));
	}
}

TEST(FreeRay, ColumnsFollowFromEachOther)
{
	Random random(4);
	for (int i = 0; i < 2000; i++)
	{
		const double reach = random.chance(0.1) ? 4e8 : 3e6;
		const auto coordinate = [&] { return std::int64_t(random.uniform(-reach, reach) / 2); };
		LatticeRay r;
		r.from = {coordinate(), coordinate()};
		r.to = {coordinate(), coordinate()};
		if (random.chance(0.1)) r.to.v = r.from.v + (random.chance(0.5) ? 1 : -1) * (r.to.u - r.from.u);
		const RayWalk walk(r);
		auto [fraction, perColumn] = walk.fractionAt(walk.firstColumn() + 1);
		for (std::int64_t column = walk.firstColumn() + 1; column < walk.lastColumn(); column++)
		{
			fraction += perColumn;
			const std::int64_t row = walk.rowAt(column), leaving = walk.rowAt(column + 1);
			ASSERT_EQ(leaving, fraction < perColumn ? row + walk.rowStep() : row);
			if (leaving == row) continue;
			ASSERT_EQ(walk.columnLeavingFor(leaving), column);
		}
	}
}

TEST(FreeRay, EndsBeforeTheMarginAndKnowsItsDirection)
{
	const double sigma = 0.05, margin = 2.5;
	const Frame frame(sigma);
	Random random(3);
	for (int i = 0; i < 2000; i++)
	{
		const FreeRay ray{random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-50, 50),
						  random.uniform(-50, 50)};
		const double dx = ray.x - ray.sensorX, dy = ray.y - ray.sensorY, length = std::hypot(dx, dy);
		const auto r = RayMaker(frame, margin).make(ray);
		ASSERT_EQ(r.has_value(), length > margin * sigma) << length;
		if (!r) continue;
		const double t = 1 - margin * sigma / length;
		const Vec2 from = frame.toLattice({ray.sensorX, ray.sensorY});
		const Vec2 to = frame.toLattice({ray.sensorX + t * dx, ray.sensorY + t * dy});
		EXPECT_NEAR(double(r->from.u), 4096 * from.x, 0.51);
		EXPECT_NEAR(double(r->from.v), 4096 * from.y, 0.51);
		EXPECT_NEAR(double(r->to.u), 4096 * to.x, 0.51);
		EXPECT_NEAR(double(r->to.v), 4096 * to.y, 0.51);
		const Vec2 d = Frame::rotateToLattice({dx, dy});
		EXPECT_NEAR(r->a, 128 * std::cos(2 * std::atan2(d.y, d.x)), 0.5001);
		EXPECT_NEAR(r->b, 128 * std::sin(2 * std::atan2(d.y, d.x)), 0.5001);
	}
}

TEST(FreeRay, OneMakerMakesTheRaysOfManySensors)
{
	const Frame frame(0.05);
	const double nan = std::nan("");
	RayMaker maker(frame, 2.5);
	Random random(6);
	FreeRay ray{1, 2, 3, 4};
	for (int i = 0; i < 2000; i++)
	{
		if (random.chance(0.3)) ray.sensorX = random.chance(0.2) ? nan : random.uniform(-9, 9);
		if (random.chance(0.3)) ray.sensorY = random.chance(0.2) ? nan : random.uniform(-9, 9);
		ray.x = random.uniform(-9, 9);
		ray.y = random.uniform(-9, 9);
		const auto one = RayMaker(frame, 2.5).make(ray), again = maker.make(ray);
		ASSERT_EQ(one.has_value(), again.has_value());
		if (!one) continue;
		ASSERT_EQ(one->from.u, again->from.u);
		ASSERT_EQ(one->from.v, again->from.v);
		ASSERT_EQ(one->to.u, again->to.u);
		ASSERT_EQ(one->to.v, again->to.v);
		ASSERT_EQ(one->a, again->a);
		ASSERT_EQ(one->b, again->b);
	}
}

TEST(FreeRay, SensorsThatAreNotKnownOrTooNearCastNone)
{
	const Frame frame(0.05);
	const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
	EXPECT_FALSE(RayMaker(frame, 2.5).make({nan, nan, 1, 2}));
	EXPECT_FALSE(RayMaker(frame, 2.5).make({nan, 0, 1, 2}));
	EXPECT_FALSE(RayMaker(frame, 2.5).make({1, 2, 1, 2}));
	EXPECT_FALSE(RayMaker(frame, 0).make({1, 2, 1, 2}));
	EXPECT_FALSE(RayMaker(frame, 2.5).make({1, 2, 1.1, 2}));
	for (const FreeRay& r :
		 {FreeRay{infinite, 0, 1, 2}, FreeRay{0, -1.1e6, 1, 2}, FreeRay{0, 0, infinite, 2}, FreeRay{0, 0, 1, nan}})
		EXPECT_THROW(RayMaker(frame, 2.5).make(r), std::invalid_argument);
}

TEST(FreeRay, LongRaysAreCountedUpToTheLimit)
{
	const double sigma = 1e-3;
	const Frame frame(sigma);
	const auto r = RayMaker(frame, 2.5).make({-1e6, -1e6, 1e6, 1e6});
	ASSERT_TRUE(r);
	const double du = double(r->to.u - r->from.u), dv = double(r->to.v - r->from.v);
	EXPECT_NEAR(std::hypot(du, dv) / 4096, maxRayLength, 1);
	std::size_t cells = 0;
	forEachCell(*r, [&](std::int64_t, std::int64_t) { cells++; });
	EXPECT_LT(cells, 1.5 * maxRayLength / double(LatticeRay::cellSigmas));
}

}  // namespace ridgemap::test
