// SPDX-License-Identifier: BSD-3-Clause
// Straight and circular runs of walls, against the surfaces that the measurements were made from.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <cmath>

#include "bend.h"
#include "run_fit.h"
#include "runs.h"
#include "scenes.h"
#include "wall_path.h"
#include "walls.h"

using namespace ridgemap;
using namespace ridgemap::test;

namespace
{
constexpr double noise = 0.35;  ///< in x and in y [sigma]

RidgeMap mapOf(const std::vector<Measurement>& m, bool straighten = true)
{
	Options o;
	o.sigma = 1;
	o.straighten = straighten;
	RidgeMap map(o);
	map.insert(m);
	return map;
}

/** Root mean square of a function of the place over all walls, by their lengths. */
template <class Distance>
double rms(const std::vector<Polyline>& walls, Distance distance)
{
	double sum = 0, length = 0;
	for (const Polyline& w : walls)
		for (std::size_t k = 1; k < w.points.size(); k++)
		{
			const Point2 a = w.points[k - 1], b = w.points[k];
			const double l = std::hypot(b.x - a.x, b.y - a.y);
			const int n = std::max(1, int(l / 0.1));
			for (int i = 0; i < n; i++)
			{
				const double t = (i + 0.5) / n, d = distance(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
				sum += l / n * d * d;
				length += l / n;
			}
		}
	return std::sqrt(sum / length);
}

bool has(const Polyline& wall, WallShape shape)
{
	return std::any_of(wall.info.begin(), wall.info.end(), [&](const VertexInfo& v) { return v.shape == shape; });
}
}  // namespace

TEST(RunFit, RecoversExactCirclesAndLines)
{
	for (const double radius : {0.7, 3.0, 100.0, 1e4})
		for (const double span : {0.3, 1.0, 4.0})
			for (const int turn : {1, -1})
			{
				if (radius * span > 400) continue;
				std::vector<WallSample> samples;
				for (int i = 0; i < 40; i++)
				{
					const double a = turn * span * i / 39.0;
					samples.push_back({{5 + radius * std::cos(a), -2 + radius * std::sin(a)}, 0, 0.5 + 0.01 * i});
				}
				const auto arc = fitArc({samples.data(), samples.data() + samples.size()});
				ASSERT_TRUE(arc);
				EXPECT_NEAR(arc->curvature * radius, turn, 1e-6) << radius << " " << span;
				EXPECT_NEAR(std::hypot(arc->centre().x - 5, arc->centre().y + 2), 0, 1e-6 * radius);
				for (const WallSample& s : samples) EXPECT_NEAR(arc->distance(s.p), 0, 1e-7 * radius);
				// A point beside the circle: distance and foot in closed form.
				const Vec2 q{5 + 0.8 * radius, -2 + 0.1 * radius};
				EXPECT_NEAR(arc->distance(q), turn * (radius - norm(q - Vec2{5, -2})), 1e-6 * radius);
				EXPECT_NEAR(norm(arc->project(q) - Vec2{5, -2}), radius, 1e-6 * radius);
			}
	std::vector<WallSample> line;
	for (int i = 0; i < 20; i++) line.push_back({{1.0 + i, 3.0 - 2 * i}, 0, 1});
	const FittedCurve fit = fitStraight({line.data(), line.data() + line.size()});
	EXPECT_NEAR(fit.distance({1, 3}), 0, 1e-12);
	EXPECT_NEAR(fit.distance(Vec2{1, 3} + leftNormal(fit.direction)), 1, 1e-12);
}

TEST(RunFit, CovarianceIsThatOfRepeatedFits)
{
	// 400 fits to an arc with independent noise: their spread is the covariance, within its own sampling error.
	constexpr int repeats = 400;
	Random random(5);
	double offset2 = 0, curvature2 = 0, offsetVariance = 0, curvatureVariance = 0;
	for (int r = 0; r < repeats; r++)
	{
		std::vector<WallSample> samples;
		for (int i = 0; i < 60; i++)
		{
			const double a = 0.02 * i, radius = 10 + 0.05 * random.normal();
			samples.push_back({{radius * std::cos(a), radius * std::sin(a)}, 0, 0.05 * 0.05});
		}
		const auto arc = fitArc({samples.data(), samples.data() + samples.size()});
		ASSERT_TRUE(arc);
		const Vec2 middle{10 * std::cos(0.59), 10 * std::sin(0.59)};
		offset2 += arc->distance(middle) * arc->distance(middle) / repeats;
		offsetVariance += arc->variance(middle) / repeats;
		curvature2 += (arc->curvature - 0.1) * (arc->curvature - 0.1) / repeats;
		curvatureVariance += arc->covariance[5] / repeats;
	}
	EXPECT_NEAR(offset2 / offsetVariance, 1, 0.25);
	EXPECT_NEAR(curvature2 / curvatureVariance, 1, 0.25);
}

TEST(Straighten, AStraightWallIsOneSegmentWithinItsErrors)
{
	double ridge = 0, wall = 0, normalised = 0;
	const int n = 30;
	for (int seed = 1; seed <= n; seed++)
	{
		const auto m = SceneBuilder(std::uint64_t(seed), 1, noise, 60).wall({-30, 0}, {30, 0}).finish();
		const RidgeMap map = mapOf(m);
		ASSERT_EQ(map.walls().size(), 1u);
		const Polyline& w = map.walls()[0];
		ASSERT_EQ(w.points.size(), 2u) << "seed " << seed;
		EXPECT_EQ(w.info[0].shape, WallShape::line);
		EXPECT_EQ(w.info[0].origin, VertexOrigin::end);
		EXPECT_NEAR(w.noise, noise, 0.1 * noise);
		EXPECT_TRUE(w.noiseSupported);
		const auto offset = [](double, double y) { return y; };
		ridge += rms(map.ridges(), offset) / n;
		wall += rms({w}, offset) / n;
		for (const std::size_t k : {0, 1})
			normalised += std::pow(w.points[k].y / double(w.info[k].standardError), 2) / (2 * n);
	}
	EXPECT_LT(wall, ridge / 2.5);
	// The declared standard errors are those that are seen.
	EXPECT_GT(std::sqrt(normalised), 0.6);
	EXPECT_LT(std::sqrt(normalised), 1.4);
}

TEST(Straighten, ArcsStayArcs)
{
	for (const double radius : {20.0, 60.0, 125.0})
	{
		const double span = std::min(2.5, 150 / radius);
		const auto m = SceneBuilder(3, 1, noise, 80).arc({0, 0}, radius, 0, span).finish();
		const RidgeMap map = mapOf(m);
		ASSERT_EQ(map.walls().size(), 1u);
		EXPECT_TRUE(has(map.walls()[0], WallShape::arc)) << radius;
		EXPECT_FALSE(has(map.walls()[0], WallShape::line)) << radius;
		const auto offset = [&](double x, double y) { return std::hypot(x, y) - radius; };
		// A ridge of a circle lies inside by about sigma^2/(2 r); what is left are its chances.
		EXPECT_LT(rms(map.walls(), offset), 0.5 / radius + 0.03) << radius;
	}
	const auto ring = SceneBuilder(4, 1, noise, 80).circle({2, 1}, 8).finish();
	const RidgeMap map = mapOf(ring);
	ASSERT_EQ(map.walls().size(), 1u);
	EXPECT_TRUE(map.walls()[0].closed);
	EXPECT_EQ(map.walls()[0].points.front(), map.walls()[0].points.back());
	EXPECT_TRUE(has(map.walls()[0], WallShape::arc));
	EXPECT_LT(rms(map.walls(), [](double x, double y) { return std::hypot(x - 2, y - 1) - 8; }), 0.1);
}

TEST(Straighten, WigglesThatNoChanceExplainsStay)
{
	// A wave of 0.3 sigma over 40 sigma, far above the standard error of 0.03 sigma.
	Random random(8);
	std::vector<Measurement> m;
	for (int i = 0; i < 9000; i++)
	{
		const double x = random.uniform(0, 100);
		m.push_back({x + noise * random.normal(), 0.3 * std::sin(2 * M_PI * x / 40) + noise * random.normal()});
	}
	const auto offset = [](double x, double y) { return y - 0.3 * std::sin(2 * M_PI * x / 40); };
	EXPECT_LT(rms(mapOf(m).walls(), offset), 0.06);
}

TEST(Straighten, DoorsStayOpenAndCornersSharp)
{
	const auto doors = SceneBuilder(9, 1, noise, 60).wall({0, 0}, {40, 0}).wall({58, 0}, {100, 0}).finish();
	const RidgeMap open = mapOf(doors);
	ASSERT_EQ(open.walls().size(), 2u);
	for (const Polyline& w : open.walls())
		for (const Point2& p : w.points) EXPECT_TRUE(p.x < 40.8 || p.x > 57.2) << p.x;

	for (const double turn : {0.0, 0.3, 1.1})
	{
		const auto square = SceneBuilder(7, 1, noise, 60)
								.wall({-20, -20}, {20, -20})
								.wall({20, -20}, {20, 20})
								.wall({20, 20}, {-20, 20})
								.wall({-20, 20}, {-20, -20})
								.finish({}, turn);
		const RidgeMap map = mapOf(square);
		ASSERT_EQ(map.walls().size(), 1u);
		ASSERT_EQ(map.walls()[0].points.size(), 5u) << turn;
		for (std::size_t k = 0; k < 4; k++)
		{
			const Point2 p = map.walls()[0].points[k];
			const double x = p.x * std::cos(turn) + p.y * std::sin(turn),
						 y = p.y * std::cos(turn) - p.x * std::sin(turn);
			EXPECT_NEAR(std::abs(x), 20, 0.1);
			EXPECT_NEAR(std::abs(y), 20, 0.1);
			EXPECT_EQ(map.walls()[0].info[k].origin, VertexOrigin::corner);
		}
	}
}

TEST(Straighten, NoiseIsToldWhereTheWallSupportsIt)
{
	// A wall with the same noise all along does; one with three kinds of noise, or one of four vertices, does not.
	for (int seed = 1; seed <= 5; seed++)
	{
		const RidgeMap straight = mapOf(SceneBuilder(std::uint64_t(seed), 1, noise, 60).wall({0, 0}, {40, 0}).finish());
		ASSERT_EQ(straight.walls().size(), 1u);
		EXPECT_TRUE(straight.walls()[0].noiseSupported);
		EXPECT_NEAR(straight.walls()[0].noise, noise, 0.15 * noise);

		Random random{std::uint64_t(seed)};
		std::vector<Measurement> fan;  // a wall whose noise is 0.1, 0.5 and 1.3 sigma on a third of it each
		for (int i = 0; i < 12000; i++)
		{
			const double x = random.uniform(0, 60);
			fan.push_back({x, (x < 20 ? 0.1 : x < 40 ? 0.5 : 1.3) * random.normal()});
		}
		const RidgeMap spread = mapOf(fan);
		ASSERT_GE(spread.walls().size(), 1u);
		EXPECT_FALSE(spread.walls()[0].noiseSupported) << "seed " << seed << ", noise " << spread.walls()[0].noise;
	}
	Polyline few;
	for (int i = 0; i < 4; i++)
	{
		few.points.push_back({double(i), 0});
		few.info.push_back({100, 0.9f, 0.01f, {}, {}});
	}
	EXPECT_FALSE(wallNoise(few, 1).supported);
	few.points.push_back({4, 0});
	few.info.push_back({100, 0.9f, 0.01f, {}, {}});
	EXPECT_TRUE(wallNoise(few, 1).supported);
	EXPECT_NEAR(wallNoise(few, 1).noise, 1.0 / 3, 1e-6);
}

TEST(Straighten, CanBeSwitchedOff)
{
	const auto m = SceneBuilder(3, 1, noise, 60).wall({30, 0}, {0, 0}).wall({0, 0}, {0, 30}).finish();
	EXPECT_GT(mapOf(m, false).walls()[0].points.size(), 10u);
	EXPECT_EQ(mapOf(m, true).walls()[0].points.size(), 3u);
}

TEST(CorrectBends, BesselRatioIsThatOfTheIntegrals)
{
	// I_n(z) = 1/pi integral of exp(z cos t) cos(n t) over 0..pi: the mean over evenly spaced angles converges faster
	// than any power.
	for (const double z : {1e-3, 0.5, 2.0, 9.0, 60.0, 399.0, 401.0, 5000.0})
	{
		double i0 = 0, i1 = 0;
		for (int k = 0; k < 4000; k++)
		{
			const double c = std::cos(2 * M_PI * k / 4000), e = std::exp(z * (c - 1));
			i0 += e;
			i1 += e * c;
		}
		EXPECT_NEAR(besselRatio(z), i1 / i0, 1e-11) << z;
	}
}

TEST(CorrectBends, TrueRadiusIsWhereTheRidgeOfTheCircleIs)
{
	// The ridge of a circle of radius r, found as the maximum of its density along a radius.
	const double sigma = 0.07;
	for (const double r : {2.0, 3.0, 6.0, 20.0})
	{
		double best = 0, at = 0;
		for (double R = 0.5 * r; R < r; R += 1e-4)
		{
			double sum = 0;
			for (int k = 0; k < 720; k++)
			{
				const double c = std::cos(2 * M_PI * k / 720);
				sum += std::exp(-0.5 * (R * R + r * r - 2 * R * r * c));
			}
			if (sum > best) best = sum, at = R;
		}
		EXPECT_NEAR(trueRadius(at * sigma, sigma), r * sigma, 4e-4 * sigma) << r;
	}
}

TEST(CorrectBends, RingsComeOutWithTheirRadius)
{
	for (const double radius : {3.0, 5.0, 8.0, 15.0})
		for (const bool straighten : {true, false})
		{
			double corrected = 0, plain = 0;
			const int n = 6;
			for (int seed = 1; seed <= n; seed++)
			{
				const auto m = SceneBuilder(std::uint64_t(seed), 1, 0.2, 120).circle({0, 0}, radius).finish();
				for (const bool correct : {true, false})
				{
					Options o;
					o.sigma = 1;
					o.straighten = straighten;
					o.correctBends = correct;
					RidgeMap map(o);
					map.insert(m);
					for (const Polyline& w : map.walls()) (correct ? corrected : plain) += w.length() / (2 * M_PI * n);
				}
			}
			EXPECT_NEAR(corrected, radius, 0.04) << radius << " straighten " << straighten;
			EXPECT_LT(plain, radius - 0.4 / radius) << radius;
		}
}

TEST(CorrectBends, MovesVerticesOfRidgesOnly)
{
	Options o;
	o.sigma = 1;
	o.straighten = o.correctBends = false;
	RidgeMap map(o);
	map.insert(SceneBuilder(7, 1, 0.2, 120).circle({0, 0}, 5).finish());
	ASSERT_EQ(map.walls().size(), 1u);
	Polyline ring = map.walls()[0];
	ASSERT_TRUE(ring.closed);
	ASSERT_GT(ring.points.size(), 12u);
	// What other passes have made, or drawn as a line, lies on the surface already.
	for (std::size_t k = 1; k + 1 < ring.points.size(); k++)
	{
		if (k % 3 == 1) ring.info[k].origin = VertexOrigin::junction;
		if (k % 3 == 2) ring.info[k].shape = WallShape::line;
	}
	const Polyline moved = correctBends(ring, o);
	for (std::size_t k = 1; k + 1 < ring.points.size(); k++)
	{
		const Point2 &p = ring.points[k], &q = moved.points[k];
		const double outward = std::hypot(q.x, q.y) - std::hypot(p.x, p.y);
		if (k % 3 == 0)
			EXPECT_NEAR(outward, trueRadius(std::hypot(p.x, p.y), 1) - std::hypot(p.x, p.y), 0.05) << k;
		else
			EXPECT_TRUE(p == q) << k;
	}
}

TEST(Straighten, ErrorsThatNoiseDoesNotExplainAreSeen)
{
	// Waves of 8 samples about a line, an arc and a step between two lines: a parabola takes none of them up, so the
	// mean square of what is left is half the square of the amplitude. The step is in few windows only.
	const double amplitude = 0.03, declared = 0.004;
	for (const double curvature : {0.0, 0.01})
		for (const double step : {0.0, 2.0})
		{
			std::vector<WallSample> samples;
			for (int i = 0; i < 2000; i++)
			{
				const double x = 0.25 * i, y = 0.5 * curvature * (x - 250) * (x - 250) * 0.1 + (i > 990 ? step : 0);
				samples.push_back({{x, y + amplitude * std::sin(2 * M_PI * i / 8.0)}, x, declared * declared});
			}
			EXPECT_NEAR(excessError(samples), amplitude / declared / std::sqrt(2 * 0.3), 0.4)
				<< curvature << " " << step;
			for (WallSample& s : samples) s.variance = amplitude * amplitude;
			EXPECT_LT(excessError(samples), 1.3);
		}
	EXPECT_EQ(excessError({}), 1);
	// Walls whose only error is noise: none is seen.
	for (int seed = 1; seed <= 5; seed++)
	{
		const RidgeMap map = mapOf(SceneBuilder(std::uint64_t(seed), 1, noise, 60).wall({0, 0}, {200, 0}).finish());
		ASSERT_EQ(map.walls().size(), 1u);
		EXPECT_LT(double(map.walls()[0].info[0].standardError), 0.05);
	}
}

TEST(Straighten, AWallSeenFromWrongPosesIsStillOneSegment)
{
	// Sixty scans, each shifted across by 0.15 sigma (one standard deviation) and seeing a stretch of 25 sigma: the
	// ridge wanders by far more than the noise of 400 measurements a sigma explains.
	Random random(17);
	std::vector<Measurement> m;
	for (int scan = 0; scan < 60; scan++)
	{
		const double shift = 0.15 * random.normal(), from = random.uniform(-25, 100);
		for (int i = 0; i < 2500; i++)
		{
			const double x = from + 25 * random.uniform();
			if (x > 0 && x < 100) m.push_back({x + noise * random.normal(), shift + noise * random.normal()});
		}
	}
	const RidgeMap map = mapOf(m);
	ASSERT_EQ(map.walls().size(), 1u);
	EXPECT_LE(map.walls()[0].points.size(), 12u);
	EXPECT_LT(rms(map.walls(), [](double, double y) { return y; }), 0.1);
}
