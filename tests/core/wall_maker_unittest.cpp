// SPDX-License-Identifier: BSD-3-Clause
// Walls that follow a changing map are the walls made from scratch, to the bit, and only what changed is made anew.
// RIDGEMAP_SCENES=N checks N random scenes instead of a few.
#include <gtest/gtest.h>

#include "free_space.h"
#include "polylines.h"
#include "scenes.h"
#include "wall_maker.h"
#include "walls.h"

namespace ridgemap::test
{
namespace
{
/** A batch as a sensor makes it: what lies within a circle, or a few measurements from anywhere. */
std::vector<Measurement> batch(const std::vector<Measurement>& all, double sigma, Random& random)
{
	std::vector<Measurement> result;
	const Measurement centre = all[random.below(all.size())];
	const double range = sigma * random.uniform(3, 40), share = random.uniform(0.1, 1);
	const bool anywhere = random.chance(0.2);
	for (const Measurement& m : all)
		if (anywhere ? random.chance(0.01) : std::hypot(m.x - centre.x, m.y - centre.y) < range && random.chance(share))
			result.push_back(m);
	return result;
}

std::string difference(const RidgeMap& map)
{
	FreeSpace space(map.options());
	space.insertCells(map.freeCells());
	return firstDifference(map.walls(), makeWalls(map.ridges(), space, map.options()));
}
}  // namespace

TEST(WallMaker, FollowsEveryHistoryToTheBit)
{
	const int scenes = fromEnvironment("RIDGEMAP_SCENES", 12);
	std::size_t walls = 0;
	for (int seed = 1; seed <= scenes; seed++)
	{
		RandomScene scene = randomScene(std::uint64_t(seed), 6);
		Random random(std::uint64_t(seed) + 1000);
		// Every other scene was seen by sensors, whose rays pass through what others saw.
		for (Measurement& m : scene.measurements)
			if (seed % 2 == 1)
			{
				m.sensorX = m.x + scene.sigma * random.uniform(-40, 40);
				m.sensorY = m.y + scene.sigma * random.uniform(-40, 40);
			}
		RidgeMap map(scene.options());
		std::vector<std::vector<Measurement>> inserted;
		for (int step = 0; step < 25; step++)
		{
			if (!inserted.empty() && random.chance(0.3))
			{
				const std::size_t i = random.below(inserted.size());
				map.erase(inserted[i]);
				inserted.erase(inserted.begin() + std::ptrdiff_t(i));
			}
			else
			{
				inserted.push_back(batch(scene.measurements, scene.sigma, random));
				map.insert(inserted.back());
			}
			ASSERT_EQ(difference(map), "") << "seed " << seed << " step " << step << ": " << scene.what;
			walls += map.walls().size();
		}
		// A copy follows on its own.
		RidgeMap copy = map;
		copy.insert(batch(scene.measurements, scene.sigma, random));
		ASSERT_EQ(difference(copy), "") << "seed " << seed;
		ASSERT_EQ(difference(map), "") << "seed " << seed;
		map.clear();
		map.insert(scene.measurements);
		ASSERT_EQ(difference(map), "") << "seed " << seed;
	}
	EXPECT_GT(walls, std::size_t(scenes) * 25);
}

TEST(WallMaker, AStraightWallEndsOnAnotherWithoutABend)
{
	// A line fitted to a wall is another one than the ridge to which an end was led: that end then goes on, or back,
	// along its own line, until it is on the wall.
	int ends = 0, straight = 0;
	for (std::uint64_t seed = 1; seed <= 12; seed++)
	{
		SceneBuilder scene(seed, 1, 0.35, 8);
		scene.wall({0, 0}, {70, 0}).wall({35, 0}, {35, 40});
		Options o;
		o.sigma = 1;
		RidgeMap map(o);
		map.insert(scene.finish({}, 0.3 * double(seed)));
		for (const Polyline& stem : map.walls())
			for (const bool back : {false, true})
			{
				const auto vertex = [&](std::size_t k)
				{
					const Point2& p = stem.points[back ? stem.points.size() - 1 - k : k];
					return Vec2{p.x, p.y};
				};
				double gap = 1;
				for (const Polyline& bar : map.walls())
					for (std::size_t k = 1; &bar != &stem && k < bar.points.size(); k++)
						gap = std::min(gap, footOnSegment({bar.points[k - 1].x, bar.points[k - 1].y},
														  {bar.points[k].x, bar.points[k].y}, vertex(0))
												.distance);
				if (gap == 1) continue;  // a free end
				EXPECT_LT(gap, 1e-9) << "seed " << seed;
				ends++;
				straight += norm(vertex(1) - vertex(0)) > 5;  // no vertex only to close a gap
			}
	}
	std::cout << straight << " of " << ends << " ends have no vertex only to close a gap\n";
	EXPECT_GE(ends, 12);
	EXPECT_GE(straight, 7);
}

TEST(WallMaker, TouchesOnlyWhatChanged)
{
	// A street of 30 rooms, each a ring of its own; one of them is measured again.
	SceneBuilder scene(5, 1, 0.3, 30);
	for (int i = 0; i < 30; i++)
	{
		const double x = 60 * i;
		scene.wall({x, 0}, {x + 40, 0})
			.wall({x + 40, 0}, {x + 40, 30})
			.wall({x + 40, 30}, {x, 30})
			.wall({x, 30}, {x, 0});
	}
	Options o;
	o.sigma = 1;
	RidgeMap map(o);
	map.insert(scene.finish());
	Lines lines;
	for (const Polyline& r : map.ridges()) lines.push_back(std::make_shared<const Polyline>(r));
	ASSERT_GE(lines.size(), 30u);
	WallMaker maker(o);
	const FreeSpace space(o);
	const std::vector<Polyline> first = maker.make(lines, space);
	const std::size_t before = maker.computed();
	EXPECT_GE(before, 60u);
	EXPECT_EQ(firstDifference(maker.make(lines, space), first), "");
	EXPECT_EQ(maker.computed(), before) << "nothing has changed";
	lines[7] = std::make_shared<const Polyline>(*lines[7]);
	EXPECT_EQ(firstDifference(maker.make(lines, space), first), "");
	EXPECT_LE(maker.computed() - before, 3u) << "one line has changed";
	EXPECT_GE(maker.computed() - before, 2u);
}

}  // namespace ridgemap::test
