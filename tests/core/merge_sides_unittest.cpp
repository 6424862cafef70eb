// SPDX-License-Identifier: BSD-3-Clause
// The two faces of thin walls: one line or two, by their thickness on the whole stretch.
#include "merge_sides.h"

#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <cmath>
#include <functional>

#include "free_cut.h"
#include "random.h"

namespace ridgemap::test
{
namespace
{
/** A face at y(x), from one x to the other, seen from above (+1) or below (-1). */
LinePtr face(double from, double to, int seenFrom, const std::function<double(double)>& y, float occupancy = 100)
{
	auto line = std::make_shared<Polyline>();
	const int n = int(std::abs(to - from) / 0.07) + 1;
	for (int i = 0; i <= n; i++)
	{
		const double x = from + (to - from) * i / n;
		line->points.push_back({x, y(x)});
		line->info.push_back(VertexInfo{occupancy, 0.9f, 0.01f, {}, {}});
	}
	line->side = to > from ? seenFrom : -seenFrom;
	return line;
}

double lengthOf(const Lines& lines)
{
	double sum = 0;
	for (const LinePtr& l : lines) sum += l->length();
	return sum;
}
}  // namespace

TEST(MergeSides, DecideByTheMeanThickness)
{
	Options o;
	o.sigma = 0.05;
	o.mergeDistance = 0.7;
	// The thickness waves by 0.3 sigma, across the limit at each of these means; poses that are off make it negative.
	for (const double thickness : {-0.6, -0.2, 0.0, 0.3, 0.5, 0.6, 0.8, 0.9, 1.2})
		for (const bool backwards : {false, true})
			for (const bool shorterFirst : {false, true})
			{
				const auto upper = [&](double x) { return o.sigma * (thickness + 0.3 * std::sin(9 * x)); };
				Lines lines{face(0, 3, 1, upper), face(0.5, 2.5, -1, [](double) { return 0.0; })};
				if (backwards) lines[1] = face(2.5, 0.5, -1, [](double) { return 0.0; });
				if (shorterFirst) std::swap(lines[0], lines[1]);
				const Lines merged = SideMerger(o).merge(lines);
				ASSERT_EQ(merged.size(), thickness < 0.7 ? 1u : 2u) << thickness;
				if (merged.size() == 2) continue;
				// In the middle where there were two, at the face where there was one.
				for (const Point2& p : merged[0]->points)
				{
					const double off = std::abs(p.x - 1.5);
					EXPECT_TRUE(off > 0.95 || std::abs(p.y - upper(p.x) / 2) < 0.08 * o.sigma) << p.x << " " << p.y;
					EXPECT_TRUE(off < 1.05 || p.y == upper(p.x)) << p.x << " " << p.y;
				}
			}
}

TEST(MergeSides, WeighByTheDensities)
{
	Options o;
	o.sigma = 0.1;
	const Lines merged = SideMerger(o).merge({face(
												  0, 3, 1, [](double) { return 0.03; }, 300),
											  face(
												  0.5, 2.5, -1, [](double) { return 0.0; }, 100)});
	ASSERT_EQ(merged.size(), 1u);
	for (const Point2& p : merged[0]->points)
	{
		const double off = std::abs(p.x - 1.5), expected = off < 1 ? 0.75 * 0.03 : 0.03;
		EXPECT_TRUE(std::abs(off - 1) < 0.03 || std::abs(p.y - expected) < 1e-12) << p.x << " " << p.y;
	}
}

TEST(MergeSides, OnlyFacesThatLookAwayFromEachOther)
{
	Options o;
	o.sigma = 0.05;
	const auto at = [](double y) { return [y](double) { return y; }; };
	// Seen from the same side; from a side that is not known; across each other.
	EXPECT_EQ(SideMerger(o).merge({face(0, 3, 1, at(0)), face(1, 2, 1, at(0.01))}).size(), 2u);
	auto unknown = std::make_shared<Polyline>(*face(1, 2, -1, at(0.01)));
	unknown->side = 0;
	EXPECT_EQ(SideMerger(o).merge({face(0, 3, 1, at(0)), unknown}).size(), 2u);
	EXPECT_EQ(SideMerger(o).merge({face(0, 3, 1, at(0)), face(1, 2, -1, [](double x) { return x - 1.5; })}).size(), 2u);
	o.mergeDistance = 0;
	EXPECT_EQ(SideMerger(o).merge({face(0, 3, 1, at(0)), face(1, 2, -1, at(0))}).size(), 2u);
}

TEST(MergeSides, TheRestOfTheShorterFaceStays)
{
	Options o;
	o.sigma = 0.05;
	// The lower face leaves the upper one at x = 2.
	const auto lower = [](double x) { return x < 2 ? 0 : -0.5 * (x - 2); };
	const Lines merged = SideMerger(o).merge({face(-2, 2.5, 1, [](double) { return 0.01; }), face(0, 4, -1, lower)});
	ASSERT_EQ(merged.size(), 2u);
	EXPECT_NEAR(merged[1]->points.front().x, 2.1, 0.12);
	EXPECT_EQ(merged[1]->startReason, StopReason::hitPolyline);
	EXPECT_EQ(merged[1]->side, -1);
	EXPECT_NEAR(lengthOf(merged), 4.5 + 1.9 * std::sqrt(1.25), 0.2);
}

TEST(MergeSides, FacesThatFreeSpaceCutKnowTheirSides)
{
	// Rays pass through one end of a wall without thickness; the rest has still two faces that are one wall.
	Random random(5);
	std::vector<Measurement> all;
	for (int i = 0; i < 6000; i++)
	{
		const double x = random.uniform(0, 4), y = 0.01 * random.normal(), from = random.chance(0.5) ? 2 : -2;
		if (x < 3) all.push_back({x, y, x + random.uniform(-1, 1), from});
		if (x > 3 && i % 4 == 0) all.push_back({x, y, x + random.uniform(-0.3, 0.3), from});
		if (x > 3) all.push_back({x, -from, x, from});
	}
	RidgeMap map;
	map.insert(all);
	double inside = 0;
	for (const Polyline& w : map.walls())
		for (std::size_t k = 1; k < w.points.size(); k++)
		{
			const Point2 &a = w.points[k - 1], &b = w.points[k];
			EXPECT_FALSE(std::abs(a.y) < 0.5 && std::max(a.x, b.x) > 3.2) << "rays pass there";
			if (std::abs(a.y) < 0.5) inside += std::hypot(b.x - a.x, b.y - a.y);
		}
	EXPECT_NEAR(inside, 3, 0.15) << "one wall, not two";
}

}  // namespace ridgemap::test
