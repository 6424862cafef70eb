// SPDX-License-Identifier: BSD-3-Clause
// grid-ghosts MAP.simplemap TRUTH.csv: builds MRPT's occupancy grid of 5 cm, with its own defaults, and prints how much
// of it is occupied (probability above 0.65) farther than 0.1 m from any true surface: the number of such cells times
// 5 cm, within the box around the truth and in all [m].
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdio>

#include "../../apps/common/scene.h"
#include "../../apps/common/user_error.h"

namespace ridgemap::apps
{
namespace
{
constexpr double resolution = 0.05, reach = 0.1;  // [m]
constexpr float leastFree = 0.35f;

double distanceTo(const std::vector<Segment>& truth, const Point2& p)
{
	double best = 1e9;
	for (const Segment& s : truth) best = std::min(best, s.distance(p));
	return best;
}

int run(int argc, char** argv)
{
	if (argc != 3) throw UserError("expected two files", "give a simplemap and a truth");
	mrpt::io::CFileGZInputStream in;
	if (!in.open(argv[1])) throw UserError(std::string("cannot open ") + argv[1], "name a simplemap");
	mrpt::maps::CSimpleMap frames;
	mrpt::serialization::archiveFrom(in) >> frames;
	const std::vector<Segment> truth = readTruth(argv[2]);
	Box2 box;
	for (const Segment& s : truth)
	{
		box.extend(s.a);
		box.extend(s.b);
	}
	mrpt::maps::COccupancyGridMap2D grid(float(box.min.x) - 1, float(box.max.x) + 1, float(box.min.y) - 1,
										 float(box.max.y) + 1, float(resolution));
	grid.loadFromSimpleMap(frames);
	std::size_t inside = 0, all = 0;
	for (unsigned cy = 0; cy < grid.getSizeY(); cy++)
		for (unsigned cx = 0; cx < grid.getSizeX(); cx++)
		{
			if (grid.getCell(int(cx), int(cy)) >= leastFree) continue;
			const Point2 p{grid.idx2x(cx), grid.idx2y(cy)};
			if (distanceTo(truth, p) <= reach) continue;
			all++;
			if (p.x > box.min.x && p.x < box.max.x && p.y > box.min.y && p.y < box.max.y) inside++;
		}
	std::printf("%.2f %.2f\n", double(inside) * resolution, double(all) * resolution);
	return 0;
}
}  // namespace
}  // namespace ridgemap::apps

int main(int argc, char** argv)
{
	return ridgemap::apps::runProgram("grid-ghosts", ridgemap::apps::run, argc, argv);
}
