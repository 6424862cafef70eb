// SPDX-License-Identifier: BSD-3-Clause
// What an update may cost and what a map may hold, by counts: times differ from machine to machine.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <iostream>

#include "random.h"

namespace ridgemap::test
{
namespace
{
std::vector<Measurement> filledSquare(Random& random, double edge, std::size_t count)
{
	std::vector<Measurement> result(count);
	for (Measurement& m : result)
	{
		m.x = random.uniform(0, edge);
		m.y = random.uniform(0, edge);
	}
	return result;
}

std::vector<Measurement> wall(Random& random, double length, std::size_t count, double noise = 0.02)
{
	std::vector<Measurement> result(count);
	for (Measurement& m : result)
	{
		m.x = random.uniform(0, length);
		m.y = noise * random.normal();
	}
	return result;
}
}  // namespace

TEST(Bounds, UpdateOfARegionThatIsFullEverywhere)
{
	const Options options;
	const double edge = 2, tile = options.tileEdge * options.sigma;
	// All cells of the lattice within the square may change, each with one kernel before and one after.
	const double cells = (edge / (options.cell * options.sigma) + 2) * (edge / (options.cell * options.sigma) + 2);
	const double tiles = (edge / tile + 4) * (edge / tile + 4);
	for (const std::size_t count : {1000u, 10000u, 100000u, 500000u})
	{
		Random random(1);
		RidgeMap map;
		map.insert(filledSquare(random, edge, count));
		map.update();
		map.insert(filledSquare(random, edge, count));
		const UpdateResult r = map.update();
		std::cout << count << " measurements in 4 m^2: " << r.tiles << " tiles, " << r.evaluations << " evaluations, "
				  << r.kernels << " kernels, " << r.seeds << " seeds, " << r.traces << " traces\n";
		EXPECT_LE(double(r.tiles), tiles);
		EXPECT_LE(double(r.kernels), 2 * cells);
		EXPECT_LE(double(r.evaluations) / double(r.tiles), 5000);
	}
}

TEST(Bounds, TheMapElsewhereDoesNotMatter)
{
	Random random(2);
	const auto known = wall(random, 5, 5000), scan = wall(random, 5, 400);
	auto elsewhere = wall(random, 500, 200000);
	for (Measurement& m : elsewhere) m.y += 20;
	const auto updateOf = [&](bool large)
	{
		RidgeMap map;
		map.insert(known);
		if (large) map.insert(elsewhere);
		map.update();
		map.insert(scan);
		return map.update();
	};
	const UpdateResult a = updateOf(false), b = updateOf(true);
	EXPECT_GT(a.evaluations, 0u);
	EXPECT_EQ(a.evaluations, b.evaluations);
	EXPECT_EQ(a.kernels, b.kernels);
	EXPECT_EQ(a.seeds, b.seeds);
	EXPECT_EQ(a.tiles, b.tiles);
}

TEST(Bounds, APlaceThatWasSeenALongTimeCostsWhatItsCellsCost)
{
	std::size_t evaluations[4], i = 0;
	for (const std::size_t count : {10000u, 100000u, 1000000u, 4000000u})
	{
		Random random(3);
		RidgeMap map;
		map.insert(wall(random, 5, count));
		map.update();
		const auto scan = wall(random, 5, 400);
		map.insert(scan);
		const UpdateResult r = map.update();
		std::cout << count << " measurements of 5 m: " << r.evaluations << " evaluations, " << r.kernels << " kernels, "
				  << r.seeds << " seeds\n";
		EXPECT_LE(r.kernels, 2 * scan.size());
		evaluations[i++] = r.evaluations;
	}
	// More cells beside the wall are occupied, until all are; then nothing grows any more.
	EXPECT_LE(double(evaluations[2]), 3.0 * double(evaluations[0]));
	EXPECT_LE(double(evaluations[3]), 1.2 * double(evaluations[2]));
}

TEST(Bounds, MeasurementsBesideAKnownRidgeStartNoSearches)
{
	Random random(4);
	RidgeMap map;
	map.insert(wall(random, 5, 100000, 0.01));  // all of them within one sigma
	const UpdateResult r = map.update();
	std::cout << "a wall of 5 m: " << r.tiles << " tiles, " << r.traces << " traces, " << r.seeds << " seeds\n";
	ASSERT_EQ(map.ridges().size(), 1u);
	EXPECT_LE(r.seeds, r.traces + 4);  // one finds a ridge, a few lie off its ends
}

TEST(Bounds, MemoryPerMetreOfWall)
{
	for (const std::size_t count : {20000u, 200000u, 2000000u})
	{
		Random random(4);
		const double length = 20;
		RidgeMap map;
		map.insert(wall(random, length, count));
		map.update();
		const double perMetre = double(map.statistics().bytes) / length;
		std::cout << count << " measurements of " << length << " m: " << perMetre / 1024 << " KiB per metre\n";
		EXPECT_LE(perMetre, 200 * 1024);
	}
}

}  // namespace ridgemap::test
