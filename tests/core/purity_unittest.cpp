// SPDX-License-Identifier: BSD-3-Clause
// The second promise: ridges and walls are a pure function of the multiset of measurements, to the bit.
// RIDGEMAP_SCENES=N checks N random scenes instead of a few; scripts/check_purity.sh does so with 200.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <iostream>

#include "polylines.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
/** A way to bring a map to a multiset of measurements. */
struct History
{
	bool updateAfterEveryBatch = true;
	bool otherStuff = false;  ///< insert measurements in between that are erased again
	bool mergeHalves = false;
	unsigned threads = 1;
};

void feed(RidgeMap& map, const std::vector<Measurement>& measurements, const History& history, Random& random)
{
	std::size_t next = 0;
	std::vector<Measurement> foreign;
	while (next < measurements.size())
	{
		const std::size_t left = measurements.size() - next;
		const std::size_t n = std::min(left, 1 + random.below(random.chance(0.2) ? 5 : 1 + measurements.size() / 3));
		map.insert({measurements.begin() + std::ptrdiff_t(next), measurements.begin() + std::ptrdiff_t(next + n)});
		next += n;
		if (history.otherStuff)
		{
			if (random.chance(0.5) || foreign.empty())
			{
				std::vector<Measurement> more;
				const Measurement& m = measurements[random.below(measurements.size())];
				const double spread = map.options().sigma * random.uniform(0.5, 8);
				for (std::size_t i = 0, count = 1 + random.below(60); i < count; i++)
					more.push_back({m.x + spread * random.normal(), m.y + spread * random.normal()});
				map.insert(more);
				foreign.insert(foreign.end(), more.begin(), more.end());
			}
			else
			{
				map.erase(foreign);
				foreign.clear();
			}
		}
		if (history.updateAfterEveryBatch) map.update(history.threads);
	}
	map.erase(foreign);
	if (history.updateAfterEveryBatch) map.update(history.threads);
}

RidgeMap build(std::vector<Measurement> measurements, const Options& options, const History& history, Random& random)
{
	random.shuffle(measurements);
	RidgeMap map(options);
	map.setThreads(history.threads);
	if (!history.mergeHalves)
	{
		feed(map, measurements, history, random);
		return map;
	}
	const auto middle = measurements.begin() + std::ptrdiff_t(random.below(measurements.size() + 1));
	RidgeMap other(options);
	feed(map, {measurements.begin(), middle}, history, random);
	feed(other, {middle, measurements.end()}, history, random);
	map.merge(other);
	return map;
}

struct Kind
{
	const char* name;
	double cell = 0.5;
	StepRule stepRule = StepRule::error;
	SeedRule seedRule = SeedRule::projection;
	std::uint64_t firstSeed;
	bool sensors = false;  ///< the sensors are known: densities per side, and rays
};
std::ostream& operator<<(std::ostream& s, const Kind& k)
{
	return s << k.name;
}

class Purity : public testing::TestWithParam<Kind>
{
 protected:
	Options optionsFor(const RandomScene& scene) const
	{
		Options o = scene.options();
		o.cell = GetParam().cell;
		o.stepRule = GetParam().stepRule;
		o.seedRule = GetParam().seedRule;
		return o;
	}
};

/** Lets some of the measurements be seen from five places around. */
void addSensors(RandomScene& scene)
{
	Random random(scene.seed + 5000);
	const Measurement first = scene.measurements.front();
	std::vector<Point2> sensors;
	for (int i = 0; i < 5; i++)
		sensors.push_back(
			{first.x + scene.sigma * random.uniform(-60, 60), first.y + scene.sigma * random.uniform(-60, 60)});
	for (Measurement& m : scene.measurements)
	{
		if (random.chance(0.1)) continue;
		const Point2 sensor = sensors[random.below(sensors.size())];
		m.sensorX = sensor.x;
		m.sensorY = sensor.y;
	}
}

std::string nameOf(const testing::TestParamInfo<Kind>& info)
{
	return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Core, Purity,
						 testing::Values(Kind{"standard", Options().cell, StepRule::error, SeedRule::projection, 600},
										 Kind{"compacted", 0.5, StepRule::error, SeedRule::projection, 100},
										 Kind{"raw", 0, StepRule::error, SeedRule::projection, 200},
										 Kind{"paperSteps", 0.5, StepRule::paper, SeedRule::projection, 300},
										 Kind{"maximumSeeds", 0.5, StepRule::error, SeedRule::maximum, 400},
										 Kind{"rawPaper", 0, StepRule::paper, SeedRule::maximum, 500},
										 Kind{"sided", Options().cell, StepRule::error, SeedRule::projection, 700,
											  true}),
						 nameOf);
}  // namespace

TEST_P(Purity, OrderBatchesErasuresMergesAndThreadsLeaveNoTrace)
{
	const int scenes = fromEnvironment("RIDGEMAP_SCENES", 12);
	const std::vector<History> histories{
		{false, false, false, 1}, {true, false, false, 1}, {true, false, false, 2}, {true, true, false, 1},
		{false, true, false, 2},  {true, false, true, 1},  {true, true, true, 2},
	};
	for (int i = 0; i < scenes; i++)
	{
		const std::uint64_t seed = GetParam().firstSeed + std::uint64_t(i);
		RandomScene scene = randomScene(seed, 2 + i % 3);
		if (GetParam().sensors) addSensors(scene);
		RidgeMap reference(optionsFor(scene));
		reference.insert(scene.measurements);
		ASSERT_FALSE(reference.ridges().empty()) << "seed " << seed;
		for (std::size_t h = 0; h < histories.size(); h++)
		{
			Random random(1000 * seed + h);
			const RidgeMap map = build(scene.measurements, optionsFor(scene), histories[h], random);
			const auto where = [&]
			{ return "scene with seed " + std::to_string(seed) + ", history " + std::to_string(h); };
			ASSERT_EQ(firstDifference(reference.cells(), map.cells()), "") << where();
			ASSERT_EQ(firstDifference(reference.ridges(), map.ridges()), "") << where();
			ASSERT_EQ(firstDifference(reference.walls(), map.walls()), "") << where();
			ASSERT_EQ(reference.statistics().stops, map.statistics().stops) << where();
			ASSERT_EQ(reference.statistics().unstitchedCrossings, map.statistics().unstitchedCrossings) << where();
		}
	}
	std::cout << "scenes with seeds " << GetParam().firstSeed << " to "
			  << GetParam().firstSeed + std::uint64_t(scenes) - 1 << ", each in " << histories.size() << " histories\n";
}

TEST(PurityOfOneTile, EverySingleMeasurementAsABatch)
{
	const RandomScene scene = randomScene(600, 1);
	Options options;
	options.sigma = scene.sigma;
	RidgeMap whole(options), oneByOne(options);
	whole.insert(scene.measurements);
	for (std::size_t i = scene.measurements.size(); i > 0; i--)
	{
		oneByOne.insert({scene.measurements[i - 1]});
		oneByOne.update();
	}
	EXPECT_EQ(firstDifference(whole.ridges(), oneByOne.ridges()), "");
}

TEST(PurityOfOneTile, EveryErasureOnTheWayBack)
{
	const RandomScene scene = randomScene(601, 1);
	Options options;
	options.sigma = scene.sigma;
	RidgeMap map(options);
	map.insert(scene.measurements);
	map.update();
	std::vector<Measurement> left = scene.measurements;
	while (left.size() > 10)
	{
		const std::size_t keep = left.size() - left.size() / 8 - 1;
		map.erase({left.begin() + std::ptrdiff_t(keep), left.end()});
		map.update();
		left.resize(keep);
		RidgeMap fresh(options);
		fresh.insert(left);
		ASSERT_EQ(firstDifference(fresh.ridges(), map.ridges()), "") << left.size() << " measurements left";
	}
}

}  // namespace ridgemap::test
