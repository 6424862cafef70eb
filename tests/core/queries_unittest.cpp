// SPDX-License-Identifier: BSD-3-Clause
// Queries of a map object: lazily updated, from several threads, after copies and moves.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <thread>

#include "polylines.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
RidgeMap mapOf(const RandomScene& scene)
{
	RidgeMap map(scene.options());
	map.insert(scene.measurements);
	return map;
}
}  // namespace

TEST(Queries, UpdateTheMapByThemselves)
{
	const RandomScene scene = randomScene(1);
	RidgeMap updated = mapOf(scene);
	updated.update();
	EXPECT_EQ(firstDifference(mapOf(scene).ridges(), updated.ridges()), "");
	EXPECT_EQ(firstDifference(mapOf(scene).walls(), updated.walls()), "");
	const Point2 p{scene.measurements[0].x, scene.measurements[0].y};
	EXPECT_EQ(mapOf(scene).occupancy(p).value, updated.occupancy(p).value);
	EXPECT_GT(updated.occupancy(p).value, 0.9);
	EXPECT_EQ(mapOf(scene).statistics().tiles, updated.statistics().tiles);
	EXPECT_EQ(firstDifference(mapOf(scene).cells(), updated.cells()), "");
}

TEST(Queries, SeeEveryChange)
{
	RidgeMap map;
	std::uint64_t version = map.version();
	const auto changed = [&]
	{
		const bool result = map.version() != version;
		version = map.version();
		return result;
	};
	const auto a = exactWall({0, 0}, {2, 0}, 0.01), b = exactWall({0, 1}, {2, 1}, 0.01);
	map.insert(a);
	EXPECT_TRUE(changed());
	EXPECT_EQ(map.walls().size(), 1u);
	map.insert(b);
	EXPECT_TRUE(changed());
	EXPECT_EQ(map.walls().size(), 2u);
	EXPECT_EQ(map.ridges().size(), 2u);
	map.erase(a);
	EXPECT_TRUE(changed());
	EXPECT_EQ(map.walls().size(), 1u);
	EXPECT_EQ(map.occupancy({1, 0}).value, 0);
	RidgeMap other;
	other.insert(a);
	map.merge(other);
	EXPECT_TRUE(changed());
	EXPECT_EQ(map.ridges().size(), 2u);
	map.subtract(other);
	EXPECT_TRUE(changed());
	EXPECT_EQ(map.ridges().size(), 1u);
	map.insertCells(other.cells());
	EXPECT_TRUE(changed());
	EXPECT_EQ(map.ridges().size(), 2u);
	map.clear();
	EXPECT_TRUE(changed());
	EXPECT_TRUE(map.walls().empty());
	EXPECT_TRUE(map.boundingBox().empty());
	map.ridges();
	EXPECT_FALSE(changed());
}

TEST(Queries, FromSeveralThreadsAtOnce)
{
	const RandomScene scene = randomScene(2);
	const RidgeMap reference = mapOf(scene);
	const auto ridges = reference.ridges(), walls = reference.walls();
	const auto cells = reference.cells();
	for (int round = 0; round < 20; round++)
	{
		// Cells that are erased wait for the pending update, too.
		RidgeMap pending = mapOf(scene);
		std::vector<Measurement> extra;
		for (const Measurement& m : scene.measurements) extra.push_back({m.x + 3 * scene.sigma, m.y});
		pending.insert(extra);
		if (round % 2 == 0) pending.update();
		pending.erase(extra);
		const RidgeMap& map = pending;
		std::vector<std::string> differences(4);
		std::vector<std::thread> threads;
		for (std::size_t t = 0; t < differences.size(); t++)
			threads.emplace_back(
				[&, t]
				{
					std::string& found = differences[t];
					if (t % 2 == 0) found += firstDifference(map.cells(), cells);
					found += firstDifference(map.ridges(), ridges);
					found += firstDifference(map.walls(), walls);
					found += firstDifference(map.cells(), cells);
					if (map.cellCentroids().size() != cells.size()) found += "centroids ";
					if (map.statistics().measurements != scene.measurements.size()) found += "statistics ";
					if (map.boundingBox().min != reference.boundingBox().min) found += "box ";
					const Point2 p{scene.measurements[t].x, scene.measurements[t].y};
					if (map.occupancy(p).value < 0.9) found += "occupancy ";
					if (RidgeMap(map).ridges().size() != ridges.size()) found += "copy ";
					RidgeMap sum(map.options());
					sum.merge(map);
					if (sum.cells().size() != cells.size()) found += "merge ";
				});
		for (std::thread& t : threads) t.join();
		for (const std::string& d : differences) ASSERT_EQ(d, "") << "round " << round;
	}
}

TEST(Copies, AreIndependent)
{
	const RandomScene scene = randomScene(3);
	for (const bool updateFirst : {false, true})
	{
		RidgeMap original = mapOf(scene);
		if (updateFirst) original.walls();
		RidgeMap copy = original;
		EXPECT_EQ(firstDifference(copy.cells(), original.cells()), "");
		EXPECT_EQ(firstDifference(copy.ridges(), original.ridges()), "");
		EXPECT_EQ(firstDifference(copy.walls(), original.walls()), "");
		const auto before = original.ridges();
		copy.erase({scene.measurements.begin(), scene.measurements.begin() + 200});
		EXPECT_NE(firstDifference(copy.ridges(), before), "");
		EXPECT_EQ(firstDifference(original.ridges(), before), "");
		RidgeMap assigned;
		assigned.insert({{1, 1}});
		assigned = original;
		EXPECT_TRUE(assigned.options() == original.options());
		EXPECT_EQ(firstDifference(assigned.ridges(), before), "");
		RidgeMap& alias = assigned;
		assigned = alias;
		EXPECT_EQ(firstDifference(assigned.ridges(), before), "");
	}
}

TEST(Copies, KeepNamesOfPolylines)
{
	RidgeMap map;
	map.insert(exactWall({0, 0}, {2, 0}, 0.01));
	const PolylineId id = map.update().appeared.at(0);
	const RidgeMap copy = map;
	EXPECT_EQ(firstDifference({copy.ridge(id)}, {map.ridge(id)}), "");
}

TEST(Moves, CarryEverythingAlong)
{
	const RandomScene scene = randomScene(4);
	RidgeMap original = mapOf(scene);
	const auto before = original.ridges();
	RidgeMap moved = std::move(original);
	EXPECT_EQ(firstDifference(moved.ridges(), before), "");
	RidgeMap target;
	target = std::move(moved);
	EXPECT_EQ(firstDifference(target.ridges(), before), "");
	original = target;
	EXPECT_EQ(firstDifference(original.ridges(), before), "");
	std::vector<RidgeMap> many;
	for (int i = 0; i < 5; i++) many.push_back(target);
	EXPECT_EQ(firstDifference(many[2].walls(), target.walls()), "");
}

}  // namespace ridgemap::test
