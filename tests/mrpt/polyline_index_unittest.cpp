// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ridgemap/polyline_index.h>

#include <cmath>
#include <random>
#include <thread>

using namespace ridgemap;

namespace
{
double distanceToSegment(const Point2& a, const Point2& b, const Point2& p)
{
	const double ux = b.x - a.x, uy = b.y - a.y, l = ux * ux + uy * uy;
	double t = l > 0 ? ((p.x - a.x) * ux + (p.y - a.y) * uy) / l : 0;
	t = std::min(1.0, std::max(0.0, t));
	return std::hypot(p.x - a.x - t * ux, p.y - a.y - t * uy);
}

/** Oracle: the least distance over all segments. */
double exhaustiveDistance(const std::vector<Polyline>& polylines, const Point2& p)
{
	double best = std::numeric_limits<double>::infinity();
	for (const auto& polyline : polylines)
		for (std::size_t i = 1; i < polyline.points.size(); i++)
			best = std::min(best, distanceToSegment(polyline.points[i - 1], polyline.points[i], p));
	return best;
}

std::vector<Polyline> randomPolylines(std::mt19937& random, const Point2& centre, double size)
{
	std::uniform_real_distribution<double> unit(-1, 1);
	std::uniform_int_distribution<int> count(1, 12), nodes(2, 15);
	std::vector<Polyline> all(std::size_t(count(random)));
	for (auto& polyline : all)
	{
		Point2 p{centre.x + size * unit(random), centre.y + size * unit(random)};
		for (int n = nodes(random); n > 0; n--)
		{
			polyline.points.push_back(p);
			const double step = size * std::pow(10.0, 2 * unit(random) - 2);
			p = {p.x + step * unit(random), p.y + step * unit(random)};
		}
	}
	return all;
}
}  // namespace

TEST(PolylineIndex, AgreesWithExhaustiveSearch)
{
	std::mt19937 random(20240501);
	std::uniform_real_distribution<double> unit(-1, 1);
	const Point2 centres[] = {{0, 0}, {9e5, -8e5}};
	for (int scene = 0; scene < 200; scene++)
	{
		const double size = std::pow(10.0, 2 * unit(random) + 1);
		const Point2 centre = centres[scene % 2];
		const auto polylines = randomPolylines(random, centre, size);
		const double spacing = size * std::pow(10.0, unit(random) - 1.5);
		const PolylineIndex index(polylines, spacing);
		for (int i = 0; i < 100; i++)
		{
			const double reach = size * std::pow(10.0, i % 10 - 5.0);
			const Point2 q{centre.x + reach * unit(random), centre.y + reach * unit(random)};
			const double expected = exhaustiveDistance(polylines, q);
			const auto found = index.nearest(q);
			ASSERT_TRUE(found);
			const double tolerance = 1e-12 * (std::abs(q.x) + std::abs(q.y) + size);
			ASSERT_NEAR(found->distance, expected, tolerance) << "scene " << scene << " query " << i;
			const auto& points = polylines.at(found->polyline).points;
			ASSERT_LT(found->segment + 1, points.size());
			EXPECT_NEAR(distanceToSegment(points[found->segment], points[found->segment + 1], q), expected, tolerance);
			EXPECT_NEAR(distanceToSegment(points[found->segment], points[found->segment + 1], found->point), 0,
						tolerance);
			ASSERT_LT(found->sample, index.samples().size());
			const Point2& s = index.samples()[found->sample];
			EXPECT_LE(std::hypot(s.x - found->point.x, s.y - found->point.y), spacing / 2 + tolerance);
		}
	}
}

TEST(PolylineIndex, HonoursTheGreatestDistance)
{
	std::mt19937 random(7);
	std::uniform_real_distribution<double> unit(-1, 1);
	const auto polylines = randomPolylines(random, {0, 0}, 10);
	const PolylineIndex index(polylines, 0.5);
	int found = 0;
	for (int i = 0; i < 2000; i++)
	{
		const Point2 q{15 * unit(random), 15 * unit(random)};
		const double limit = 5 * std::abs(unit(random)), expected = exhaustiveDistance(polylines, q);
		if (std::abs(expected - limit) < 1e-9) continue;
		ASSERT_EQ(index.nearest(q, limit).has_value(), expected < limit);
		found += expected < limit;
	}
	EXPECT_GT(found, 100);
	EXPECT_LT(found, 1900);
}

TEST(PolylineIndex, FindsTheNearestLineThatCanBeSeen)
{
	std::mt19937 random(11);
	std::uniform_real_distribution<double> unit(-1, 1);
	auto polylines = randomPolylines(random, {0, 0}, 10);
	for (std::size_t i = 0; i < polylines.size(); i++) polylines[i].side = int(i % 3) - 1;
	const PolylineIndex index(polylines, 0.5);
	int hidden = 0;
	for (int i = 0; i < 2000; i++)
	{
		const Point2 q{12 * unit(random), 12 * unit(random)}, from{12 * unit(random), 12 * unit(random)};
		const double limit = i % 10 == 0 ? 1e3 : 6 * std::abs(unit(random));
		double expected = limit;
		for (const auto& p : polylines)
			for (std::size_t k = 1; k < p.points.size(); k++)
			{
				const Point2 &a = p.points[k - 1], &b = p.points[k];
				const double angle = std::atan2(b.y - a.y, b.x - a.x) - std::atan2(from.y - a.y, from.x - a.x);
				if (p.side * std::sin(-angle) < -0.17) continue;
				expected = std::min(expected, distanceToSegment(a, b, q));
			}
		const auto found = index.visibleFoot(q, from, limit);
		ASSERT_EQ(found.has_value(), expected < limit) << i;
		if (found)
		{
			EXPECT_NEAR(std::sqrt(found->distanceSqr), expected, 1e-9) << i;
		}
		const auto any = index.foot(q, limit);
		hidden += any && (!found || found->segment != any->segment);
	}
	EXPECT_GT(hidden, 200);
	EXPECT_LT(hidden, 1800);
}

TEST(PolylineIndex, QueriesWithoutAnAnswer)
{
	const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
	EXPECT_FALSE(PolylineIndex({}, 1).nearest({0, 0}));
	Polyline one;
	one.points = {{0, 0}, {1, 0}};
	const PolylineIndex index({one}, 0.1);
	for (const Point2& q : {Point2{nan, 0}, Point2{0, nan}, Point2{inf, 0}, Point2{0, -inf}})
		EXPECT_FALSE(index.nearest(q));
	EXPECT_FALSE(index.nearest({0, 0}, nan));
	EXPECT_FALSE(index.nearest({0, 0}, -1));
	EXPECT_TRUE(index.nearest({0.5, 0}, 0));
	EXPECT_ANY_THROW(PolylineIndex({one}, 0));
}

TEST(PolylineIndex, FarQueriesAreStillExact)
{
	Polyline one;
	one.points = {{0, 0}, {1, 0}, {1, 1}};
	const PolylineIndex index({one}, 0.1);
	for (const double far : {1e8, 1e16, 1e20, 1e100})
	{
		const auto found = index.nearest({far, 0.25});
		ASSERT_TRUE(found) << far;
		EXPECT_EQ(found->point.x, 1) << far;
		EXPECT_NEAR(found->distance / far, 1, 1e-7);
	}
}

TEST(PolylineIndex, DegenerateSegmentsAndEqualDistances)
{
	Polyline point, line;
	point.points = {{0, 0}, {0, 0}};
	line.points = {{-1, 1}, {0, 1}, {1, 1}};
	const PolylineIndex index({point, line}, 0.3);
	EXPECT_EQ(index.nearest({0.1, -0.1})->polyline, 0u);
	EXPECT_EQ(index.nearest({0, 2})->segment, 0u) << "the first of two segments that share the foot";
	EXPECT_EQ(index.nearest({0, 2})->distance, 1);
}

TEST(PolylineIndex, ManyQueriesAtOnceGiveTheSameDistances)
{
	std::mt19937 random(11);
	std::uniform_real_distribution<double> unit(-1, 1);
	const auto polylines = randomPolylines(random, {3, -2}, 10);
	const PolylineIndex one(polylines, 0.2), many(polylines, 0.2);
	std::vector<Point2> queries{{std::nan(""), 0}, {1e9, 1e9}};
	for (int i = 0; i < 1000; i++) queries.push_back({3 + 30 * unit(random), -2 + 30 * unit(random)});
	std::vector<double> squares;
	many.distancesSqr(queries, 5, squares);
	ASSERT_EQ(squares.size(), queries.size());
	for (std::size_t i = 0; i < queries.size(); i++)
	{
		EXPECT_DOUBLE_EQ(std::sqrt(squares[i]), one.distance(queries[i], 5));
		if (i > 1)
		{
			EXPECT_NEAR(std::sqrt(squares[i]), std::min(5.0, exhaustiveDistance(polylines, queries[i])), 1e-9);
		}
	}
	PolylineIndex({}, 1).distancesSqr(queries, 5, squares);
	EXPECT_EQ(squares, std::vector<double>(queries.size(), 25));
}

TEST(PolylineIndex, ThreadsShareOneIndex)
{
	std::mt19937 random(12);
	const auto polylines = randomPolylines(random, {0, 0}, 10);
	const PolylineIndex index(polylines, 0.2);
	std::vector<std::vector<double>> found(4);
	std::vector<std::thread> threads;
	for (auto& distances : found)
		threads.emplace_back(
			[&]
			{
				std::mt19937 same(13);
				std::uniform_real_distribution<double> place(-15, 15);
				for (int i = 0; i < 3000; i++)
				{
					const double x = place(same), y = place(same);
					distances.push_back(index.distance({x, y}, 100));
				}
			});
	for (auto& t : threads) t.join();
	for (const auto& distances : found) EXPECT_EQ(distances, found[0]);
	std::mt19937 same(13);
	std::uniform_real_distribution<double> place(-15, 15);
	for (const double d : found[0])
	{
		const double x = place(same), y = place(same);
		ASSERT_NEAR(d, exhaustiveDistance(polylines, {x, y}), 1e-9);
	}
}
