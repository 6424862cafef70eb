// SPDX-License-Identifier: BSD-3-Clause
// Sharpened corners of walls, against the corners that the measurements were made from.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <cmath>

#include "scenes.h"
#include "wall_path.h"
#include "walls.h"

using namespace ridgemap;
using namespace ridgemap::test;

namespace
{
constexpr double noise = 0.35;  ///< across the walls [sigma]

/** Distance from a point to the nearest made corner. */
double distanceToCorner(const std::vector<Polyline>& walls, const Point2& p)
{
	double best = 1e30;
	for (const Polyline& w : walls)
		for (std::size_t k = 0; k < w.points.size(); k++)
			if (w.info[k].origin == VertexOrigin::corner)
				best = std::min(best, std::hypot(w.points[k].x - p.x, w.points[k].y - p.y));
	return best;
}

/** Corners made. */
std::size_t madeVertices(const std::vector<Polyline>& walls)
{
	std::size_t n = 0;
	for (const Polyline& w : walls)
		n += std::size_t(std::count_if(w.info.begin() + 1, w.info.end() - 1,
									   [](const VertexInfo& v) { return v.origin == VertexOrigin::corner; }));
	return n;
}

RidgeMap mapOf(const std::vector<Measurement>& m, bool sharpen = true)
{
	Options o;
	o.sigma = 1;
	o.sharpen = sharpen;
	RidgeMap map(o);
	map.insert(m);
	return map;
}
}  // namespace

TEST(FitLine, IsThatOfManyPoints)
{
	// A line with a narrow bump that coarse samples do not see, against the second moments of the polyline in closed
	// form.
	Polyline line;
	line.points = {{0, 0}, {9.9, 0}, {10, 2}, {10.1, 0}, {16, 0}};
	line.info.resize(line.points.size());
	const Path path(line);
	double length = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
	for (std::size_t k = 1; k < line.points.size(); k++)
	{
		const Point2 &a = line.points[k - 1], &b = line.points[k];
		const double l = std::hypot(b.x - a.x, b.y - a.y);
		length += l;
		x += 0.5 * l * (a.x + b.x);
		y += 0.5 * l * (a.y + b.y);
		xx += l / 3 * (a.x * a.x + a.x * b.x + b.x * b.x);
		yy += l / 3 * (a.y * a.y + a.y * b.y + b.y * b.y);
		xy += l / 6 * (2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y);
	}
	x /= length, y /= length;
	xx = xx / length - x * x, xy = xy / length - x * y, yy = yy / length - y * y;
	const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
	const FittedLine fit = fitLine(path, 0, path.length(), 0.01);
	EXPECT_NEAR(fit.mean.x, x, 0.02);
	EXPECT_NEAR(fit.mean.y, y, 0.02);
	EXPECT_NEAR(std::atan2(fit.direction.y, fit.direction.x), angle, 1e-3);
	EXPECT_NEAR(fit.rms, std::sqrt(0.5 * (xx + yy) - std::hypot(0.5 * (xx - yy), xy)), 0.01);
	EXPECT_GT(fit.rms, 0.1);
}

TEST(SharpenCorners, MeetsTheTrueCornerForManyAngles)
{
	// Lines fitted over 4 widths with 60 measurements a width meet within about 0.1 sigma of the corner, less well in a
	// sharp angle; the ridge itself stays off by 0.4 and more.
	for (const double angle : {60.0, 75.0, 90.0, 105.0, 120.0})
		for (std::uint64_t seed = 1; seed <= 4; seed++)
		{
			const double a = angle * M_PI / 180;
			const std::vector<Measurement> m = SceneBuilder(seed, 1, noise, 60)
												   .wall({30, 0}, {0, 0})
												   .wall({0, 0}, {30 * std::cos(a), 30 * std::sin(a)})
												   .finish({3.3, -1.7}, 0.4 * double(seed));
			const RidgeMap map = mapOf(m);
			ASSERT_EQ(map.walls().size(), 1u) << angle << " degrees, seed " << seed;
			EXPECT_LT(distanceToCorner(map.walls(), {3.3, -1.7}), 0.3) << angle << " degrees, seed " << seed;
		}
}

TEST(SharpenCorners, OneArmMayBeShort)
{
	// Just long enough for a line to be fitted to it, in both directions.
	for (const double turn : {-1.1, 1.1})
		for (const bool reversed : {false, true})
		{
			const Point2 apex{20, 0}, end{20 + 4.6 * std::cos(turn), 4.6 * std::sin(turn)};
			auto m = exactWall(reversed ? end : Point2{0, 0}, apex, 0.02);
			for (const Measurement& q : exactWall(apex, reversed ? Point2{0, 0} : end, 0.02)) m.push_back(q);
			const RidgeMap map = mapOf(m);
			EXPECT_EQ(madeVertices(map.walls()), 1u) << turn;
			EXPECT_LT(distanceToCorner(map.walls(), apex), 0.2) << turn;
		}
}

TEST(SharpenCorners, ClosedSquareKeepsItsFourCorners)
{
	const std::vector<Measurement> m = SceneBuilder(7, 1, noise, 60)
										   .wall({-12, -12}, {12, -12})
										   .wall({12, -12}, {12, 12})
										   .wall({12, 12}, {-12, 12})
										   .wall({-12, 12}, {-12, -12})
										   .finish();
	const RidgeMap map = mapOf(m);
	ASSERT_EQ(map.walls().size(), 1u);
	EXPECT_TRUE(map.walls()[0].closed);
	EXPECT_EQ(map.walls()[0].points.front(), map.walls()[0].points.back());
	EXPECT_NEAR(map.walls()[0].length(), 96, 0.5);
	for (const double x : {-12.0, 12.0})
		for (const double y : {-12.0, 12.0}) EXPECT_LT(distanceToCorner(map.walls(), {x, y}), 0.2);
}

TEST(SharpenCorners, LeavesCurvesAndStraightWallsAlone)
{
	for (const double radius : {5.0, 8.0, 20.0})
		EXPECT_EQ(madeVertices(mapOf(SceneBuilder(11, 1, noise, 60).circle({0, 0}, radius).finish()).walls()), 0u)
			<< radius;
	EXPECT_EQ(madeVertices(mapOf(SceneBuilder(12, 1, noise, 60).wall({0, 0}, {50, 0}).finish()).walls()), 0u);
	// A corner rounded with a radius of four widths is no corner.
	const std::vector<Measurement> rounded = SceneBuilder(13, 1, noise, 60)
												 .wall({4, 0}, {30, 0})
												 .arc({4, 4}, 4, M_PI, 1.5 * M_PI)
												 .wall({0, 4}, {0, 30})
												 .finish();
	EXPECT_EQ(madeVertices(mapOf(rounded).walls()), 0u);
}

TEST(SharpenCorners, CanBeSwitchedOff)
{
	const std::vector<Measurement> m =
		SceneBuilder(3, 1, noise, 60).wall({30, 0}, {0, 0}).wall({0, 0}, {0, 30}).finish();
	EXPECT_EQ(madeVertices(mapOf(m, false).walls()), 0u);
	EXPECT_EQ(madeVertices(mapOf(m, true).walls()), 1u);
}

TEST(SharpenCorners, EveryPointStaysNearTheRidge)
{
	for (std::uint64_t seed = 1; seed <= 10; seed++)
	{
		const RandomScene scene = randomScene(seed);
		RidgeMap map(scene.options());
		map.insert(scene.measurements);
		for (std::size_t i = 0; i < map.ridges().size(); i++)
			for (const Point2& p : sharpenCorners(map.ridges()[i], scene.options()).points)
			{
				double best = 1e30;
				for (const Point2& q : map.ridges()[i].points) best = std::min(best, std::hypot(p.x - q.x, p.y - q.y));
				EXPECT_LT(best, 5 * scene.sigma) << "seed " << seed;
			}
	}
}

TEST(TrimEnds, MovesTheEndsToWhereTheSurfaceEnds)
{
	// The raw ridge overshoots the surface; the trimmed wall ends on it, on the average over many walls and turns.
	double raw = 0, trimmed = 0;
	const int n = 40;
	for (int seed = 1; seed <= n; seed++)
	{
		const std::vector<Measurement> m =
			SceneBuilder(std::uint64_t(seed), 1, noise, 60).wall({0, 0}, {30, 0}).finish({}, 0.15 * seed);
		Options o;
		o.sigma = 1;
		o.trim = false;
		RidgeMap without(o);
		without.insert(m);
		const RidgeMap with = mapOf(m);
		ASSERT_EQ(with.walls().size(), 1u);
		ASSERT_EQ(without.walls().size(), 1u);
		raw += without.walls()[0].length() / n;
		trimmed += with.walls()[0].length() / n;
		EXPECT_NEAR(with.walls()[0].length(), 30, 0.8) << "seed " << seed;
	}
	EXPECT_NEAR(trimmed, 30, 0.15);
	EXPECT_GT(raw, trimmed + 0.5);
}
