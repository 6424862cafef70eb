// SPDX-License-Identifier: BSD-3-Clause
// free-space-judge ghosts LOG.simplemap TRUTH.csv: builds MRPT's occupancy grid of 5 cm with its own defaults and
// prints how much of it is occupied (probability above 0.65) farther than 0.1 m from any true surface: the number of
// such cells times 5 cm, within the box around the truth and in all [m].
//
// free-space-judge change LOG.simplemap BEFORE.csv AFTER.csv REMOVED.csv: what free space did to walls, from files of
// ridgemap-build: walls before and after [m], removed [m], of that with a wall within 0.25 m that stays [m], walls
// before without one within 0.25 m after [m], and the share of the walls before and after that lies within 0.1 m of an
// occupied cell of that grid [%].
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/serialization/CArchive.h>
#include <ridgemap/polyline_index.h>

#include <cstdio>

#include "../../apps/common/gz_input.h"
#include "../../apps/common/scene.h"
#include "../../apps/common/user_error.h"

namespace ridgemap::apps
{
namespace
{
using mrpt::maps::COccupancyGridMap2D;
constexpr double resolution = 0.05, reach = 0.1, beside = 0.25;  // [m]
constexpr float leastFree = 0.35f;

void build(COccupancyGridMap2D& grid, const std::string& path)
{
	mrpt::io::CFileGZInputStream in;
	if (!in.open(path)) throw UserError("cannot open " + path, "name a simplemap");
	mrpt::maps::CSimpleMap frames;
	mrpt::serialization::archiveFrom(in) >> frames;
	grid.loadFromSimpleMap(frames);
}

std::vector<Point2> occupiedCells(const COccupancyGridMap2D& grid)
{
	std::vector<Point2> cells;
	for (unsigned cy = 0; cy < grid.getSizeY(); cy++)
		for (unsigned cx = 0; cx < grid.getSizeX(); cx++)
			if (grid.getCell(int(cx), int(cy)) < leastFree) cells.push_back({grid.idx2x(cx), grid.idx2y(cy)});
	return cells;
}

Polyline lineOf(const Segment& s)
{
	Polyline line;
	line.points = {s.a, s.b};
	return line;
}

/** The polylines of a file `polyline,x,y`, segment by segment. */
std::vector<Polyline> readLines(const std::string& path)
{
	GzInput in(path);
	std::vector<Polyline> segments;
	std::string text;
	Point2 last;
	int number = 0, before = -1;
	for (Point2 p; in.readLine(text);)
	{
		if (std::sscanf(text.c_str(), "%d,%lf,%lf", &number, &p.x, &p.y) != 3) continue;
		if (number == before) segments.push_back(lineOf({last, p}));
		before = number;
		last = p;
	}
	return segments;
}

/** Length of the segments, in pieces of up to 2 cm of which the middle is near [m]. */
double lengthNear(const std::vector<Polyline>& segments, const PolylineIndex& index, double distance)
{
	double sum = 0;
	for (const Polyline& line : segments)
	{
		const Segment s{line.points[0], line.points[1]};
		const int n = std::max(1, int(std::ceil(s.length() / 0.02)));
		for (int i = 0; i < n; i++)
			if (index.foot(s.at((i + 0.5) / n), distance)) sum += s.length() / n;
	}
	return sum;
}

double lengthOf(const std::vector<Polyline>& segments)
{
	double sum = 0;
	for (const Polyline& s : segments) sum += s.length();
	return sum;
}

void printGhosts(const std::string& log, const std::string& truthFile)
{
	Box2 box;
	std::vector<Polyline> truth;
	for (const Segment& s : readTruth(truthFile))
	{
		box.extend(s.a);
		box.extend(s.b);
		truth.push_back(lineOf(s));
	}
	const PolylineIndex index(truth, reach);
	COccupancyGridMap2D grid(float(box.min.x) - 1, float(box.max.x) + 1, float(box.min.y) - 1, float(box.max.y) + 1,
							 float(resolution));
	build(grid, log);
	std::size_t inside = 0, all = 0;
	for (const Point2& p : occupiedCells(grid))
	{
		if (index.foot(p, reach)) continue;
		all++;
		inside += p.x > box.min.x && p.x < box.max.x && p.y > box.min.y && p.y < box.max.y ? 1 : 0;
	}
	std::printf("%.2f %.2f\n", double(inside) * resolution, double(all) * resolution);
}

void printChange(const std::string& log, const std::string (&files)[3])
{
	const std::vector<Polyline> before = readLines(files[0]), after = readLines(files[1]),
								removed = readLines(files[2]);
	const PolylineIndex stays(after, reach);
	COccupancyGridMap2D grid(-1, 1, -1, 1, float(resolution));
	build(grid, log);
	const PolylineIndex occupied({}, reach, occupiedCells(grid));
	std::printf("%.1f %.1f %.1f %.1f %.1f %.1f %.1f\n", lengthOf(before), lengthOf(after), lengthOf(removed),
				lengthNear(removed, stays, beside), lengthOf(before) - lengthNear(before, stays, beside),
				100 * lengthNear(before, occupied, reach) / lengthOf(before),
				100 * lengthNear(after, occupied, reach) / lengthOf(after));
}

int run(int argc, char** argv)
{
	const std::string what = argc > 1 ? argv[1] : "";
	if (what == "ghosts" && argc == 4)
		printGhosts(argv[2], argv[3]);
	else if (what == "change" && argc == 6)
		printChange(argv[2], {argv[3], argv[4], argv[5]});
	else
		throw UserError("wrong arguments", "give ghosts LOG TRUTH, or change LOG BEFORE AFTER REMOVED");
	return 0;
}
}  // namespace
}  // namespace ridgemap::apps

int main(int argc, char** argv)
{
	return ridgemap::apps::runProgram("free-space-judge", ridgemap::apps::run, argc, argv);
}
