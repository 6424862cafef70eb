// SPDX-License-Identifier: BSD-3-Clause
// Prints hashes of the ridges, walls and free space of a generated map. The numbers that go in are the same on every
// machine (no function of the mathematical library makes them), so that the numbers that come out can be compared.
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "../core/support/random.h"

namespace
{
using namespace ridgemap;

/** FNV-1a over the bits of numbers. */
class Hash
{
 public:
	void add(double value)
	{
		std::uint64_t bits;
		static_assert(sizeof bits == sizeof value);
		std::memcpy(&bits, &value, sizeof bits);
		value_ = (value_ ^ bits) * 0x100000001b3u;
	}
	void add(const std::vector<Polyline>& lines)
	{
		for (const Polyline& line : lines)
		{
			add(double(line.points.size()));
			for (const Point2& p : line.points)
			{
				add(p.x);
				add(p.y);
			}
			for (const VertexInfo& v : line.info)
			{
				add(double(v.occupancy));
				add(double(v.standardError));
			}
		}
	}
	std::uint64_t value() const { return value_; }

 private:
	std::uint64_t value_ = 0xcbf29ce484222325u;
};

/** Nearly normal, with mean 0 and standard deviation 1. */
double noise(test::Random& random)
{
	double sum = -6;
	for (int i = 0; i < 12; i++) sum += random.uniform();
	return sum;
}

/** A scan of slanted walls, both faces of a thin one and a few stray points, from a sensor that moves along a hallway.
 */
std::vector<Measurement> scanFrom(test::Random& random, double sensorX)
{
	struct Wall
	{
		Point2 from, to;
	};
	const Wall walls[] = {{{0, 0}, {12, 1.5}},    {{12, 1.5}, {11, 6}}, {{11, 6}, {-0.5, 5}},
						  {{4, 2.5}, {4.1, 4.5}}, {{-0.5, 5}, {0, 0}},  {{7, 3}, {8, 3.6}}};
	std::vector<Measurement> scan;
	const double sensorY = 1.5 + 0.1 * sensorX;
	for (const Wall& w : walls)
		for (int i = 0; i < 60; i++)
		{
			const double t = random.uniform();
			scan.push_back({w.from.x + t * (w.to.x - w.from.x) + 0.015 * noise(random),
							w.from.y + t * (w.to.y - w.from.y) + 0.015 * noise(random), sensorX, sensorY});
		}
	for (int i = 0; i < 5; i++) scan.push_back({random.uniform(0.5, 11), random.uniform(1.5, 4.5), sensorX, sensorY});
	return scan;
}
}  // namespace

int main()
{
	for (const bool sides : {false, true})
	{
		test::Random random(7);
		Options options;
		options.sides = sides;
		RidgeMap map(options);
		for (int i = 0; i < 60; i++)
		{
			map.insert(scanFrom(random, 1 + 0.15 * i));
			if (i % 7 == 0) map.update(2);
		}
		Hash ridges, walls, free;
		ridges.add(map.ridges());
		walls.add(map.walls());
		for (double y = 0; y < 6; y += 0.125)
			for (double x = 0; x < 12; x += 0.125)
			{
				free.add(map.passes({x, y}));
				free.add(map.occupancy({x, y}).value);
			}
		std::printf("sides %-3s ridges %4zu %016llx  walls %4zu %016llx  space %016llx\n", sides ? "on" : "off",
					map.ridges().size(), (unsigned long long)ridges.value(), map.walls().size(),
					(unsigned long long)walls.value(), (unsigned long long)free.value());
	}
}
