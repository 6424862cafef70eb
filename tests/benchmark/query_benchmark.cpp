// SPDX-License-Identifier: BSD-3-Clause
// Likelihood of scans and matching of their points, all beams, on a ridge map and on maps of MRPT that hold the same
// scans: the run of Debian's mrpt-common, at the poses that icp-slam on a ridge map finds. Times are CPU time of the
// thread for one scan: with warm caches, and to the first answer after the map took in a scan or was copied the way
// MRPT copies maps.
#include <benchmark/benchmark.h>
#include <mrpt/config/CConfigFile.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDF.h>
#include <mrpt/slam/CMetricMapBuilderICP.h>
#include <ridgemap/CRidgePointsMap.h>

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>

namespace
{
using mrpt::maps::CMetricMap;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

const char* const rawlogFile = "/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";

struct SeenScan
{
	mrpt::obs::CObservation2DRangeScan::Ptr scan;
	CPose3D pose;
	mrpt::maps::CSimplePointsMap points;  ///< robot frame
};

double cpuSeconds()
{
	timespec t;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
	return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/** The scans at the poses that ICP-SLAM on a ridge map gives them. */
std::vector<SeenScan> replay()
{
	const mrpt::config::CConfigFile config(RIDGEMAP_CONFIG "/icp-slam/ridge-points.ini");
	mrpt::slam::CMetricMapBuilderICP slam;
	slam.setMinLoggingLevel(mrpt::system::LVL_ERROR);
	slam.ICP_params.loadFromConfigFile(config, "ICP");
	slam.ICP_options.loadFromConfigFile(config, "MappingApplication");
	slam.initialize();
	mrpt::obs::CRawlog rawlog;
	rawlog.loadFromRawLogFile(rawlogFile);
	std::vector<SeenScan> seen;
	mrpt::obs::CActionCollection::Ptr action;
	mrpt::obs::CSensoryFrame::Ptr frame;
	for (std::size_t at = 0; rawlog.getActionObservationPair(action, frame, at);)
	{
		slam.processActionObservation(*action, *frame);
		SeenScan next;
		next.scan = frame->getObservationByClass<mrpt::obs::CObservation2DRangeScan>();
		if (!next.scan) continue;
		next.pose = slam.getCurrentPoseEstimation()->getMeanVal();
		next.points.insertionOptions.minDistBetweenLaserPoints = 0;
		next.points.insertObservation(*next.scan);
		seen.push_back(next);
	}
	return seen;
}

const std::vector<SeenScan>& scans()
{
	static const std::vector<SeenScan> all = replay();
	return all;
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
	if (!std::filesystem::exists(rawlogFile))
	{
		std::fprintf(stderr, "the sample data of Debian's package mrpt-common are not installed\n");
		return 77;
	}
	ridgemap::registerMapClasses();
	registerAll();
	benchmark::Initialize(&argc, argv);
	benchmark::RunSpecifiedBenchmarks();
	return 0;
}
