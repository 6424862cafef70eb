// SPDX-License-Identifier: BSD-3-Clause
// Inputs made to break numerics: no measure of them is natural. Whatever the sigma, the place and the density, work per
// tile stays below a counted bound, all numbers are finite, every trace ends for a counted reason, and the order of the
// measurements does not matter.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <numeric>

#include "lattice.h"
#include "polylines.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
constexpr double pi = 3.14159265358979323846;
/** Greatest work per tile that an input is allowed: as of tiles that are full everywhere. */
constexpr double mostEvaluations = 5000;

/** Points in units of sigma. */
using Points = std::vector<Point2>;

Points grid(double spacing, int n, bool hexagonal)
{
	Points all;
	for (int j = 0; j < n; j++)
		for (int i = 0; i < n; i++)
			all.push_back(
				{spacing * (i + (hexagonal && j % 2 != 0 ? 0.5 : 0)), spacing * j * (hexagonal ? std::sqrt(0.75) : 1)});
	return all;
}

Points ring(double radius, int n, int repeats = 1)
{
	Points all;
	for (int k = 0; k < repeats; k++)
		for (int i = 0; i < n; i++)
			all.push_back({radius * std::cos(2 * pi * i / n), radius * std::sin(2 * pi * i / n)});
	return all;
}

/** Arms from the origin at equal angles: with three or more, the Hessian at the middle has two equal eigenvalues. */
Points star(int arms, double spacing)
{
	Points all;
	for (int a = 0; a < arms; a++)
		for (double r = spacing; r < 12; r += spacing)
			all.push_back({r * std::cos(2 * pi * a / arms), r * std::sin(2 * pi * a / arms)});
	return all;
}

/** A line in the frame of the lattice, where tiles are squares. */
Points inLattice(Vec2 a, Vec2 b, double spacing)
{
	Points all;
	const Frame frame(1);
	const double length = norm(b - a);
	for (double t = 0; t <= length; t += spacing) all.push_back(frame.toMap(a + (t / length) * (b - a)));
	return all;
}

Points line(double spacing, double length = 30)
{
	Points all;
	for (double x = 0; x <= length; x += spacing) all.push_back({x, 0});
	return all;
}

struct Adversary
{
	std::string name;
	Points points;
};

std::vector<Adversary> adversaries()
{
	std::vector<Adversary> all{
		{"two places, each many times", {}},
		{"collinear, sparse", line(2.5)},
		{"collinear, dense", line(0.001)},
		{"collinear, upright", {}},
		{"square of four", {{0, 0}, {1, 0}, {0, 1}, {1, 1}}},
		{"cross of two lines", line(0.05)},
		{"along a tile border", inLattice({-20, 16}, {60, 16}, 0.1)},
		{"along a tile border the other way", inLattice({32, -20}, {32, 50}, 0.1)},
		{"through tile corners", inLattice({-48, -48}, {48, 48}, 0.1)},
		{"crossing at a tile corner", inLattice({0, 16}, {32, 16}, 0.1)},
	};
	for (int i = 0; i < 500; i++) all[0].points.push_back({i % 2 * 1.6, 0});
	for (double y = 0; y < 30; y += 0.1) all[3].points.push_back({0, y});
	for (const Point2& p : line(0.05)) all[5].points.push_back({15, p.x - 15});
	for (const Point2& p : inLattice({16, 0}, {16, 32}, 0.1)) all.back().points.push_back(p);
	for (const double spacing : {0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0})
		for (const bool hexagonal : {false, true})
			all.push_back({(hexagonal ? "hexagonal lattice " : "square lattice ") + std::to_string(spacing),
						   grid(spacing, int(24 / spacing), hexagonal)});
	for (const double radius : {0.5, 1.0, 1.5, 2.0, 5.0, 20.0})
		all.push_back({"circle " + std::to_string(radius), ring(radius, 360)});
	for (const int corners : {3, 4, 5, 6, 8})
	{
		all.push_back({"corners " + std::to_string(corners), ring(1.3, corners, 20)});
		all.push_back({"star " + std::to_string(corners), star(corners, 0.1)});
	}
	return all;
}

bool isFinite(const Polyline& line)
{
	for (const Point2& p : line.points)
		if (!std::isfinite(p.x) || !std::isfinite(p.y)) return false;
	for (const VertexInfo& v : line.info)
		if (!std::isfinite(v.occupancy) || !std::isfinite(v.curvature) || std::isnan(v.standardError)) return false;
	return line.points.size() >= 2 && line.info.size() == line.points.size();
}

/** Checks a map of the points and gives the work per tile.
 * @param sensors from which the points were seen in turn, in units of sigma; if empty, that is not known */
double check(const Points& points, const Options& options, Point2 shift, const std::string& what,
			 const Points& sensors = {})
{
	const auto placed = [&](Point2 p) { return Point2{shift.x + options.sigma * p.x, shift.y + options.sigma * p.y}; };
	std::vector<Measurement> measurements;
	for (std::size_t i = 0; i < points.size(); i++)
	{
		const Point2 p = placed(points[i]);
		measurements.push_back({p.x, p.y});
		if (sensors.empty()) continue;
		const Point2 s = placed(sensors[i % sensors.size()]);
		measurements.back().sensorX = s.x;
		measurements.back().sensorY = s.y;
	}
	RidgeMap map(options);
	map.insert(measurements);
	const UpdateResult r = map.update();
	const double perTile = double(r.evaluations) / double(std::max<std::size_t>(1, r.tiles));
	EXPECT_LT(perTile, mostEvaluations) << what;
	EXPECT_EQ(std::accumulate(r.stops.begin(), r.stops.end(), std::size_t(0)) > 0, r.traces > 0) << what;
	EXPECT_EQ(r.stops[std::size_t(StopReason::workLimit)], 0u) << what;
	for (const auto* lines : {&map.ridges(), &map.walls()})
		for (const Polyline& line : *lines) EXPECT_TRUE(isFinite(line)) << what;
	EXPECT_EQ(map.statistics().measurements, points.size()) << what;

	std::reverse(measurements.begin(), measurements.end());
	RidgeMap other(options);
	for (const Measurement& m : measurements) other.insert({m});
	EXPECT_EQ(firstDifference(map.ridges(), other.ridges()), "") << what;
	if (!sensors.empty())
	{
		EXPECT_EQ(firstDifference(map.walls(), other.walls()), "") << what;
		map.erase(measurements);
		EXPECT_TRUE(map.empty() && map.cells().empty() && map.freeCells().empty()) << what;
	}
	return perTile;
}
}  // namespace

TEST(Adversaries, EveryShapeAtEverySigma)
{
	double worst = 0;
	std::string where;
	for (const Adversary& a : adversaries())
		for (const double sigma : {1e-3, 0.05, 1.0, 1e3})
		{
			Options options;
			options.sigma = sigma;
			const std::string what = a.name + ", sigma " + std::to_string(sigma);
			const double perTile = check(a.points, options, {}, what);
			if (perTile > worst) worst = perTile, where = what;
		}
	std::cout << "most evaluations per tile: " << worst << " (" << where << ")\n";
}

TEST(Adversaries, AtTheEdgesOfTheWorld)
{
	double worst = 0;
	for (const Adversary& a : adversaries())
		for (const double sigma : {1e-3, 0.05, 100.0})
		{
			Options options;
			options.sigma = sigma;
			const double far = maxCoordinate - 100 * sigma;
			for (const Point2 shift : {Point2{far, far}, Point2{-far, far}, Point2{-far, -far}})
				worst = std::max(worst, check(a.points, options, shift, a.name + ", sigma " + std::to_string(sigma)));
		}
	std::cout << "most evaluations per tile: " << worst << "\n";
}

TEST(Adversaries, SeenFromBothSidesAndFromWithin)
{
	double worst = 0;
	std::string where;
	for (const Adversary& a : adversaries())
		for (const double sigma : {1e-3, 0.05, 1e3})
		{
			Options options;
			options.sigma = sigma;
			const std::string what = a.name + ", sigma " + std::to_string(sigma);
			// From above and below, and along a line; from within the shape, and from one of its points.
			for (const Points& sensors :
				 {Points{{5, 40}, {6, -40}, {-60, 0}}, Points{{0, 0}, {4.1, 3.9}, a.points[a.points.size() / 2]}})
			{
				const double perTile = check(a.points, options, {}, what, sensors);
				if (perTile > worst) worst = perTile, where = what;
			}
		}
	std::cout << "most evaluations per tile: " << worst << " (" << where << ")\n";
}

TEST(Adversaries, DensitiesFromOneToAMillionPerMetre)
{
	for (const double perMetre : {1.0, 10.0, 1e3, 1e5, 1e6})
		for (const double sigma : {0.02, 0.5})
		{
			Random random(3);
			std::vector<Measurement> wall;
			for (int i = 0; i < int(2 * perMetre); i++)
			{
				const double x = random.uniform(0, 2), y = sigma / 3 * random.normal();
				wall.push_back({x, y});
			}
			Options options;
			options.sigma = sigma;
			RidgeMap map(options);
			map.insert(wall);
			const UpdateResult r = map.update();
			EXPECT_LT(double(r.evaluations), mostEvaluations * double(std::max<std::size_t>(1, r.tiles)));
			EXPECT_EQ(r.stops[std::size_t(StopReason::workLimit)], 0u);
			for (const Polyline& line : map.walls()) EXPECT_TRUE(isFinite(line));
			// Where there is a wall to see, there is one.
			if (perMetre * sigma > 100)
			{
				EXPECT_EQ(map.walls().size(), 1u) << perMetre << " per metre, sigma " << sigma;
			}
		}
}

TEST(Adversaries, MostMeasurementsThatACellTakes)
{
	RidgeMap map;
	map.insert({{0.5, 0.5}, {0.51, 0.5}, {0.52, 0.501}});
	// Merging a copy doubles the counts: exact until the limit, then an error that changes nothing.
	int refused = 0;
	for (int i = 0; i < 34; i++)
	{
		const RidgeMap copy = map;
		try
		{
			map.merge(copy);
			EXPECT_LT(i, 31);
		}
		catch (const std::overflow_error&)
		{
			refused++;
			EXPECT_EQ(firstDifference(map.cells(), copy.cells()), "");
		}
	}
	EXPECT_EQ(refused, 3);
	for (const CellRecord& c : map.cells()) EXPECT_LE(c.n, maxCountPerCell);
	for (const Polyline& line : map.ridges()) EXPECT_TRUE(isFinite(line));
	EXPECT_TRUE(std::isfinite(map.occupancy({0.5, 0.5}).value));
}

}  // namespace ridgemap::test
