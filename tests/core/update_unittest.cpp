// SPDX-License-Identifier: BSD-3-Clause
// Updates: what they report, how much they do, and that queries do them when needed.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <set>
#include <tuple>

#include "polylines.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
/** A copy of the ridges of a map, kept up to date by what its updates report only. */
class Replay
{
 public:
	void apply(const RidgeMap& map, const UpdateResult& result)
	{
		for (const PolylineId id : result.vanished)
		{
			EXPECT_EQ(lines_.erase(id), 1u) << "id " << id << " vanished, but was not there";
			EXPECT_THROW(map.ridge(id), std::out_of_range);
		}
		for (const PolylineId id : result.appeared)
		{
			EXPECT_TRUE(everUsed_.insert(id).second) << "id " << id << " is used again";
			lines_.emplace(id, map.ridge(id));
		}
	}

	/** Ids and polylines must be exactly those of the map. */
	void expectSame(const RidgeMap& map) const
	{
		std::vector<Polyline> mine, theirs = map.ridges();
		for (const auto& entry : lines_)
		{
			mine.push_back(entry.second);
			EXPECT_EQ(firstDifference({map.ridge(entry.first)}, {entry.second}), "") << "id " << entry.first;
		}
		const auto before = [](const Polyline& a, const Polyline& b)
		{
			const auto key = [](const Polyline& l) {
				return std::make_tuple(l.points[0].x, l.points[0].y, l.points.back().x, l.points.back().y,
									   l.points.size());
			};
			return key(a) < key(b);
		};
		std::sort(mine.begin(), mine.end(), before);
		std::sort(theirs.begin(), theirs.end(), before);
		EXPECT_EQ(firstDifference(mine, theirs), "");
	}

	std::vector<PolylineId> idsNear(Point2 p, double radius) const
	{
		std::vector<PolylineId> ids;
		for (const auto& [id, line] : lines_)
			for (const Point2& q : line.points)
				if (std::hypot(q.x - p.x, q.y - p.y) < radius)
				{
					ids.push_back(id);
					break;
				}
		return ids;
	}

 private:
	std::map<PolylineId, Polyline> lines_;
	std::set<PolylineId> everUsed_;
};

bool contains(const Box2& b, const Measurement& m)
{
	return m.x >= b.min.x && m.x <= b.max.x && m.y >= b.min.y && m.y <= b.max.y;
}
}  // namespace

TEST(UpdateResult, ReplayingItsIdsReproducesTheMap)
{
	for (std::uint64_t seed = 1; seed <= 8; seed++)
	{
		const RandomScene scene = randomScene(seed, 3);
		Random random(seed);
		std::vector<Measurement> all = scene.measurements, present;
		random.shuffle(all);
		RidgeMap map(scene.options());
		Replay replay;
		while (!all.empty() || !present.empty())
		{
			const bool take = all.empty() || (random.chance(0.3) && !present.empty());
			std::vector<Measurement>& from = take ? present : all;
			const std::size_t n = std::min(from.size(), 1 + random.below(1 + scene.measurements.size() / 5));
			const std::vector<Measurement> batch(from.end() - std::ptrdiff_t(n), from.end());
			from.resize(from.size() - n);
			if (take)
				map.erase(batch);
			else
			{
				map.insert(batch);
				// Part of what is inserted is erased later, the rest at the end.
				present.insert(present.begin(), batch.begin(), batch.end());
			}
			replay.apply(map, map.update());
			replay.expectSame(map);
			ASSERT_FALSE(HasFailure()) << "seed " << seed << ", " << present.size() << " measurements present";
		}
		EXPECT_TRUE(map.ridges().empty());
		EXPECT_EQ(map.statistics().tiles, 0u);
	}
}

TEST(UpdateResult, ReportsWhatClearTookAway)
{
	RidgeMap map;
	map.insert(exactWall({0, 0}, {2, 0}, 0.01));
	Replay replay;
	replay.apply(map, map.update());
	map.clear();
	EXPECT_TRUE(map.empty());
	EXPECT_TRUE(map.ridges().empty());
	RidgeMap again = map;
	again.insert(exactWall({0, 1}, {2, 1}, 0.01));
	replay.apply(again, again.update());
	replay.expectSame(again);
}

TEST(UpdateResult, RegionsHoldTheChanges)
{
	const RandomScene scene = randomScene(11, 2);
	RidgeMap map(scene.options());
	std::vector<Measurement> changes = scene.measurements;
	for (Measurement m : scene.measurements)
	{
		m.x += 500 * scene.sigma;
		changes.push_back(m);
	}
	map.insert(changes);
	const UpdateResult result = map.update();
	EXPECT_GE(result.regions.size(), 2u);
	std::size_t tiles = 0;
	for (const UpdateRegion& region : result.regions) tiles += region.tiles;
	EXPECT_EQ(tiles, result.tiles);
	for (const Measurement& m : changes)
		EXPECT_TRUE(std::any_of(result.regions.begin(), result.regions.end(),
								[&](const UpdateRegion& region) { return contains(region.box, m); }));
	for (const PolylineId id : result.appeared)
		for (const Point2& p : map.ridge(id).points)
			EXPECT_TRUE(std::any_of(result.regions.begin(), result.regions.end(),
									[&](const UpdateRegion& region) {
										return contains(region.box, {p.x, p.y});
									}));
	EXPECT_GT(result.evaluations, 0u);
	EXPECT_GT(result.kernels, 0u);
	EXPECT_GT(result.seeds, 0u);
	std::size_t stops = 0;
	for (const std::size_t n : result.stops) stops += n;
	EXPECT_GT(stops, 0u);
}

TEST(UpdateResult, FarPolylinesKeepTheirIds)
{
	const Options options;
	RidgeMap map(options);
	map.insert(exactWall({0, 0}, {2, 0}, 0.01));
	map.insert(exactWall({50, 0}, {52, 0}, 0.01));
	Replay replay;
	replay.apply(map, map.update());
	const std::vector<PolylineId> far = replay.idsNear({51, 0}, 2);
	ASSERT_EQ(far.size(), 1u);
	map.insert(exactWall({1, 0}, {1, 2}, 0.01));
	const UpdateResult result = map.update();
	EXPECT_EQ(result.regions.size(), 1u);
	EXPECT_FALSE(result.appeared.empty());
	replay.apply(map, result);
	EXPECT_EQ(replay.idsNear({51, 0}, 2), far);
	replay.expectSame(map);
}

TEST(UpdateResult, TellsTheTimesOfItsSteps)
{
	RidgeMap map;
	map.insert(randomScene(3).measurements);
	const auto start = std::chrono::steady_clock::now();
	const UpdateResult r = map.update();
	const double all = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
	double sum = 0;
	for (const double s :
		 {r.seconds.kernels, r.seconds.borders, r.seconds.crossings, r.seconds.seeds, r.seconds.chains})
	{
		EXPECT_GT(s, 0);
		sum += s;
	}
	EXPECT_LE(sum, all);
	UpdateResult twice = r;
	twice += r;
	EXPECT_EQ(twice.seconds.borders, 2 * r.seconds.borders);
	EXPECT_EQ(twice.traces, 2 * r.traces);
}

TEST(UpdateResult, OfNoChangeIsEmpty)
{
	const RandomScene scene = randomScene(12, 2);
	RidgeMap map(scene.options());
	map.insert(scene.measurements);
	EXPECT_FALSE(map.update().appeared.empty());
	const UpdateResult idle = map.update();
	EXPECT_EQ(idle.tiles + idle.evaluations + idle.appeared.size() + idle.vanished.size() + idle.regions.size(), 0u);
	// What is inserted and erased before the update changes no polyline.
	const std::vector<Measurement> some(scene.measurements.begin(), scene.measurements.begin() + 100);
	map.insert(some);
	map.erase(some);
	const UpdateResult same = map.update();
	EXPECT_TRUE(same.appeared.empty());
	EXPECT_TRUE(same.vanished.empty());
}

TEST(UpdateResult, Adds)
{
	const RandomScene scene = randomScene(13, 1);
	RidgeMap map(scene.options());
	map.insert(scene.measurements);
	const UpdateResult one = map.update();
	UpdateResult twice = one;
	twice += one;
	EXPECT_EQ(twice.evaluations, 2 * one.evaluations);
	EXPECT_EQ(twice.kernels, 2 * one.kernels);
	EXPECT_EQ(twice.seeds, 2 * one.seeds);
	EXPECT_EQ(twice.tiles, 2 * one.tiles);
	EXPECT_EQ(twice.appeared.size(), 2 * one.appeared.size());
	EXPECT_EQ(twice.regions.size(), 2 * one.regions.size());
	EXPECT_EQ(twice.stops[std::size_t(StopReason::crossing)], 2 * one.stops[std::size_t(StopReason::crossing)]);
}

TEST(Update, ThreadsDoTheSameWork)
{
	const RandomScene scene = randomScene(14, 6);
	RidgeMap one(scene.options()), four(scene.options());
	one.insert(scene.measurements);
	four.insert(scene.measurements);
	const UpdateResult a = one.update(1), b = four.update(4);
	EXPECT_GE(a.tiles, 32u) << "too few for the threads to start";
	EXPECT_EQ(a.evaluations, b.evaluations);
	EXPECT_EQ(a.kernels, b.kernels);
	EXPECT_EQ(a.appeared, b.appeared);
	EXPECT_EQ(a.stops, b.stops);
	EXPECT_EQ(firstDifference(one.ridges(), four.ridges()), "");
}

TEST(Update, WorkDoesNotGrowWithTheTimeOfObservation)
{
	const std::size_t perScan = 400;
	Options options;
	options.sigma = 1;
	SceneBuilder builder(15, 1, 0.35, double(perScan) / 80);
	for (int i = 0; i < 1000; i++) builder.wall({0, 0}, {40, 0}).wall({40, 0}, {40, 40});
	const std::vector<Measurement> all = builder.finish();
	// The builder's walls come one after the other: scan i takes every thousandth measurement.
	RidgeMap map(options);
	UpdateResult early, late;
	std::size_t cellsEarly = 0;
	for (std::size_t i = 0; i < 1000; i++)
	{
		std::vector<Measurement> scan;
		for (std::size_t k = i; k < all.size(); k += 1000) scan.push_back(all[k]);
		ASSERT_EQ(scan.size(), perScan);
		map.insert(scan);
		if (i % 10 != 9) continue;
		late = map.update();
		if (i == 9) early = late, cellsEarly = map.statistics().cells;
	}
	const std::size_t cells = map.statistics().cells;
	std::cout << "after 10 and 1000 scans: kernels per update " << early.kernels << " and " << late.kernels
			  << ", evaluations " << early.evaluations << " and " << late.evaluations << ", seeds " << early.seeds
			  << " and " << late.seeds << ", cells " << cellsEarly << " and " << cells << "\n";
	// The halo of a wall fills slowly: its cells grow with the root of the logarithm of the time.
	EXPECT_LE(double(cells), 2.5 * double(cellsEarly));
	EXPECT_LE(double(late.evaluations), 2 * double(early.evaluations));
	EXPECT_LE(double(late.kernels), 4 * double(early.kernels));
}

TEST(Update, WorkDoesNotGrowWithTheMap)
{
	Options options;
	options.sigma = 1;
	const auto place = exactWall({0, 0}, {30, 5}, 0.1), more = exactWall({10, 0}, {12, 20}, 0.1);
	RidgeMap small(options), large(options);
	small.insert(place);
	large.insert(place);
	for (int i = 1; i < 100; i++) large.insert(exactWall({100.0 * i, 0}, {100.0 * i, 40}, 0.1));
	small.update();
	large.update();
	small.insert(more);
	large.insert(more);
	const UpdateResult a = small.update(), b = large.update();
	EXPECT_EQ(a.evaluations, b.evaluations);
	EXPECT_EQ(a.kernels, b.kernels);
	EXPECT_EQ(a.tiles, b.tiles);
}

TEST(StepRule, OfThePaperTakesItsLongestStepsWhereNothingBends)
{
	// Nodes need no correction there, so none is put between two of them.
	Options options;
	options.stepRule = StepRule::paper;
	RidgeMap map(options);
	map.insert(exactWall({0, 0}, {3, 0.2}, 0.002));
	ASSERT_EQ(map.ridges().size(), 1u);
	const std::vector<Point2>& p = map.ridges()[0].points;
	std::size_t longest = 0;
	for (std::size_t k = 1; k < p.size(); k++)
	{
		const double step = std::hypot(p[k].x - p[k - 1].x, p[k].y - p[k - 1].y) / options.sigma;
		EXPECT_LE(step, 1.001 * options.maxStep);
		longest += step > 0.99 * options.maxStep;
	}
	EXPECT_GT(longest, 10u);
}

TEST(StepRule, OfThePaperIsLessExact)
{
	double worst[2] = {}, evaluations[2] = {}, length[2] = {};
	for (std::uint64_t seed = 20; seed < 24; seed++)
	{
		const RandomScene scene = randomScene(seed);
		const Oracle oracle(scene.measurements, scene.sigma);
		for (const StepRule rule : {StepRule::error, StepRule::paper})
		{
			Options options = scene.options();
			options.stepRule = rule;
			RidgeMap map(options);
			map.insert(scene.measurements);
			const int k = int(rule);
			evaluations[k] += double(map.update().evaluations);
			worst[k] = std::max(worst[k], measureAccuracy(oracle, map.ridges(), options).worst);
			length[k] += totalLength(map.ridges()) / scene.sigma;
		}
	}
	std::cout << "seeds 20 to 23: error rule worst " << worst[0] << " eps, " << evaluations[0] / length[0]
			  << " evaluations per sigma; rule of the paper " << worst[1] << " eps, " << evaluations[1] / length[1]
			  << "\n";
	EXPECT_LE(worst[0], 1);
	EXPECT_GT(worst[1], 2);
	EXPECT_NEAR(length[1] / length[0], 1, 0.15);
}

}  // namespace ridgemap::test
