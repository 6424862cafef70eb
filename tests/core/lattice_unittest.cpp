// SPDX-License-Identifier: BSD-3-Clause
// The third promise: insert, erase, merge and subtract are exact, and what cannot be done leaves the map as it was.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <limits>
#include <stdexcept>

#include "polylines.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

Options withCell(double cell, double sigma = 0.05)
{
	Options o;
	o.cell = cell;
	o.sigma = sigma;
	return o;
}

std::vector<Measurement> cloud(std::uint64_t seed, std::size_t n, double extent)
{
	Random random(seed);
	std::vector<Measurement> result;
	for (std::size_t i = 0; i < n; i++)
	{
		const double x = random.uniform(-extent, extent), y = random.uniform(-extent, extent);
		result.push_back({x, y});
	}
	return result;
}

/** Everything by which two maps could differ, except their caches. */
void expectSameMap(const RidgeMap& a, const RidgeMap& b)
{
	EXPECT_EQ(firstDifference(a.cells(), b.cells()), "");
	EXPECT_EQ(a.statistics().measurements, b.statistics().measurements);
	EXPECT_EQ(a.statistics().cells, b.statistics().cells);
	EXPECT_EQ(firstDifference(a.ridges(), b.ridges()), "");
	EXPECT_EQ(firstDifference(a.walls(), b.walls()), "");
}

class EveryCell : public testing::TestWithParam<double>
{
};
INSTANTIATE_TEST_SUITE_P(Lattice, EveryCell, testing::Values(0.0, 0.125, 0.25, 0.5, 1.0));
}  // namespace

TEST_P(EveryCell, EraseRestoresTheIdenticalMap)
{
	const auto kept = randomScene(1, 2).measurements, extra = cloud(2, 500, 40);
	RidgeMap plain(withCell(GetParam())), changed(withCell(GetParam()));
	plain.insert(kept);
	changed.insert(extra);
	changed.insert(kept);
	changed.insert(kept);
	changed.update();
	changed.erase(extra);
	changed.erase(kept);
	expectSameMap(changed, plain);
	changed.erase(kept);
	EXPECT_TRUE(changed.empty());
	expectSameMap(changed, RidgeMap(withCell(GetParam())));
	EXPECT_EQ(changed.statistics().tiles, 0u);
}

TEST_P(EveryCell, MergeOfTwoHalvesIsTheWholeAndSubtractUndoesIt)
{
	auto all = cloud(3, 2000, 1);
	RidgeMap whole(withCell(GetParam())), left(withCell(GetParam())), right(withCell(GetParam()));
	whole.insert(all);
	left.insert({all.begin(), all.begin() + 700});
	right.insert({all.begin() + 700, all.end()});
	RidgeMap merged = right;
	merged.merge(left);
	expectSameMap(merged, whole);
	merged.subtract(right);
	expectSameMap(merged, left);
	merged.subtract(merged);
	EXPECT_TRUE(merged.empty());
	left.merge(left);
	EXPECT_EQ(left.statistics().measurements, 1400u);
}

TEST_P(EveryCell, StoredCellsRestoreTheMap)
{
	RidgeMap map(withCell(GetParam())), copy(withCell(GetParam()));
	map.insert(cloud(4, 3000, 2));
	copy.insertCells(map.cells());
	expectSameMap(copy, map);
	EXPECT_EQ(map.cells().size(), map.cellCentroids().size());
}

TEST_P(EveryCell, ErasingWhatIsNotThereChangesNothing)
{
	const auto held = cloud(5, 300, 3);
	RidgeMap map(withCell(GetParam())), same(withCell(GetParam()));
	map.insert(held);
	same.insert(held);
	const std::uint64_t version = map.version();
	EXPECT_THROW(map.erase({{50, 50}}), std::invalid_argument);
	// A batch of which only a part is there: nothing of it may be taken out.
	std::vector<Measurement> batch(held.begin(), held.begin() + 100);
	batch.push_back({-50, 20});
	EXPECT_THROW(map.erase(batch), std::invalid_argument);
	// More of one measurement than there are.
	EXPECT_THROW(map.erase({held[0], held[0], held[0], held[0], held[0], held[0], held[0]}), std::invalid_argument);
	// Another measurement in the same place as a single one.
	RidgeMap single(withCell(GetParam()));
	single.insert({{1.0, 1.0}});
	EXPECT_THROW(single.erase({{1.000001, 1.0}}), std::invalid_argument);
	RidgeMap other(withCell(GetParam()));
	other.insert({held[0], {70, 70}});
	EXPECT_THROW(map.subtract(other), std::invalid_argument);
	EXPECT_EQ(map.version(), version);
	expectSameMap(map, same);
	map.erase(held);
	EXPECT_TRUE(map.empty());
}

TEST_P(EveryCell, ErasingANeighbourOfOneOfTwoIsNoticed)
{
	// What would be left is a single measurement with sums that no single measurement has.
	Options options = withCell(GetParam(), 1);
	Random random(6);
	int unnoticed = 0;
	for (int i = 0; i < 200; i++)
	{
		RidgeMap map(options);
		const Measurement a{random.uniform(0, 0.05), random.uniform(0, 0.05)},
			b{random.uniform(0, 0.05), random.uniform(0, 0.05)};
		map.insert({a, b});
		try
		{
			map.erase({{random.uniform(0, 0.05), random.uniform(0, 0.05)}});
			unnoticed++;
		}
		catch (const std::invalid_argument&)
		{
		}
	}
	EXPECT_EQ(unnoticed, 0) << "of 200";
}

TEST(Lattice, CoordinatesThatAreNoneChangeNothing)
{
	for (const double bad : {nan, infinity, -infinity, 1e7, -1e7, 1.0000001e6, 1e300})
		for (const bool inX : {false, true})
		{
			RidgeMap map;
			map.insert({{1, 1}, {2, 2}});
			const auto before = map.cells();
			std::vector<Measurement> batch{{3, 3}, {4, 4}};
			batch.insert(batch.begin() + 1, inX ? Measurement{bad, 0} : Measurement{0, bad});
			EXPECT_THROW(map.insert(batch), std::invalid_argument) << bad;
			EXPECT_THROW(map.erase(batch), std::invalid_argument) << bad;
			EXPECT_EQ(firstDifference(map.cells(), before), "");
		}
}

TEST(Lattice, TheMessageNamesTheMeasurement)
{
	RidgeMap map;
	try
	{
		map.insert({{0, 0}, {0, 0}, {12345678, 5}});
		FAIL();
	}
	catch (const std::invalid_argument& e)
	{
		EXPECT_NE(std::string(e.what()).find("measurement 2"), std::string::npos) << e.what();
		EXPECT_NE(std::string(e.what()).find("1e+06"), std::string::npos) << e.what();
	}
}

TEST(Lattice, AnUnknownSensorIsNoError)
{
	RidgeMap map;
	map.insert({{1, 1}, {1, 1, nan, 3}, {1, 1, 5, 5}});
	EXPECT_THROW(map.erase({{1, 1, 9, 2}}), std::invalid_argument) << "this ray was never there";
	map.erase({{1, 1}, {1, 1, 5, 5}, {1, 1}});
	EXPECT_TRUE(map.empty());
}

TEST(Lattice, TheLargestCoordinatesWork)
{
	for (const double sigma : {1e-3, 0.05, 1e3})
		for (const double cell : {0.0, 0.5})
			for (const Point2 corner : {Point2{1e6, 1e6}, {-1e6, 1e6}, {1e6, -1e6}, {-1e6, -1e6}})
			{
				RidgeMap map(withCell(cell, sigma));
				std::vector<Measurement> wall;
				const double step = 0.1 * sigma * (corner.x > 0 ? -1 : 1);
				for (int i = 0; i < 200; i++) wall.push_back({corner.x + step * i, corner.y});
				map.insert(wall);
				ASSERT_EQ(map.ridges().size(), 1u) << sigma << " " << cell << " " << corner.x << " " << corner.y;
				EXPECT_NEAR(map.ridges()[0].length() / sigma, 19.9, 1);
				// A coordinate of 1e6 m is exact to 1.2e-10 m.
				for (const Point2& p : map.ridges()[0].points) EXPECT_NEAR(p.y, corner.y, 0.02 * sigma + 1e-9);
				EXPECT_NEAR(map.boundingBox().min.y, corner.y, 1e-5 * sigma + 1e-9);
				map.erase(wall);
				EXPECT_TRUE(map.empty());
			}
}

TEST(Lattice, TheMapIsTheSameAtEveryScale)
{
	std::size_t ridges = 0;
	for (const double sigma : {1e-3, 1.0, 1e3})
	{
		SceneBuilder builder(7, sigma, 0.4, 8);
		const auto measurements = builder.wall({0, 0}, {30, 10}).circle({0, 30}, 8).finish();
		RidgeMap map(withCell(0.5, sigma));
		map.insert(measurements);
		if (ridges == 0) ridges = map.ridges().size();
		EXPECT_EQ(map.ridges().size(), ridges);
		EXPECT_NEAR(totalLength(map.walls()) / sigma, 31.6 + 50.3, 4);
	}
	EXPECT_GE(ridges, 2u);
}

}  // namespace ridgemap::test
