// SPDX-License-Identifier: BSD-3-Clause
// Fewest-vertex polylines against an exhaustive search, and their bound against dense sampling.
#include <gtest/gtest.h>
#include <ridgemap/simplify.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "scenes.h"

namespace ridgemap::test
{
namespace
{
double distance(const Point2& p, const Point2& a, const Point2& b)
{
	const double dx = b.x - a.x, dy = b.y - a.y, n = dx * dx + dy * dy;
	const double t = n > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / n, 0.0, 1.0) : 0;
	return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

Polyline polyline(std::vector<Point2> points, bool closed = false)
{
	Polyline line;
	if (closed) points.push_back(points.front());
	line.info.resize(points.size());
	line.points = std::move(points);
	line.closed = closed;
	return line;
}

/** A random walk with few turns, noise across. */
Polyline randomLine(unsigned seed, std::size_t n, double noise)
{
	std::mt19937 random(seed);
	std::normal_distribution<double> gauss(0, noise);
	std::uniform_real_distribution<double> uniform(0, 1);
	std::vector<Point2> points;
	double x = 0, y = 0, angle = 0;
	for (std::size_t i = 0; i < n; i++)
	{
		if (uniform(random) < 0.25) angle += uniform(random) * 3 - 1.5;
		x += 0.1 * std::cos(angle);
		y += 0.1 * std::sin(angle);
		points.push_back({x + gauss(random), y + gauss(random)});
	}
	return polyline(points);
}

Polyline ring(unsigned seed, std::size_t n, double noise)
{
	std::mt19937 random(seed);
	std::normal_distribution<double> gauss(0, noise);
	std::vector<Point2> points;
	for (std::size_t i = 0; i < n; i++)
	{
		const double a = 2 * pi * double(i) / double(n), r = 1 + gauss(random);
		points.push_back({r * std::cos(a), 2 * r * std::sin(a)});
	}
	return polyline(points, true);
}

bool isShortcut(const std::vector<Point2>& p, std::size_t i, std::size_t j, double tolerance)
{
	for (std::size_t k = i + 1; k < j; k++)
		if (distance(p[k % p.size()], p[i % p.size()], p[j % p.size()]) > tolerance) return false;
	return true;
}

/** Fewest vertices by trying all subsets. For closed lines `p` comes without its last point. */
std::size_t fewestVertices(const std::vector<Point2>& p, double tolerance, bool closed)
{
	const std::size_t n = p.size();
	std::size_t fewest = n;
	for (std::size_t subset = 0; subset < std::size_t(1) << n; subset++)
	{
		std::vector<std::size_t> kept;
		for (std::size_t i = 0; i < n; i++)
			if (subset >> i & 1) kept.push_back(i);
		if (kept.size() >= fewest || kept.size() < (closed ? 3u : 2u)) continue;
		if (!closed && (kept.front() != 0 || kept.back() != n - 1)) continue;
		if (closed) kept.push_back(kept.front() + n);
		bool fits = true;
		for (std::size_t k = 1; k < kept.size() && fits; k++) fits = isShortcut(p, kept[k - 1], kept[k], tolerance);
		if (fits) fewest = kept.size() - (closed ? 1 : 0);
	}
	return fewest;
}

/** Whether every point of one line is within the tolerance of the other one, by brute force. */
void expectWithin(const Polyline& a, const Polyline& b, double tolerance)
{
	for (std::size_t i = 1; i < a.points.size(); i++)
		for (double t = 0; t <= 1; t += 1.0 / 64)
		{
			const Point2 p{a.points[i - 1].x + t * (a.points[i].x - a.points[i - 1].x),
						   a.points[i - 1].y + t * (a.points[i].y - a.points[i - 1].y)};
			double nearest = std::numeric_limits<double>::infinity();
			for (std::size_t k = 1; k < b.points.size(); k++)
				nearest = std::min(nearest, distance(p, b.points[k - 1], b.points[k]));
			ASSERT_LE(nearest, tolerance);
		}
}
}  // namespace

TEST(Simplify, fewestVerticesOfOpenLines)
{
	for (unsigned seed = 0; seed < 40; seed++)
		for (const double tolerance : {0.01, 0.05, 0.15})
		{
			const Polyline line = randomLine(seed, 12, 0.02);
			const auto out = simplified({line}, tolerance);
			EXPECT_EQ(out[0].points.size(), fewestVertices(line.points, tolerance, false)) << seed << ' ' << tolerance;
			EXPECT_EQ(out[0].info.size(), out[0].points.size());
			EXPECT_EQ(out[0].points.front(), line.points.front());
			EXPECT_EQ(out[0].points.back(), line.points.back());
		}
}

TEST(Simplify, fewestVerticesOfClosedLines)
{
	for (unsigned seed = 0; seed < 20; seed++)
		for (const double tolerance : {0.02, 0.1, 0.4, 5.0})
		{
			const Polyline line = ring(seed, 12, 0.05);
			const auto out = simplified({line}, tolerance);
			const std::vector<Point2> open(line.points.begin(), line.points.end() - 1);
			EXPECT_EQ(out[0].points.size() - 1, fewestVertices(open, tolerance, true)) << seed << ' ' << tolerance;
			EXPECT_TRUE(out[0].closed);
			EXPECT_EQ(out[0].points.front(), out[0].points.back());
		}
}

TEST(Simplify, staysWithinTheToleranceInBothDirections)
{
	for (unsigned seed = 0; seed < 10; seed++)
		for (const double tolerance : {0.003, 0.02, 0.1})
		{
			const std::vector<Polyline> lines{randomLine(seed, 200, 0.004), ring(seed, 100, 0.01)};
			const auto out = simplified(lines, tolerance);
			for (std::size_t i = 0; i < lines.size(); i++)
			{
				EXPECT_LT(out[i].points.size(), lines[i].points.size());
				expectWithin(lines[i], out[i], tolerance);
				expectWithin(out[i], lines[i], tolerance);
			}
			EXPECT_LE(greatestDeviation(lines, out, 0.001), tolerance);
			EXPECT_TRUE(samePolylines(out, simplified(lines, tolerance)));
		}
}

TEST(Simplify, straightWallIsTwoPoints)
{
	std::vector<Point2> points;
	for (int i = 0; i < 3000; i++) points.push_back({i * 0.01, 1e-3 * std::sin(i)});
	EXPECT_EQ(simplified({polyline(points)}, 0.005)[0].points.size(), 2u);
}

TEST(Simplify, hairpinsAreKept)
{
	// There and back again: the tip is farther than the tolerance from the segment between the ends.
	EXPECT_EQ(simplified({polyline({{0, 0}, {1, 0}, {2, 0.001}, {1, 0.002}, {0.001, 0.002}})}, 0.01)[0].points.size(),
			  3u);
}

TEST(Simplify, junctionsAreKept)
{
	const Polyline along = polyline({{0, 0}, {1, 0}, {2, 0}, {3, 0}});
	const Polyline atVertex = polyline({{1, 0}, {1, 1}}), inside = polyline({{2.5, 0}, {2.5, 1}});
	const auto out = simplified({along, atVertex, inside}, 0.1);
	const std::vector<Point2> expected{{0, 0}, {1, 0}, {2.5, 0}, {3, 0}};
	EXPECT_EQ(out[0].points, expected);
	EXPECT_EQ(out[0].info.size(), 4u);
	const Polyline circle = ring(1, 40, 0);
	const auto touched = simplified({circle, polyline({circle.points[7], {5, 5}})}, 0.5);
	EXPECT_EQ(std::count(touched[0].points.begin(), touched[0].points.end(), circle.points[7]), 2);
	EXPECT_GE(touched[0].points.size(), 4u);
}

TEST(Simplify, zeroKeepsAllAndWrongTolerancesThrow)
{
	const std::vector<Polyline> lines{randomLine(1, 30, 0.01)};
	EXPECT_TRUE(samePolylines(simplified(lines, 0), lines));
	EXPECT_TRUE(simplified({}, 1).empty());
	EXPECT_THROW(simplified(lines, -1), std::invalid_argument);
	EXPECT_THROW(simplified(lines, std::nan("")), std::invalid_argument);
	EXPECT_THROW(simplified(lines, std::numeric_limits<double>::infinity()), std::invalid_argument);
}

TEST(Simplify, mapsAreSimplified)
{
	CRidgeMap2D map;
	map.insertMeasurements(room());
	const auto lines = map.simplified(0.02);
	EXPECT_TRUE(samePolylines(lines, simplified(map.walls(), 0.02)));
	EXPECT_LE(greatestDeviation(lines, map.walls(), 0.001), 0.02);
}

}  // namespace ridgemap::test
