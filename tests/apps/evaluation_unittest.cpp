// SPDX-License-Identifier: BSD-3-Clause
// The measures of ridgemap-eval against dense sampling and closed forms.
#include <gtest/gtest.h>

#include "../../apps/common/evaluation.h"
#include "../../apps/common/intervals.h"
#include "../../apps/common/random.h"

namespace ridgemap::test
{
namespace
{
using namespace ridgemap::apps;

Point2 anyPoint(Random& random)
{
	const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
	return {x, y};
}

/** Oracle: midpoint rule. */
DistanceSum sampled(const Point2& a, const Point2& b, const std::vector<Segment>& truth, int samples)
{
	const Segment s{a, b};
	DistanceSum sum;
	sum.length = s.length();
	for (int i = 0; i <= samples; i++)
	{
		const auto distance = [&](double t)
		{
			double d = 1e9;
			for (const Segment& q : truth) d = std::min(d, q.distance(s.at(t)));
			return d;
		};
		sum.maximum = std::max(sum.maximum, distance(double(i) / samples));
		if (i < samples) sum.squareIntegral += std::pow(distance((i + 0.5) / samples), 2) * sum.length / samples;
	}
	return sum;
}

Polyline polyline(std::vector<Point2> points)
{
	Polyline p;
	p.info.resize(points.size());
	p.points = std::move(points);
	return p;
}

}  // namespace

TEST(DistanceIntegral, equalsDenseSampling)
{
	Random random(3);
	for (int round = 0; round < 300; round++)
	{
		std::vector<Segment> truth;
		for (std::size_t n = 1 + random.below(12); n > 0; n--) truth.push_back({anyPoint(random), anyPoint(random)});
		if (random.chance(0.2)) truth.push_back({truth[0].b, truth[0].b});  // a point
		const Point2 a = anyPoint(random), b = anyPoint(random);
		const DistanceSum exact = integrateDistance(a, b, truth), oracle = sampled(a, b, truth, 4000);
		EXPECT_NEAR(exact.squareIntegral, oracle.squareIntegral, 1e-7) << round;
		EXPECT_NEAR(exact.maximum, oracle.maximum, 1e-3) << round;
		EXPECT_GE(exact.maximum, oracle.maximum - 1e-12) << round;
	}
}

TEST(DistanceIntegral, closedForms)
{
	const std::vector<Segment> wall{{{0, 0}, {10, 0}}};
	const DistanceSum parallel = integrateDistance({1, 0.3}, {4, 0.3}, wall);
	EXPECT_DOUBLE_EQ(parallel.length, 3);
	EXPECT_NEAR(parallel.rmsd(), 0.3, 1e-15);
	const DistanceSum slanted = integrateDistance({1, 0}, {4, 3}, wall);  // d = y, uniform from 0 to 3
	EXPECT_NEAR(slanted.rmsd(), std::sqrt(3.0), 1e-14);
	EXPECT_DOUBLE_EQ(slanted.maximum, 3);
	EXPECT_EQ(integrateDistance({2, 0}, {3, 0}, wall).rmsd(), 0);
	EXPECT_EQ(integrateDistance({2, 5}, {2, 5}, wall).length, 0);
	// Between two parallel walls the nearer one changes in the middle.
	const std::vector<Segment> two{{{0, 0}, {10, 0}}, {{0, 2}, {10, 2}}};
	EXPECT_NEAR(integrateDistance({5, 0}, {5, 2}, two).rmsd(), std::sqrt(1.0 / 3), 1e-14);
}

TEST(Intervals, nearSegmentEqualsSampling)
{
	Random random(5);
	for (int round = 0; round < 500; round++)
	{
		const Segment s{anyPoint(random), anyPoint(random)}, other{anyPoint(random), anyPoint(random)};
		const double distance = random.uniform(0.01, 0.5);
		const auto i = nearSegment(s, other, distance);
		for (int k = 0; k <= 200; k++)
		{
			const double t = k / 200.0, d = other.distance(s.at(t));
			if (std::abs(d - distance) < 1e-9) continue;
			EXPECT_EQ(d < distance, i && t >= i->from && t <= i->to) << round << " " << t;
		}
	}
}

TEST(Intervals, sets)
{
	const IntervalSet a = unite({{0.5, 0.7}, {0, 0.2}, {0.1, 0.3}}), b = unite({{0.25, 0.6}});
	ASSERT_EQ(a.size(), 2u);
	EXPECT_NEAR(sizeOf(a), 0.5, 1e-15);
	EXPECT_NEAR(sizeOf(intersect(a, b)), 0.15, 1e-15);
	EXPECT_EQ(sizeOf(unite({})), 0);
}

TEST(Evaluation, figuresOfAMap)
{
	const std::vector<Segment> truth{
		{{0, 0}, {10, 0}}, {{10, 0}, {10, 5}}, {{0, 8}, {4, 8}}, {{20, 0}, {21, 0}, false}};
	EvaluationSettings settings;
	settings.within = 0.1;
	settings.cornerRadius = 1;
	const std::vector<Polyline> map{polyline({{0, 0.05}, {6, 0.05}}), polyline({{5, -0.02}, {9.5, -0.02}}),
									polyline({{0, 3}, {0, 4}})};
	const Evaluation e = evaluate(map, truth, settings);
	EXPECT_EQ(e.cornerCount, 1u);
	EXPECT_EQ(e.surfaces, 2u);
	EXPECT_EQ(e.fragments, 2u);
	EXPECT_NEAR(e.all.length, 11.5, 1e-12);
	EXPECT_NEAR(e.truthLength, 19, 1e-12);
	EXPECT_NEAR(e.truthCovered, 9.5 + std::sqrt(0.01 - 0.0004), 1e-12);
	EXPECT_NEAR(e.spurious, 1, 1e-12);
	EXPECT_NEAR(e.right.length, 10.5, 1e-12);
	EXPECT_NEAR(e.right.rmsd(), std::sqrt((6 * 0.05 * 0.05 + 4.5 * 0.02 * 0.02) / 10.5), 1e-12);
	EXPECT_NEAR(e.polylines[2].right.length, 0, 1e-12);
	EXPECT_NEAR(e.duplicates, 1, 1e-12);
	EXPECT_NEAR(e.corners.length, 9.5 - (10 - std::sqrt(1 - 0.0004)), 1e-12);
	EXPECT_NEAR(e.corners.rmsd(), 0.02, 1e-12);
	EXPECT_NEAR(e.polylines[0].distance.rmsd(), 0.05, 1e-12);
	EXPECT_NEAR(e.polylines[2].distance.maximum, 4, 1e-12);
	EXPECT_NEAR(e.corners.length + e.straight.length, e.all.length, 1e-12);
	EXPECT_THROW(evaluate(map, {}, settings), std::invalid_argument);
	EXPECT_EQ(evaluate({}, truth, settings).all.rmsd(), 0);
}

TEST(Evaluation, arcsHaveNoCorners)
{
	std::vector<Segment> arc;
	for (int i = 0; i < 40; i++)
		arc.push_back({{std::cos(i * 0.1), std::sin(i * 0.1)}, {std::cos((i + 1) * 0.1), std::sin((i + 1) * 0.1)}});
	EXPECT_TRUE(cornersOf(arc, 0.35).empty());
}

}  // namespace ridgemap::test
