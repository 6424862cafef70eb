// SPDX-License-Identifier: BSD-3-Clause
// The counters of rays are a pure function of the multiset of rays: insert, erase, merge and subtract are exact.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <cmath>
#include <map>
#include <set>

#include "free_cut.h"
#include "free_space.h"
#include "random.h"
#include "ray_cells.h"
#include "ray_counter.h"

namespace ridgemap::test
{
namespace
{
std::vector<Measurement> randomMeasurements(Random& random, std::size_t count)
{
	std::vector<Measurement> all;
	for (std::size_t i = 0; i < count; i++)
	{
		Measurement m{random.uniform(-8, 8), random.uniform(-8, 8)};
		if (random.chance(0.9)) m.sensorX = random.uniform(-8, 8), m.sensorY = random.uniform(-8, 8);
		all.push_back(m);
	}
	return all;
}

/** Sums over the rays in a plain map. */
std::vector<FreeCellRecord> bruteForce(const std::vector<Measurement>& measurements, const Options& options)
{
	std::map<std::pair<std::int64_t, std::int64_t>, FreeCellRecord> cells;
	RayMaker maker(Frame(options.sigma), options.freeSpaceMargin);
	for (const Measurement& m : measurements)
		if (const auto ray = maker.make({m.sensorX, m.sensorY, m.x, m.y}))
			forEachCell(*ray,
						[&](std::int64_t cx, std::int64_t cy)
						{
							FreeCellRecord& c = cells[{cy, cx}];
							c = {cx, cy, c.n + 1, c.a + ray->a, c.b + ray->b};
						});
	std::vector<FreeCellRecord> list;
	for (const auto& entry : cells) list.push_back(entry.second);
	return list;
}

using Measurements = std::vector<Measurement>;
}  // namespace

TEST(FreeSpace, CountsEveryRayOnce)
{
	Random random(1);
	const Options options;
	FreeSpace space(options);
	const auto all = randomMeasurements(random, 500);
	space.insert(all);
	const auto expected = bruteForce(all, options);
	EXPECT_GT(expected.size(), 5000u);
	EXPECT_TRUE(space.cells() == expected);
	EXPECT_EQ(space.cellCount(), expected.size());
}

TEST(FreeSpace, MemoryIsThatOfTheTilesThatRaysPassed)
{
	Random random(2);
	FreeSpace space{Options()};
	EXPECT_EQ(space.memoryBytes(), 0u);
	const auto all = randomMeasurements(random, 100);
	space.insert(all);
	std::set<std::pair<std::int32_t, std::int32_t>> tiles;
	for (const FreeCellRecord& c : space.cells())
	{
		const TileKey key = CounterTile::keyOf(c.cx, c.cy);
		tiles.insert({key.x, key.y});
	}
	EXPECT_GT(tiles.size(), 20u);
	EXPECT_EQ(space.memoryBytes(), tiles.size() * sizeof(CounterTile));
	space.erase(all);
	EXPECT_EQ(space.memoryBytes(), 0u);
}

TEST(FreeSpace, EveryStretchOfARayCountsAsItsWalkSays)
{
	Random random(7);
	for (int i = 0; i < 3000; i++)
	{
		// Multiples of eighths of a cell make diagonals, rays along borders and through corners common.
		const double reach = random.chance(0.3) ? 2e4 : 3e6;
		const std::int64_t grain = random.chance(0.5) ? 1 : LatticeRay::quantaPerCell >> random.below(4);
		const auto coordinate = [&] { return std::int64_t(random.uniform(-reach, reach)) / grain * grain; };
		LatticeRay r;
		r.from = {coordinate(), coordinate()};
		r.to = {random.chance(0.1) ? r.from.u : coordinate(), random.chance(0.1) ? r.from.v : coordinate()};
		if (random.chance(0.2)) r.to.v = r.from.v + (random.chance(0.5) ? 1 : -1) * (r.to.u - r.from.u);
		if (r.from.u == r.to.u && r.from.v == r.to.v) continue;
		r.a = 3;
		r.b = -5;
		CounterTiles tiles;
		RayCounter(tiles).count({r, r}, 1);
		std::size_t used = 0, walked = 0;
		for (const auto& entry : tiles) used += entry.second->used();
		forEachCell(r,
					[&](std::int64_t cx, std::int64_t cy)
					{
						const auto found = tiles.find(CounterTile::keyOf(cx, cy));
						ASSERT_TRUE(found != tiles.end());
						ASSERT_TRUE((found->second->sums(CounterTile::slot(cx, cy)) == PassSums{2, 6, -10}))
							<< r.from.u << "," << r.from.v << " to " << r.to.u << "," << r.to.v;
						walked++;
					});
		ASSERT_EQ(used, walked);
	}
}

TEST(FreeSpace, CentresAreThoseOfTheCellsThatManyRaysPassed)
{
	Random random(5);
	RidgeMap map;
	map.insert(randomMeasurements(random, 300));
	const auto cells = map.freeCells();
	const Frame frame(map.options().sigma);
	for (const double least : {0.0, 1.0, 3.0, 1e6})
	{
		std::vector<Point2> expected;
		for (const FreeCellRecord& c : cells)
			if (double(c.n) > least) expected.push_back(frame.toMap({2 * double(c.cx) + 1, 2 * double(c.cy) + 1}));
		EXPECT_TRUE(map.freeCellCentres(least) == expected) << least;
		// Each lies in the cell: the counters say so.
		for (const Point2& p : map.freeCellCentres(least)) ASSERT_GT(map.passes(p), 0);
	}
	EXPECT_EQ(map.freeCellCentres(0).size(), cells.size());
	EXPECT_TRUE(map.passedAnywhere());
	EXPECT_FALSE(RidgeMap().passedAnywhere());
}

TEST(FreeSpace, OrderBatchesErasuresAndMergesLeaveNoTrace)
{
	Random random(2);
	const Options options;
	for (int round = 0; round < 20; round++)
	{
		auto all = randomMeasurements(random, 200);
		const auto foreign = randomMeasurements(random, 50);
		const auto expected = bruteForce(all, options);
		random.shuffle(all);
		const auto middle = all.begin() + std::ptrdiff_t(random.below(all.size()));
		FreeSpace a(options), b(options);
		a.insert(foreign);
		a.insert(Measurements(all.begin(), middle));
		b.insert(all);
		b.erase(Measurements(all.begin(), middle));
		FreeSpace c = a;
		a.merge(b);
		a.erase(foreign);
		EXPECT_TRUE(a.cells() == expected);
		c.insert(all);
		c.insert(Measurements(middle, all.end()));
		c.erase(foreign);
		c.subtract(a);
		EXPECT_TRUE(c.cells() == expected);
		c.subtract(a);
		EXPECT_TRUE(c.empty());
		EXPECT_EQ(c.memoryBytes(), 0u);
	}
}

TEST(FreeSpace, TakingOutWhatIsNotThereChangesNothing)
{
	Random random(3);
	const Options options;
	FreeSpace space(options), other(options);
	const auto held = randomMeasurements(random, 100);
	auto tooMuch = held;
	tooMuch.push_back({4, 4, -4, -4});
	space.insert(held);
	other.insert(tooMuch);
	const auto before = space.cells();
	EXPECT_THROW(space.erase(tooMuch), std::invalid_argument);
	EXPECT_TRUE(space.cells() == before);
	EXPECT_THROW(space.subtract(other), std::invalid_argument);
	EXPECT_TRUE(space.cells() == before);
	// The right number of rays, but in other directions.
	FreeSpace cross(options);
	cross.insert(Measurements{{1, 0, -1, 0}});
	EXPECT_THROW(cross.erase(Measurements{{0, 1, 0, -1}}), std::invalid_argument);
	auto far = held;
	far.push_back({0, 0, 2e6, 0});
	EXPECT_THROW(space.insert(far), std::invalid_argument);
	EXPECT_TRUE(space.cells() == before);
}

TEST(FreeSpace, RaysWithoutReturnReachTheirEnds)
{
	const Options options;
	FreeSpace space(options), measured(options);
	space.insert(std::vector<FreeRay>{{0, 0, 5, 0}});
	measured.insert(Measurements{{5 + options.freeSpaceMargin * options.sigma, 0, 0, 0}});
	EXPECT_TRUE(space.cells() == measured.cells());
	space.erase(std::vector<FreeRay>{{0, 0, 5, 0}});
	EXPECT_TRUE(space.empty());
}

TEST(FreeSpace, LargeCountsAreExactUpToTheLimit)
{
	const Options options;
	const Measurements rays{{3, 1, 0, 0}, {3, 2, 0, 0}, {3, 2, 0, 0}};
	FreeSpace once(options);
	once.insert(rays);
	FreeSpace many = once;
	const auto expect = [&](std::uint64_t factor)
	{
		const auto one = once.cells(), all = many.cells();
		ASSERT_EQ(one.size(), all.size());
		for (std::size_t i = 0; i < one.size(); i++)
		{
			const FreeCellRecord& c = one[i];
			const FreeCellRecord wanted{c.cx, c.cy, c.n * factor, c.a * std::int64_t(factor),
										c.b * std::int64_t(factor)};
			ASSERT_TRUE(all[i] == wanted) << factor;
		}
	};
	std::vector<FreeSpace> doubled;
	int doublings = 0;
	for (; doublings < 46; doublings++)
	{
		doubled.push_back(many);
		many.merge(many);
		expect(std::uint64_t(2) << doublings);
	}
	const auto before = many.cells();
	FreeSpace huge = many;
	EXPECT_THROW(
		{
			huge.merge(many);
			huge.merge(many);
		},
		std::overflow_error);
	many.insert(rays);
	expect((std::uint64_t(1) << 46) + 1);
	many.erase(rays);
	EXPECT_TRUE(many.cells() == before);
	for (; doublings > 0; doublings--) many.subtract(doubled[std::size_t(doublings - 1)]);
	EXPECT_TRUE(many.cells() == once.cells());
	many.erase(rays);
	EXPECT_TRUE(many.empty());
}

TEST(FreeSpace, NarrowCountersOverflowIntoWideOnes)
{
	const Options options;
	FreeSpace space(options);
	const Measurements block(1 << 16, Measurement{0.3, 0, 0, 0});
	FreeSpace one(options);
	one.insert(Measurements{block.front()});
	const auto unit = one.cells();
	// Sums of directions leave 2^30 after 2^23 rays.
	for (int i = 0; i < 130; i++) space.insert(block);
	const auto cells = space.cells();
	ASSERT_EQ(cells.size(), unit.size());
	for (std::size_t i = 0; i < cells.size(); i++)
	{
		EXPECT_EQ(cells[i].n, 130u << 16);
		EXPECT_EQ(cells[i].a, unit[i].a * (130 << 16));
		EXPECT_EQ(cells[i].b, unit[i].b * (130 << 16));
	}
	for (int i = 0; i < 130; i++) space.erase(block);
	EXPECT_TRUE(space.empty());
}

TEST(FreeSpace, NarrowCountersTakeInsertionsAndErasuresInTurns)
{
	const Options options;
	FreeSpace space(options), one(options);
	// The count of a cell stays small, while the sums of directions would run away if what is erased stayed in them.
	const Measurements along(5000, Measurement{0.3, 0, 0, 0}), across(5000, Measurement{0, 0.3, 0, 0});
	one.insert(Measurements{across.front()});
	const int rounds = 40;
	for (int i = 0; i < rounds; i++)
	{
		space.insert(along);
		space.insert(across);
		space.erase(along);
	}
	const auto cells = space.cells(), unit = one.cells();
	ASSERT_EQ(cells.size(), unit.size());
	for (std::size_t i = 0; i < cells.size(); i++)
	{
		const FreeCellRecord& u = unit[i];
		EXPECT_TRUE(
			(cells[i] == FreeCellRecord{u.cx, u.cy, u.n * 5000 * rounds, u.a * 5000 * rounds, u.b * 5000 * rounds}));
	}
}

TEST(FreeSpace, StoredCellsComeBackAndForgedOnesDoNot)
{
	Random random(5);
	const Options options;
	FreeSpace space(options);
	space.insert(randomMeasurements(random, 50));
	const auto cells = space.cells();
	FreeSpace loaded(options);
	loaded.insertCells(cells);
	EXPECT_TRUE(loaded.cells() == cells);
	const auto refuse = [&](const std::vector<FreeCellRecord>& forged)
	{
		FreeSpace target(options);
		EXPECT_THROW(target.insertCells(forged), std::invalid_argument);
		EXPECT_TRUE(target.empty());
	};
	refuse({{0, 0, 0, 0, 0}});
	refuse({{0, 0, 1, 140, 0}});
	refuse({{0, 0, 2, -200, 200}});
	refuse({{0, 0, maxPassesPerCell + 1, 0, 0}});
	refuse({{std::int64_t(1) << 60, 0, 1, 128, 0}});
	refuse({{1, 0, 1, 128, 0}, {0, 0, 1, 128, 0}});
	refuse({{1, 0, 1, 128, 0}, {1, 0, 1, 128, 0}});
	refuse({{0, 0, 1, std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::min()}});
	Options off;
	off.freeSpace = false;
	FreeSpace none(off);
	none.insert(randomMeasurements(random, 50));
	EXPECT_TRUE(none.empty());
	EXPECT_THROW(none.insertCells(cells), std::invalid_argument);
}

TEST(FreeSpace, PassesAreWeighedWithTheNormal)
{
	const Options options;
	Random random(6);
	for (int i = 0; i < 50; i++)
	{
		const double angle = random.uniform(0, 6.3), normal = random.uniform(0, 6.3);
		const Vec2 d{std::cos(angle), std::sin(angle)}, side{-d.y, d.x};
		// A broad beam: on average a cell of 2 sigma is crossed by all rays within its width seen from their direction.
		FreeSpace space(options);
		std::vector<FreeRay> rays;
		const double spacing = 0.002;
		for (int k = -250; k <= 250; k++)
			rays.push_back({k * spacing * side.x - 3 * d.x, k * spacing * side.y - 3 * d.y,
							k * spacing * side.x + 3 * d.x, k * spacing * side.y + 3 * d.y});
		space.insert(rays);
		const Frame frame(options.sigma);
		const Vec2 tangent = Frame::rotateToLattice({-std::sin(normal), std::cos(normal)});
		const Vec2 p = frame.toLattice({0, 0});
		const double n = space.interpolated(p)[0];
		EXPECT_GT(n, 2 * options.sigma / spacing * 0.9);
		const double c = std::cos(angle - normal);
		EXPECT_NEAR(passesAcross(space, p, tangent) / n, c * c, 0.01);
	}
}

}  // namespace ridgemap::test
