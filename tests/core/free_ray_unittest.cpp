// SPDX-License-Identifier: BSD-3-Clause
// The cells that a ray counts in, against the definition: a stretch of more than a point in common, in exact
// arithmetic.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "free_ray.h"
#include "random.h"

namespace ridgemap::test
{
namespace
{
using Wide = __int128;
using CellSet = std::set<std::pair<std::int64_t, std::int64_t>>;

/** The part of 0..1 for which from + t (to - from) is inside low..low+edge, as two fractions over |to - from|. */
struct Stretch
{
	bool any = false, all = false;
	Wide first = 0, last = 0;
	Wide over = 1;
};

Stretch inside(std::int64_t from, std::int64_t to, std::int64_t low)
{
	const std::int64_t edge = LatticeRay::quantaPerCell;
	if (from == to)
	{
		const bool in = from >= low && from < low + edge;
		return {in, in, 0, 1, 1};
	}
	const std::int64_t d = to > from ? to - from : from - to;
	const std::int64_t a = to > from ? low - from : from - (low + edge);
	Stretch s{true, false, std::max<Wide>(a, 0), std::min<Wide>(Wide(a) + edge, d), d};
	s.any = s.first < s.last;
	return s;
}

/** Whether a cell shares a stretch of more than a point with the ray. */
bool shares(const LatticeRay& r, std::int64_t cx, std::int64_t cy)
{
	const Stretch x = inside(r.from.u, r.to.u, cx * LatticeRay::quantaPerCell);
	const Stretch y = inside(r.from.v, r.to.v, cy * LatticeRay::quantaPerCell);
	if (!x.any || !y.any) return false;
	if (x.all || y.all) return true;
	const Wide first = std::max(x.first * y.over, y.first * x.over), last = std::min(x.last * y.over, y.last * x.over);
	return first < last;
}

CellSet bruteForce(const LatticeRay& r)
{
	const auto cell = [](std::int64_t v) { return floorDiv(v, LatticeRay::quantaPerCell); };
	CellSet cells;
	for (auto y = cell(std::min(r.from.v, r.to.v)) - 1; y <= cell(std::max(r.from.v, r.to.v)) + 1; y++)
		for (auto x = cell(std::min(r.from.u, r.to.u)) - 1; x <= cell(std::max(r.from.u, r.to.u)) + 1; x++)
			if (shares(r, x, y)) cells.insert({x, y});
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
	ASSERT_TRUE(walked == bruteForce(r)) << r.from.u << "," << r.from.v << " to " << r.to.u << "," << r.to.v << ": "
										 << walked.size() << " cells, not " << bruteForce(r).size();
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

TEST(FreeRay, ReversedRaysPassTheSameCellsButOnBorders)
{
	Random random(2);
	for (int i = 0; i < 2000; i++)
	{
		const auto odd = [&] { return 2 * std::int64_t(random.uniform(-1e5, 1e5)) + 1; };
		LatticeRay r, back;
		r.from = back.to = {odd(), odd()};
		r.to = back.from = {odd(), odd()};
		if (r.from.u == r.to.u || r.from.v == r.to.v) continue;
		ASSERT_TRUE(bruteForce(r) == bruteForce(back));
		expectSameCells(back);
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
		const auto r = makeRay(frame, ray, margin);
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

TEST(FreeRay, SensorsThatAreNotKnownOrTooNearCastNone)
{
	const Frame frame(0.05);
	const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
	EXPECT_FALSE(makeRay(frame, {nan, nan, 1, 2}, 2.5));
	EXPECT_FALSE(makeRay(frame, {nan, 0, 1, 2}, 2.5));
	EXPECT_FALSE(makeRay(frame, {1, 2, 1, 2}, 2.5));
	EXPECT_FALSE(makeRay(frame, {1, 2, 1, 2}, 0));
	EXPECT_FALSE(makeRay(frame, {1, 2, 1.1, 2}, 2.5));
	for (const FreeRay& r :
		 {FreeRay{infinite, 0, 1, 2}, FreeRay{0, -1.1e6, 1, 2}, FreeRay{0, 0, infinite, 2}, FreeRay{0, 0, 1, nan}})
		EXPECT_THROW(makeRay(frame, r, 2.5), std::invalid_argument);
}

TEST(FreeRay, LongRaysAreCountedUpToTheLimit)
{
	const double sigma = 1e-3;
	const Frame frame(sigma);
	const auto r = makeRay(frame, {-1e6, -1e6, 1e6, 1e6}, 2.5);
	ASSERT_TRUE(r);
	const double du = double(r->to.u - r->from.u), dv = double(r->to.v - r->from.v);
	EXPECT_NEAR(std::hypot(du, dv) / 4096, maxRayLength, 1);
	std::size_t cells = 0;
	forEachCell(*r, [&](std::int64_t, std::int64_t) { cells++; });
	EXPECT_LT(cells, 1.5 * maxRayLength / double(LatticeRay::cellSigmas));
}

}  // namespace ridgemap::test
