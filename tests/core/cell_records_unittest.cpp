// SPDX-License-Identifier: BSD-3-Clause
// Cells of the lattice: which cell a measurement falls into, how many it takes, and what stored cells are believed.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "lattice.h"
#include "polylines.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
/** Map-frame place of a point of the lattice frame [sigma]. */
Measurement at(const Options& o, Vec2 q)
{
	const Point2 p = Frame(o.sigma).toMap(q);
	return {p.x, p.y};
}
}  // namespace

TEST(CellIndex, DivisionRoundsTowardsMinusInfinity)
{
	for (std::int64_t a = -20; a <= 20; a++)
		for (std::int64_t b = 1; b <= 7; b++)
			EXPECT_EQ(floorDiv(a, b), std::int64_t(std::floor(double(a) / double(b))));
}

TEST(CellIndex, CellsOfNegativeCoordinatesAreFoundByFloor)
{
	const Options o;
	for (const Vec2 q :
		 {Vec2{0.1, 0.1}, {-0.1, 0.1}, {0.1, -0.1}, {-0.1, -0.1}, {-0.6, -15.9}, {-16.1, -16.1}, {-1000.3, 7.2}})
	{
		RidgeMap map(o);
		map.insert({at(o, q)});
		ASSERT_EQ(map.cells().size(), 1u);
		const CellRecord c = map.cells()[0];
		EXPECT_EQ(c.cx, std::int64_t(std::floor(q.x / o.cell)));
		EXPECT_EQ(c.cy, std::int64_t(std::floor(q.y / o.cell)));
		EXPECT_EQ(c.n, 1u);
		EXPECT_NEAR((double(c.cx) + 0.5) * o.cell + double(c.sx) * 0x1p-20, q.x, 1e-6);
		EXPECT_NEAR((double(c.cy) + 0.5) * o.cell + double(c.sy) * 0x1p-20, q.y, 1e-6);
		const Point2 centroid = map.cellCentroids()[0];
		EXPECT_NEAR(centroid.x, at(o, q).x, 1e-6 * o.sigma);
		EXPECT_NEAR(centroid.y, at(o, q).y, 1e-6 * o.sigma);
	}
}

TEST(CellIndex, NeighboursAcrossTheOriginAreApart)
{
	const Options o;
	RidgeMap map(o);
	map.insert({at(o, {-0.01, -0.01}), at(o, {0.01, -0.01}), at(o, {-0.01, 0.01}), at(o, {0.01, 0.01})});
	EXPECT_EQ(map.cells().size(), 4u);
}

TEST(CellSums, AreThoseOfTheMeasurements)
{
	Options o;
	o.cell = 0.5;
	RidgeMap map(o);
	const std::vector<Vec2> places{{0.1, 0.2}, {0.3, 0.05}, {0.45, 0.49}};
	double sx = 0, sxy = 0, syy = 0;
	for (const Vec2& q : places)
	{
		map.insert({at(o, q)});
		sx += q.x - 0.25;
		sxy += (q.x - 0.25) * (q.y - 0.25);
		syy += (q.y - 0.25) * (q.y - 0.25);
	}
	ASSERT_EQ(map.cells().size(), 1u);
	const CellRecord c = map.cells()[0];
	EXPECT_EQ(c.n, 3u);
	EXPECT_NEAR(double(c.sx) * 0x1p-20, sx, 3e-6);
	EXPECT_NEAR(double(c.sxy) * 0x1p-32, sxy, 3e-5);
	EXPECT_NEAR(double(c.syy) * 0x1p-32, syy, 3e-5);
}

TEST(CellCount, IsLimitedAndTheLimitIsNoOverflow)
{
	for (const double cell : {0.0, 0.5, 1.0})
	{
		Options o;
		o.cell = cell;
		RidgeMap map(o);
		// The corner of a cell has the largest sums.
		map.insert({at(o, {0.0001, 0.0001}), at(o, {30, 30})});
		auto records = map.cells();
		ASSERT_EQ(records.size(), 2u);
		CellRecord half = records[0].cx < records[1].cx ? records[0] : records[1];
		const std::int64_t n = std::int64_t(1) << 30;
		half.n = std::uint32_t(n);
		for (std::int64_t CellRecord::*sum :
			 {&CellRecord::sx, &CellRecord::sy, &CellRecord::sxx, &CellRecord::sxy, &CellRecord::syy})
			half.*sum *= n;

		RidgeMap full(o);
		full.insertCells({half});
		full.insertCells({half});
		EXPECT_EQ(full.statistics().measurements, maxCountPerCell);
		const auto before = full.cells();
		EXPECT_THROW(full.insert({at(o, {20, 20}), at(o, {0.0001, 0.0001})}), std::overflow_error);
		EXPECT_THROW(full.insertCells({half}), std::overflow_error);
		EXPECT_THROW(full.merge(full), std::overflow_error);
		EXPECT_THROW(RidgeMap(o).insertCells({half, half, half, half, half}), std::overflow_error);
		EXPECT_EQ(firstDifference(full.cells(), before), "");
		const OccupancySample s = full.occupancy({at(o, {0.0001, 0.0001}).x, at(o, {0.0001, 0.0001}).y});
		EXPECT_NEAR(s.value, double(maxCountPerCell), 1e-5 * double(maxCountPerCell));
		full.erase({at(o, {0.0001, 0.0001})});
		full.insert({at(o, {0.0001, 0.0001})});
		EXPECT_EQ(firstDifference(full.cells(), before), "");
	}
}

TEST(CellRecords, ForgedOnesAreTurnedDown)
{
	Options o;
	o.cell = 0.5;
	RidgeMap map(o);
	map.insert({at(o, {0.1, 0.1}), at(o, {0.3, 0.4}), at(o, {0.2, 0.45})});
	const CellRecord good = map.cells().at(0);
	const std::int64_t big = std::int64_t(1) << 40;
	const std::vector<std::pair<const char*, std::function<void(CellRecord&)>>> forgeries{
		{"no measurement", [](CellRecord& c) { c.n = 0; }},
		{"count above the limit", [](CellRecord& c) { c.n = 0x80000001u; }},
		{"a direction that is none", [](CellRecord& c) { c.bin = 9; }},
		{"column beyond the largest coordinate", [](CellRecord& c) { c.cx = std::int64_t(1) << 32; }},
		{"lowest column", [](CellRecord& c) { c.cx = std::numeric_limits<std::int64_t>::min(); }},
		{"row beyond the largest coordinate", [](CellRecord& c) { c.cy = -(std::int64_t(1) << 32); }},
		{"highest row", [](CellRecord& c) { c.cy = std::numeric_limits<std::int64_t>::max(); }},
		{"mean outside the cell", [&](CellRecord& c) { c.sx = big; }},
		{"mean far outside the cell", [](CellRecord& c) { c.sy = std::numeric_limits<std::int64_t>::min(); }},
		{"negative square", [](CellRecord& c) { c.sxx = -1; }},
		{"square too large", [&](CellRecord& c) { c.syy = big; }},
		{"largest square", [](CellRecord& c) { c.syy = std::numeric_limits<std::int64_t>::max(); }},
		{"mixed product too large", [](CellRecord& c) { c.sxy = c.sxx + c.syy; }},
		{"lowest mixed product", [](CellRecord& c) { c.sxy = std::numeric_limits<std::int64_t>::min(); }},
		{"squares too small for the mean", [](CellRecord& c) { c.sxx = 0, c.sxy = 0, c.sx = 500000; }},
	};
	for (const auto& [what, forge] : forgeries)
	{
		RidgeMap target(o);
		target.insert({at(o, {5, 5})});
		const auto before = target.cells();
		CellRecord forged = good;
		forge(forged);
		EXPECT_THROW(target.insertCells({good, forged}), std::invalid_argument) << what;
		EXPECT_EQ(firstDifference(target.cells(), before), "") << what;
	}
	RidgeMap target(o);
	EXPECT_NO_THROW(target.insertCells({good}));
}

TEST(CellRecords, UncompactedCellsHaveNoExtent)
{
	Options o;
	o.cell = 0;
	RidgeMap map(o);
	map.insert({at(o, {0.1, 0.1})});
	CellRecord c = map.cells().at(0);
	EXPECT_EQ(c.sx, 0);
	EXPECT_EQ(c.sxx, 0);
	c.sx = 1;
	EXPECT_THROW(map.insertCells({c}), std::invalid_argument);
	c.sx = 0;
	c.sxx = 1;
	EXPECT_THROW(map.insertCells({c}), std::invalid_argument);
}

TEST(CellRecords, OfOneMeasurementFitTogether)
{
	const Options o;
	RidgeMap map(o);
	map.insert({at(o, {0.1, 0.1})});
	for (std::int64_t CellRecord::*sum : {&CellRecord::sxx, &CellRecord::sxy, &CellRecord::syy})
	{
		CellRecord c = map.cells().at(0);
		c.*sum += c.*sum / 100;
		EXPECT_THROW(RidgeMap(o).insertCells({c}), std::invalid_argument);
	}
}

}  // namespace ridgemap::test
