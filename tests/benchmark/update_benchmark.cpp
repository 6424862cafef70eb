// SPDX-License-Identifier: BSD-3-Clause
// Cost of a map update by the number of measurements in its region (paper section VI-D), beside its floor: the
// evaluations and changed cells that it reports, times what one of each costs in a tight loop of the same process.
#include <benchmark/benchmark.h>
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <string>

#include "kernel_sum_impl.h"
#include "mean_shift.h"
#include "ratio_reporter.h"

namespace
{
using namespace ridgemap;
using benchmarks::cpuSeconds;

/** Length of wall that a sensor in the middle of a 6 m wide hallway sees on each side with a field of view of 4 m. */
constexpr double seenLength = 5.3;

/** Measurements of both walls with 0.02 m of noise across. */
std::vector<Measurement> hallway(std::mt19937& random, std::size_t count)
{
	std::uniform_real_distribution<double> along(0, seenLength);
	std::normal_distribution<double> across(0, 0.02);
	std::vector<Measurement> result(count);
	for (std::size_t i = 0; i < count; i++)
	{
		result[i].x = along(random);
		result[i].y = (i % 2 ? 3 : -3) + across(random);
	}
	return result;
}

/** Walls of rooms of 5 m by 5 m, `rooms` along each side, away from the hallway. */
std::vector<Measurement> building(std::mt19937& random, int rooms, std::size_t count)
{
	std::uniform_real_distribution<double> along(0, 5.0 * rooms);
	std::uniform_int_distribution<int> wall(0, rooms);
	std::normal_distribution<double> across(0, 0.02);
	std::vector<Measurement> result(count);
	for (std::size_t i = 0; i < count; i++)
	{
		double a = along(random), b = 5.0 * wall(random) + across(random);
		if (i % 2) std::swap(a, b);
		result[i].x = 50 + a;
		result[i].y = b;
	}
	return result;
}

/** A sum of kernels and a change of a cell, over and over: what an update cannot do without. */
struct Unit
{
	float nodes[64] = {};
	KernelProfile profile, before;
	KernelReach reach;
	std::vector<std::int32_t> low, high;
	std::vector<std::int64_t> nodesOfBlock;
	CellGrid grid{Options()};
	KernelSpreader spreader{grid, Options().cutoff};
	SpreadScratch scratch;

	Unit()
	{
		for (int i = 0; i < 64; i++) nodes[i] = float(i % 7);
	}
	KernelSums evaluate(float t)
	{
		KernelSums sums;
		const NodeSquare square{nodes, &sums};
		interpolateNodes(&square, 1, 8, t, 1 - t);
		return sums;
	}
	KernelSums evaluatePortably(float t)
	{
		KernelSums sums;
		const NodeSquare square{nodes, &sums};
		interpolateNodesImpl(&square, 1, 8, t, 1 - t);
		return sums;
	}
	/** A cell that is known gets one measurement more. */
	void spread(std::uint32_t i)
	{
		const auto nodesOf = [&](int, int) -> std::vector<std::int64_t>& { return nodesOfBlock; };
		const CellKey key = makeCellKey(0, i % 16, i / 16 % 16);
		const std::int64_t n = 3 + i % 5;
		spreader.spread(key, {std::uint32_t(n), n, n, n, 0, n}, {std::uint32_t(n + 1), n, n + 1, n, 0, n}, scratch,
						nodesOf);
		if (i % 6 == 5) spreader.finish(scratch, nodesOf);  // about so many cells of a block change in a scan
	}
};

template <class Fn>
double secondsOf(int count, Fn fn)
{
	double best = 1e9;
	for (int repeat = 0; repeat < 5; repeat++)
	{
		const double start = cpuSeconds();
		for (int i = 0; i < count; i++) fn(i);
		best = std::min(best, (cpuSeconds() - start) / count);
	}
	return best;
}

/** What an update costs at least [s]: a changed cell counts as two kernels, before and after. */
double floorOf(const UpdateResult& r)
{
	static Unit unit;
	static const double evaluation =
		secondsOf(20000, [](int i) { benchmark::DoNotOptimize(unit.evaluate(float(i % 64) / 64)); });
	static const double kernel = 0.5 * secondsOf(2000, [](int i) { unit.spread(std::uint32_t(i)); });
	return evaluation * double(r.evaluations) + kernel * double(r.kernels);
}

void evaluations(benchmark::State& state, bool portable)
{
	Unit unit;
	int i = 0;
	for (auto _ : state)
	{
		const float t = float(i++ % 64) / 64;
		benchmark::DoNotOptimize(portable ? unit.evaluatePortably(t) : unit.evaluate(t));
	}
}

void spreading(benchmark::State& state)
{
	Unit unit;
	std::uint32_t i = 0;
	for (auto _ : state) unit.spread(i++);
}

/** Inserts a scan of `count` measurements into a known hallway and brings the polylines up to date; `elsewhere` and
 * `known` are what the map holds besides. The median is reported. */
void updates(benchmark::State& state, double sigma, std::size_t count, std::size_t known, std::size_t elsewhere)
{
	std::mt19937 random(1);
	Options options;
	options.sigma = sigma;
	RidgeMap map(options);
	map.insert(hallway(random, known));
	if (elsewhere > 0) map.insert(building(random, 20, elsewhere));
	map.update();
	UpdateResult total;
	std::vector<double> seconds;
	for (auto _ : state)
	{
		seconds.clear();
		total = {};
		for (int i = 0; i < 31; i++)
		{
			const auto scan = hallway(random, count);
			const double start = cpuSeconds();
			map.insert(scan);
			const UpdateResult r = map.update();
			seconds.push_back(cpuSeconds() - start);
			total += r;
			map.erase(scan);
			map.update();
		}
		std::sort(seconds.begin(), seconds.end());
		state.SetIterationTime(seconds[seconds.size() / 2]);
	}
	const double n = double(seconds.size()), least = floorOf(total) / n;
	state.counters["tiles"] = double(total.tiles) / n;
	state.counters["evaluations"] = double(total.evaluations) / n;
	state.counters["kernels"] = double(total.kernels) / n;
	state.counters["floor [ms]"] = 1e3 * least;
	state.counters["time [ms]"] = 1e3 * seconds[seconds.size() / 2];
	state.counters["times the floor"] = seconds[seconds.size() / 2] / least;
}

/** Brings all polylines of a building of 100 m by 100 m up to date at once, by the clock; the best of seven. */
void wholeMap(benchmark::State& state, unsigned threads)
{
	using Clock = std::chrono::steady_clock;
	std::mt19937 random(2);
	const auto measurements = building(random, 20, 1000000);
	for (auto _ : state)
	{
		double best = 1e9;
		for (int repeat = 0; repeat < 7; repeat++)
		{
			RidgeMap map;
			map.insert(measurements);
			const auto start = Clock::now();
			map.update(threads);
			best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
		}
		state.SetIterationTime(best);
	}
}

/** All ridges of measurements that are new. */
void trace(benchmark::State& state, std::size_t count)
{
	std::mt19937 random(3);
	const auto scan = hallway(random, count);
	for (auto _ : state)
	{
		RidgeMap map;
		map.insert(scan);
		benchmark::DoNotOptimize(map.update());
	}
}

void traceByMeanShift(benchmark::State& state, std::size_t count)
{
	std::mt19937 random(3);
	const auto scan = hallway(random, count);
	const Options options;
	double evaluations = 0;
	for (auto _ : state)
		evaluations = double(benchmarks::meanShift(scan, options.sigma, options.effectiveEps() / 10).evaluations);
	state.counters["evaluations"] = evaluations;
}

void registerAll()
{
	using benchmark::RegisterBenchmark;
	RegisterBenchmark("evaluation/ridge map", evaluations, false);
	RegisterBenchmark("evaluation/portable", evaluations, true);
	RegisterBenchmark("changed cell/ridge map", spreading);
	// The smoothing of the paper's experiments; walls are 106 sigma long then.
	const auto update =
		[](const std::string& name, std::size_t count, std::size_t known, std::size_t elsewhere, double sigma = 0.1)
	{
		RegisterBenchmark(name.c_str(), updates, sigma, count, known, elsewhere)
			->UseManualTime()
			->Iterations(1)
			->Unit(benchmark::kMicrosecond);
	};
	for (const int n : {25, 50, 100, 200, 400, 800, 1600, 3200, 6400})
		update("update with measurements/" + std::to_string(n), std::size_t(n), 10000, 0);
	// A twentieth of what the region holds is new, as on a drive.
	for (const int n : {100, 400, 1600, 6400})
		update("update of a region that holds/" + std::to_string(n), std::size_t(n / 20), std::size_t(n - n / 20), 0);
	update("finer smoothing/sigma 0.1 m", 400, 10000, 0);
	update("finer smoothing/sigma 0.05 m", 400, 10000, 0, 0.05);
	update("flatness/ridge map", 400, 10000, 0);
	update("flatness/100 times larger elsewhere", 400, 10000, 1000000);
	update("flatness/100 times longer there", 400, 1000000, 0);
	for (const unsigned threads : {1u, 2u})
		RegisterBenchmark(
			("building at once/ridge map, " + std::to_string(threads) + (threads > 1 ? " threads" : " thread")).c_str(),
			wholeMap, threads)
			->UseManualTime()
			->Iterations(1)
			->Unit(benchmark::kMillisecond);
	for (const std::size_t n : {400u, 1600u, 6400u})
	{
		const std::string group = "ridges of " + std::to_string(n) + " new measurements/";
		RegisterBenchmark((group + "ridge map").c_str(), trace, n)->Unit(benchmark::kMicrosecond);
		RegisterBenchmark((group + "mean shift").c_str(), traceByMeanShift, n)->Unit(benchmark::kMicrosecond);
	}
}
}  // namespace

int main(int argc, char** argv)
{
	registerAll();
	return ridgemap::benchmarks::runWithRatios(argc, argv);
}
