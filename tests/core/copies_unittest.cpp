// SPDX-License-Identifier: BSD-3-Clause
// Copies of a map share what neither has changed: that must not show but in the memory they take.
#include <gtest/gtest.h>
#include <malloc.h>
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <thread>

#include "polylines.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
/** A map, and the measurements that it must hold. */
struct Particle
{
	RidgeMap map;
	std::vector<Measurement> held;
};

/** The measurements of a scene, every other one with a place that it was seen from. */
std::vector<Measurement> seen(const RandomScene& scene)
{
	std::vector<Measurement> all = scene.measurements;
	for (std::size_t i = 0; i < all.size(); i += 2)
	{
		all[i].sensorX = all[i].x + 20 * scene.sigma;
		all[i].sensorY = all[i].y + (i % 4 ? 15 : -15) * scene.sigma;
	}
	return all;
}

/** Inserts or erases some measurements, and looks at the map or not. */
void change(Particle& p, const std::vector<Measurement>& source, Random& random)
{
	if (p.held.size() > 60 && random.below(3) == 0)
	{
		const std::size_t first = random.below(p.held.size() - 50);
		const std::vector<Measurement> out(p.held.begin() + std::ptrdiff_t(first),
										   p.held.begin() + std::ptrdiff_t(first) + 50);
		p.map.erase(out);
		p.held.erase(p.held.begin() + std::ptrdiff_t(first), p.held.begin() + std::ptrdiff_t(first) + 50);
	}
	else
	{
		const std::size_t first = random.below(source.size() - 50);
		const std::vector<Measurement> in(source.begin() + std::ptrdiff_t(first),
										  source.begin() + std::ptrdiff_t(first) + 50);
		p.map.insert(in);
		p.held.insert(p.held.end(), in.begin(), in.end());
	}
	switch (random.below(4))
	{
		case 0:
			p.map.update();
			break;
		case 1:
			p.map.walls();
			break;
		case 2:
			p.map.occupancy({p.held.front().x, p.held.front().y});
			break;
		default:
			break;
	}
}

std::string differenceFromScratch(const Particle& p)
{
	RidgeMap scratch(p.map.options());
	scratch.insert(p.held);
	if (const std::string d = firstDifference(p.map.cells(), scratch.cells()); !d.empty()) return "cells: " + d;
	if (p.map.freeCells() != scratch.freeCells()) return "free cells";
	if (const std::string d = firstDifference(p.map.ridges(), scratch.ridges()); !d.empty()) return "ridges: " + d;
	if (const std::string d = firstDifference(p.map.walls(), scratch.walls()); !d.empty()) return "walls: " + d;
	for (const Measurement& m : {p.held.front(), p.held.back()})
		if (p.map.occupancy({m.x, m.y}).value != scratch.occupancy({m.x, m.y}).value) return "occupancy";
	return "";
}

/** Copies and changes maps as a particle filter does, so that any two of them share something. */
std::vector<Particle> evolve(std::uint64_t seed, int steps)
{
	const RandomScene scene = randomScene(seed);
	const std::vector<Measurement> source = seen(scene);
	Options options = scene.options();
	if (seed % 4 == 3) options.cell = 0;
	Random random(seed);
	std::vector<Particle> particles(1, {RidgeMap(options), source});
	particles[0].map.insert(source);
	for (int i = 0; i < steps; i++)
	{
		if (particles.size() < 4)
			particles.push_back(particles[random.below(particles.size())]);
		else
			particles[random.below(4)] = particles[random.below(4)];
		change(particles[random.below(particles.size())], source, random);
	}
	return particles;
}
}  // namespace

TEST(Copies, AreTheMapsOfTheirMeasurements)
{
	const int scenes = fromEnvironment("RIDGEMAP_SCENES", 8);
	for (std::uint64_t seed = 1; seed <= std::uint64_t(scenes); seed++)
		for (const Particle& p : evolve(seed, 24)) ASSERT_EQ(differenceFromScratch(p), "") << "seed " << seed;
}

TEST(Copies, ChangeInSeveralThreadsAtOnce)
{
	const RandomScene scene = randomScene(5);
	const std::vector<Measurement> source = seen(scene);
	RidgeMap parent(scene.options());
	parent.insert(source);
	std::vector<Particle> particles(4, {parent, source});
	parent = RidgeMap(scene.options());  // the last holder lets go while the others change
	std::vector<std::thread> threads;
	for (std::size_t t = 0; t < particles.size(); t++)
		threads.emplace_back(
			[&, t]
			{
				Random random(t);
				for (int i = 0; i < 8; i++) change(particles[t], source, random);
			});
	for (std::thread& t : threads) t.join();
	for (const Particle& p : particles) EXPECT_EQ(differenceFromScratch(p), "");
}

TEST(Copies, TakeTheMemoryOfTheirChanges)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
	GTEST_SKIP() << "the sanitizers bring allocators of their own";
#endif
	const auto held = []
	{
		const auto info = mallinfo2();
		return info.uordblks + info.hblkhd;
	};
	const std::size_t before = held();
	RidgeMap map;
	for (int wall = 0; wall < 20; wall++) map.insert(exactWall({0, double(wall)}, {20, double(wall)}, 0.01));
	map.update();
	const std::size_t ofMap = held() - before;
	RidgeMap copy = map;
	copy.insert(exactWall({3, 3.5}, {4, 3.5}, 0.01));
	copy.update();
	const std::size_t ofCopy = held() - before - ofMap;
	EXPECT_LT(ofCopy, ofMap / 8);
	EXPECT_GT(map.statistics().bytes, ofMap / 2);
}

}  // namespace ridgemap::test
