// SPDX-License-Identifier: BSD-3-Clause
// Cost of a map update and of its parts, by the number of measurements in the update region (paper section VI-D).
#include <benchmark/benchmark.h>
#include <ridgemap/ridge_map.h>

#include <random>

namespace
{
/** Length of wall that a sensor in the middle of a 6 m wide hallway sees on each side with a field of view of 4 m. */
constexpr double seenLength = 5.3;

/** Measurements of both walls with 0.02 m of noise across. */
std::vector<ridgemap::Measurement> hallway(std::mt19937& random, std::size_t count)
{
	std::uniform_real_distribution<double> along(0, seenLength);
	std::normal_distribution<double> across(0, 0.02);
	std::vector<ridgemap::Measurement> result(count);
	for (std::size_t i = 0; i < count; i++)
	{
		result[i].x = along(random);
		result[i].y = (i % 2 ? 3 : -3) + across(random);
	}
	return result;
}

ridgemap::RidgeMap knownHallway(std::mt19937& random)
{
	ridgemap::RidgeMap map;
	map.insert(hallway(random, 10000));
	map.update();
	return map;
}

/** Inserts a scan of that many measurements into a known hallway and brings the polylines up to date. */
void insertAndUpdate(benchmark::State& state)
{
	std::mt19937 random(1);
	ridgemap::RidgeMap map = knownHallway(random);
	ridgemap::UpdateResult total;
	for (auto _ : state)
	{
		state.PauseTiming();
		const auto scan = hallway(random, std::size_t(state.range(0)));
		state.ResumeTiming();
		map.insert(scan);
		total += map.update();
		state.PauseTiming();
		map.erase(scan);
		map.update();
		state.ResumeTiming();
	}
	const auto perUpdate = [](std::size_t n)
	{ return benchmark::Counter(double(n), benchmark::Counter::kAvgIterations); };
	state.counters["evaluations"] = perUpdate(total.evaluations);
	state.counters["kernels"] = perUpdate(total.kernels);
	state.counters["tiles"] = perUpdate(total.tiles);
}
BENCHMARK(insertAndUpdate)->Arg(25)->Arg(100)->Arg(400)->Arg(1600)->Unit(benchmark::kMicrosecond);

/** L and its derivatives at one point of a wall. */
void evaluateOccupancy(benchmark::State& state)
{
	std::mt19937 random(1);
	const ridgemap::RidgeMap map = knownHallway(random);
	double x = 0;
	for (auto _ : state)
	{
		x = x < seenLength ? x + 0.01 : 0;
		benchmark::DoNotOptimize(map.occupancy({x, 3}));
	}
}
BENCHMARK(evaluateOccupancy)->Unit(benchmark::kNanosecond);
}  // namespace
