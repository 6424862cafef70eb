// SPDX-License-Identifier: BSD-3-Clause
// What comes out of simple surfaces, against closed forms.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <cmath>

#include "polylines.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
constexpr double pi = 3.14159265358979323846;

/** Unit smoothing: all lengths in these tests are in sigma. */
Options unitOptions()
{
	Options o;
	o.sigma = 1;
	return o;
}

RidgeMap mapOf(const std::vector<Measurement>& measurements, const Options& options = unitOptions())
{
	RidgeMap map(options);
	map.insert(measurements);
	return map;
}

std::vector<Measurement> operator+(std::vector<Measurement> a, const std::vector<Measurement>& b)
{
	a.insert(a.end(), b.begin(), b.end());
	return a;
}

std::vector<Measurement> exactCircle(Point2 c, double radius, double spacing)
{
	std::vector<Measurement> result;
	const int n = int(std::ceil(2 * pi * radius / spacing));
	for (int i = 0; i < n; i++)
		result.push_back({c.x + radius * std::cos(2 * pi * i / n), c.y + radius * std::sin(2 * pi * i / n)});
	return result;
}

/** Ends of open polylines that touch no other polyline. */
std::size_t freeEnds(const std::vector<Polyline>& lines)
{
	const SegmentIndex index(lines, 1);
	std::size_t count = 0;
	for (std::size_t i = 0; i < lines.size(); i++)
		for (const Point2& end : {lines[i].points.front(), lines[i].points.back()})
			count += !lines[i].closed && index.nearest(end, 1e-6,
													   [&](const SegmentIndex::Segment& s, const SegmentFoot&)
													   { return s.line != i; }) >= 1e-6;
	return count;
}

/** Largest distance of points on the segment a-b, without its last 2 sigma, from the polylines. */
double largestGap(const std::vector<Polyline>& lines, Point2 a, Point2 b)
{
	const SegmentIndex index(lines, 2);
	const double length = std::hypot(b.x - a.x, b.y - a.y);
	double worst = 0;
	for (double s = 2; s < length - 2; s += 0.1)
		worst = std::max(worst, index.nearest({a.x + s / length * (b.x - a.x), a.y + s / length * (b.y - a.y)}, 5));
	return worst;
}

/** Place of the ridges of two parallel walls at +-a, from their middle: y = a tanh(a y). */
double ridgeOfParallelWalls(double a)
{
	double y = a;
	for (int i = 0; i < 1000; i++) y = a * std::tanh(a * y);
	return y;
}
}  // namespace

TEST(StraightWall, IsOneStraightLineWithinTheSamplingError)
{
	for (std::uint64_t seed = 1; seed <= 10; seed++)
	{
		const double noise = 0.4, density = 20, angle = 0.3 * double(seed);
		const RidgeMap map =
			mapOf(SceneBuilder(seed, 1, noise, density).wall({0, 0}, {60, 0}).finish({100, 50}, angle));
		ASSERT_EQ(map.walls().size(), 1u) << "seed " << seed;
		EXPECT_NEAR(map.walls()[0].length(), 60, 3);
		double sum = 0, n = 0;
		const auto& ridges = map.ridges();
		const Polyline& longest = *std::max_element(
			ridges.begin(), ridges.end(), [](const Polyline& a, const Polyline& b) { return a.length() < b.length(); });
		for (const Point2& p : longest.points)
		{
			const double along = (p.x - 100) * std::cos(angle) + (p.y - 50) * std::sin(angle);
			const double across = (p.y - 50) * std::cos(angle) - (p.x - 100) * std::sin(angle);
			EXPECT_LT(std::abs(across), 1) << "seed " << seed;
			if (along < 3 || along > 57) continue;  // the ends follow their last few measurements
			EXPECT_LT(std::abs(across), 0.3) << "seed " << seed;
			sum += across * across;
			n++;
		}
		// The ridge is a mean over about 2 sqrt(pi) sigma of wall.
		const double expected = noise / std::sqrt(2 * std::sqrt(pi) * density);
		EXPECT_LT(std::sqrt(sum / n), 2 * expected) << "seed " << seed;
		EXPECT_GT(std::sqrt(sum / n), expected / 4) << "seed " << seed;
	}
}

TEST(StraightWall, WithoutNoiseIsExact)
{
	const RidgeMap map = mapOf(exactWall({0, 0}, {50, 0}, 0.1));
	ASSERT_EQ(map.ridges().size(), 1u);
	EXPECT_NEAR(map.ridges()[0].length(), 50, 0.6);
	for (const Point2& p : map.ridges()[0].points) EXPECT_NEAR(p.y, 0, map.options().effectiveEps());
	EXPECT_FALSE(map.ridges()[0].closed);
	EXPECT_EQ(map.statistics().unstitchedCrossings, 0u);
}

TEST(StraightWall, EndsAtGapsThatDTolDoesNotSpan)
{
	// So many measurements that the density alone would let the ridge go on across a gap of 5 sigma.
	std::vector<Measurement> wall = exactWall({0, 0}, {25, 0}, 0.002);
	for (const Measurement& m : exactWall({30, 0}, {50, 0}, 0.002)) wall.push_back(m);
	for (const double dTol : {1.0, 4.0})
	{
		Options o;
		o.sigma = 1;
		o.dTol = dTol;
		RidgeMap map(o);
		map.insert(wall);
		EXPECT_GT(map.occupancy({27.5, 0}).value, 3 * o.lTol);
		ASSERT_EQ(map.ridges().size(), dTol < 2 ? 2u : 1u);
		const double length = totalLength(map.ridges());
		EXPECT_GT(length, dTol < 2 ? 44.5 : 49.5);
		EXPECT_LT(length, dTol < 2 ? 49 : 50.5);
	}
}

TEST(StraightWall, VerticesKnowHeightAndCurvature)
{
	const double noise = 0.4, density = 100;
	const RidgeMap map = mapOf(SceneBuilder(31, 1, noise, density).wall({0, 0}, {60, 0}).finish());
	ASSERT_EQ(map.walls().size(), 1u);
	for (const auto* lines : {&map.ridges(), &map.walls()})
		for (const Polyline& line : *lines)
		{
			ASSERT_EQ(line.info.size(), line.points.size());
			for (std::size_t i = 0; i < line.points.size(); i++)
			{
				if (line.info[i].occupancy == 0) continue;
				const double value = map.occupancy(line.points[i]).value;
				EXPECT_NEAR(line.info[i].occupancy, value, 1e-3 * value);
				if (line.points[i].x < 5 || line.points[i].x > 55) continue;
				// L = sqrt(2 pi) density / sqrt(1 + s^2), -lambda1 / L = 1 / (1 + s^2)
				EXPECT_NEAR(value, std::sqrt(2 * pi / (1 + noise * noise)) * density, 0.25 * value);
				EXPECT_NEAR(line.info[i].curvature, 1 / (1 + noise * noise), 0.1);
			}
		}
}

TEST(StraightWall, ErrorFallsWithTheRootOfTheDensity)
{
	const auto error = [](double density)
	{
		double sum = 0, n = 0;
		for (std::uint64_t seed = 20; seed < 30; seed++)
		{
			const RidgeMap map = mapOf(SceneBuilder(seed, 1, 0.35, density).wall({0, 0}, {80, 0}).finish());
			for (const Polyline& wall : map.walls())
				for (const Point2& p : wall.points) sum += p.y * p.y, n++;
		}
		return std::sqrt(sum / n);
	};
	const double sparse = error(8), dense = error(128);
	EXPECT_NEAR(sparse / dense, 4, 1.4);
}

TEST(Corner, IsOneLineThatCutsByTheClosedForm)
{
	const RidgeMap exact = mapOf(exactWall({40, 0}, {0, 0}, 0.05) + exactWall({0, 0.05}, {0, 40}, 0.05));
	ASSERT_EQ(exact.ridges().size(), 1u);
	EXPECT_NEAR(exact.ridges()[0].length(), 80, 2.5);
	EXPECT_NEAR(SegmentIndex(exact.ridges(), 2).nearest({0, 0}, 5), 0.72, 0.02);

	const double noise = 0.4;
	const RidgeMap noisy = mapOf(SceneBuilder(3, 1, noise, 100).wall({0, 0}, {40, 0}).wall({0, 0}, {0, 40}).finish());
	ASSERT_EQ(noisy.ridges().size(), 1u);
	EXPECT_NEAR(SegmentIndex(noisy.ridges(), 2).nearest({0, 0}, 5), 0.72 * std::sqrt(1 + noise * noise), 0.07);
}

TEST(Circle, IsClosedAndHasTheRadiusOfTheClosedForm)
{
	for (const double radius : {2.5, 3.0, 5.0, 8.0, 20.0})
		for (const Point2& centre : {Point2{0, 0}, {7.3, -2.1}, {-311, 95}})
		{
			const RidgeMap map = mapOf(exactCircle(centre, radius, 0.05));
			ASSERT_EQ(map.ridges().size(), 1u) << "radius " << radius;
			const Polyline& line = map.ridges()[0];
			EXPECT_TRUE(line.closed);
			EXPECT_EQ(line.points.front(), line.points.back());
			EXPECT_EQ(line.startReason, StopReason::closedLoop);
			// R = r I1(z) / I0(z), z = R r: the ring's density is I0 with a normal factor.
			double ridge = radius;
			for (int i = 0; i < 200; i++)
				ridge = radius * std::cyl_bessel_i(1, ridge * radius) / std::cyl_bessel_i(0, ridge * radius);
			for (const Point2& p : line.points) EXPECT_NEAR(std::hypot(p.x - centre.x, p.y - centre.y), ridge, 0.005);
			EXPECT_NEAR(line.length(), 2 * pi * ridge, 0.02 * radius);
			EXPECT_EQ(map.walls().size(), 1u);
			EXPECT_TRUE(map.walls()[0].closed);
		}
}

TEST(Junction, OfATHasThreeFreeEnds)
{
	for (std::uint64_t seed = 1; seed <= 12; seed++)
	{
		const double lean = 8 * std::sin(double(seed));
		const auto measurements = SceneBuilder(seed, 1, 0.35, 25)
									  .wall({-30, 0}, {30, 0})
									  .wall({0, 0}, {lean, 30})
									  .finish({20, 9}, double(seed));
		const RidgeMap map = mapOf(measurements);
		EXPECT_EQ(freeEnds(map.walls()), 3u) << "seed " << seed;
		EXPECT_NEAR(totalLength(map.walls()), 60 + std::hypot(lean, 30), 4) << "seed " << seed;
		EXPECT_EQ(danglingEnds(map.walls(), 1.5), 0u) << "seed " << seed;
	}
}

TEST(Junction, OfAnXHasFourFreeEnds)
{
	for (std::uint64_t seed = 1; seed <= 12; seed++)
	{
		const double lean = 12 * std::sin(double(seed));
		const auto measurements = SceneBuilder(seed, 1, 0.35, 25)
									  .wall({-30, 0}, {30, 0})
									  .wall({-lean, -30}, {lean, 30})
									  .finish({20, 9}, double(seed));
		const RidgeMap map = mapOf(measurements);
		EXPECT_EQ(freeEnds(map.walls()), 4u) << "seed " << seed;
		EXPECT_NEAR(totalLength(map.walls()), 60 + 2 * std::hypot(lean, 30), 6) << "seed " << seed;
		EXPECT_EQ(danglingEnds(map.walls(), 1.5), 0u) << "seed " << seed;
	}
}

TEST(Junction, WithoutNoiseIsConnected)
{
	const RidgeMap t = mapOf(exactWall({-30, 0}, {30, 0}, 0.05) + exactWall({0, 0.05}, {0, 30}, 0.05));
	EXPECT_EQ(freeEnds(t.walls()), 3u);
	const RidgeMap x = mapOf(exactWall({-30, 0}, {30, 0}, 0.05) + exactWall({0, -30}, {0, 30}, 0.05));
	EXPECT_EQ(freeEnds(x.walls()), 4u);
	EXPECT_LT(largestGap(x.walls(), {-30, 0}, {30, 0}), 1.2);
	EXPECT_LT(largestGap(x.walls(), {0, -30}, {0, 30}), 1.2);
}

TEST(ParallelWalls, FarApartAreTwoLinesAtTheClosedForm)
{
	for (const double distance : {2.5, 3.0, 4.0, 8.0, 30.0})
	{
		const RidgeMap map = mapOf(exactWall({0, 0}, {60, 0}, 0.1) + exactWall({0, distance}, {60, distance}, 0.1));
		const double y = ridgeOfParallelWalls(0.5 * distance), middle = 0.5 * distance;
		EXPECT_EQ(map.walls().size(), 2u) << "distance " << distance;
		int sides = 0;
		for (const Polyline& ridge : map.ridges())
			for (const Point2& p : ridge.points)
			{
				if (p.x < 5 || p.x > 55) continue;
				EXPECT_NEAR(std::abs(p.y - middle), y, 0.01) << "distance " << distance;
				sides |= p.y < middle ? 1 : 2;
			}
		EXPECT_EQ(sides, 3);
	}
}

TEST(ParallelWalls, CloserThanTwiceTheSmoothingAreOneLineInTheMiddle)
{
	for (const double distance : {0.5, 1.0, 1.5, 1.9})
	{
		const RidgeMap map = mapOf(exactWall({0, 0}, {60, 0}, 0.1) + exactWall({0, distance}, {60, distance}, 0.1));
		ASSERT_EQ(map.walls().size(), 1u) << "distance " << distance;
		for (const Point2& p : map.walls()[0].points)
			EXPECT_NEAR(p.y, 0.5 * distance, p.x > 5 && p.x < 55 ? 0.01 : 0.1);
	}
	// With noise s the limit is 2 sqrt(sigma^2 + s^2) = 2.15.
	const RidgeMap noisy = mapOf(SceneBuilder(9, 1, 0.4, 200).wall({0, 0}, {40, 0}).wall({0, 1.8}, {40, 1.8}).finish());
	EXPECT_EQ(noisy.walls().size(), 1u);
}

TEST(Switches, AttachJoinsTheStemOfAT)
{
	const auto measurements = exactWall({-30, 0}, {30, 0}, 0.05) + exactWall({0, 0.05}, {0, 30}, 0.05);
	Options off = unitOptions();
	off.attach = false;
	const RidgeMap with = mapOf(measurements), without = mapOf(measurements, off);
	EXPECT_EQ(freeEnds(with.walls()), 3u);
	EXPECT_GT(freeEnds(without.walls()), 3u) << "the ridge of the stem ends before the bar";
	EXPECT_EQ(firstDifference(with.ridges(), without.ridges()), "");
}

TEST(Switches, PruneLeavesOutWhatIsShort)
{
	const auto measurements = exactWall({-30, 0}, {30, 0}, 0.05) + exactWall({0, 20}, {2, 20}, 0.05);
	Options off = unitOptions();
	off.prune = false;
	const RidgeMap with = mapOf(measurements), without = mapOf(measurements, off);
	EXPECT_EQ(with.walls().size(), 1u);
	EXPECT_EQ(without.walls().size(), 2u);
	EXPECT_EQ(firstDifference(with.ridges(), without.ridges()), "");
	Options shorter = unitOptions();
	shorter.pruneLength = 1;
	EXPECT_EQ(mapOf(measurements, shorter).walls().size(), 2u);
}

TEST(Switches, MinCurvatureLeavesOutWhatIsFlat)
{
	// A band with a standard deviation of 5: -lambda1/L is 1/(1 + 25) on its middle line.
	std::vector<Measurement> band;
	for (int k = -60; k <= 60; k++)
	{
		const int n = int(std::lround(20 * std::exp(-0.5 * std::pow(0.25 * k / 5, 2))));
		for (int i = -160; i <= 160; i++) band.insert(band.end(), std::size_t(n), Measurement{0.25 * i, 0.25 * k});
	}
	Options all = unitOptions(), curved = unitOptions();
	all.minCurvature = 0.03;
	curved.minCurvature = 0.05;
	const RidgeMap flat = mapOf(band, all), none = mapOf(band, curved);
	EXPECT_LT(largestGap(flat.walls(), {-30, 0}, {30, 0}), 0.05);
	EXPECT_GT(largestGap(none.walls(), {-30, 0}, {30, 0}), 2);
	EXPECT_EQ(firstDifference(flat.ridges(), none.ridges()), "");
}

}  // namespace ridgemap::test
