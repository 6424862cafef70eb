// SPDX-License-Identifier: BSD-3-Clause
// Likelihood of scans and matching of their points, all beams, on a ridge map and on maps of MRPT that hold the same
// scans: the run of Debian's mrpt-common, at the poses that icp-slam on a ridge map finds. Times are CPU time of the
// thread for one scan: with warm caches, and to the first answer after the map took in a scan or was copied the way
// MRPT copies maps.
#include <benchmark/benchmark.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <ridgemap/CRidgePointsMap.h>

#include <cstdio>
#include <functional>

#include "one_loop.h"
#include "ratio_reporter.h"

namespace
{
using mrpt::maps::CMetricMap;
using mrpt::poses::CPose2D;
using ridgemap::benchmarks::cpuSeconds;
using ridgemap::benchmarks::SeenScan;

const std::vector<SeenScan>& scans()
{
	return ridgemap::benchmarks::oneLoop();
}

CMetricMap::Ptr filled(CMetricMap::Ptr map)
{
	for (const auto& s : scans()) map->insertObservation(*s.scan, s.pose);
	return map;
}

CMetricMap::Ptr ridgeMap(ridgemap::MatchingMethod method)
{
	ridgemap::MapOptions options;
	options.likelihood.decimation = 1;
	options.matching.method = method;
	return filled(std::make_shared<ridgemap::CRidgeMap2D>(options));
}

CMetricMap::Ptr pointsMap()
{
	auto map = std::make_shared<mrpt::maps::CSimplePointsMap>();
	map->insertionOptions.minDistBetweenLaserPoints = 0.02f;
	map->likelihoodOptions.decimation = 1;
	return filled(map);
}

CMetricMap::Ptr grid(float resolution, bool cache)
{
	auto map = std::make_shared<mrpt::maps::COccupancyGridMap2D>(-10.0f, 10.0f, -10.0f, 10.0f, resolution);
	map->likelihoodOptions.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
	map->likelihoodOptions.LF_decimation = 1;
	map->likelihoodOptions.enableLikelihoodCache = cache;
	return filled(map);
}

double likelihood(CMetricMap& map, const SeenScan& s)
{
	return map.computeObservationLikelihood(*s.scan, s.pose);
}

double matching(CMetricMap& map, const SeenScan& s)
{
	mrpt::tfest::TMatchingPairList pairs;
	mrpt::maps::TMatchingParams params;
	mrpt::maps::TMatchingExtraResults extra;
	params.maxDistForCorrespondence = 0.5f;
	params.maxAngularDistForCorrespondence = 0;
	params.onlyKeepTheClosest = true;
	map.determineMatching2D(&s.points, CPose2D(s.pose), pairs, params, extra);
	return extra.correspondencesRatio;
}

using Query = double (*)(CMetricMap&, const SeenScan&);
using MakeMap = std::function<CMetricMap::Ptr()>;

void timeQuery(benchmark::State& state, CMetricMap& map, Query query, const SeenScan& s)
{
	const double start = cpuSeconds();
	benchmark::DoNotOptimize(query(map, s));
	state.SetIterationTime(cpuSeconds() - start);
}

void warm(benchmark::State& state, const MakeMap& make, Query query)
{
	const auto map = make();
	for (const auto& s : scans()) query(*map, s);
	for (auto _ : state)
	{
		const double start = cpuSeconds();
		for (const auto& s : scans()) benchmark::DoNotOptimize(query(*map, s));
		state.SetIterationTime((cpuSeconds() - start) / double(scans().size()));
	}
}

void afterChange(benchmark::State& state, const MakeMap& make, Query query)
{
	const auto map = make();
	std::size_t i = 0;
	for (auto _ : state)
	{
		const SeenScan& s = scans()[i++ % scans().size()];
		map->insertObservation(*s.scan, s.pose);
		timeQuery(state, *map, query, s);
	}
}

void afterCopy(benchmark::State& state, const MakeMap& make, Query query)
{
	mrpt::maps::CMultiMetricMap original;
	original.maps.push_back(make());
	for (const auto& s : scans()) query(*original.maps[0], s);
	std::size_t i = 0;
	for (auto _ : state)
	{
		mrpt::maps::CMultiMetricMap copy = original;
		timeQuery(state, *copy.maps[0], query, scans()[i++ % scans().size()]);
	}
}

void registerAll()
{
	using ridgemap::MatchingMethod;
	const std::pair<const char*, MakeMap> maps[] = {
		{"ridge map", [] { return ridgeMap(MatchingMethod::lines); }},
		{"ridge map, feet", [] { return ridgeMap(MatchingMethod::feet); }},
		{"points map", [] { return pointsMap(); }},
		{"grid 5 cm", [] { return grid(0.05f, false); }},
		{"grid 5 cm, cache", [] { return grid(0.05f, true); }},
		{"grid 2 cm", [] { return grid(0.02f, false); }},
		{"grid 2 cm, cache", [] { return grid(0.02f, true); }},
	};
	const std::pair<const char*, Query> queries[] = {{"likelihood", likelihood}, {"matching", matching}};
	using Benchmark = void (*)(benchmark::State&, const MakeMap&, Query);
	const std::pair<const char*, Benchmark> states[] = {
		{"warm", warm}, {"after a change", afterChange}, {"after a copy", afterCopy}};
	for (const auto& [queryName, query] : queries)
		for (const auto& [stateName, run] : states)
			for (const auto& [mapName, make] : maps)
				benchmark::RegisterBenchmark((std::string(queryName) + "/" + stateName + "/" + mapName).c_str(), run,
											 make, query)
					->UseManualTime()
					->Unit(benchmark::kMicrosecond)
					->Iterations(20);
}
}  // namespace

int main(int argc, char** argv)
{
	if (!ridgemap::benchmarks::hasOneLoop())
	{
		std::fprintf(stderr, "the sample data of Debian's package mrpt-common are not installed\n");
		return 77;
	}
	ridgemap::registerMapClasses();
	registerAll();
	return ridgemap::benchmarks::runWithRatios(argc, argv);
}
