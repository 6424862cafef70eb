// SPDX-License-Identifier: BSD-3-Clause
// Insertion, building, copies, merging, erasing, files and nearest points of a ridge map beside maps of MRPT that take
// in the same scans: a simulated drive through rooms, and the run of Debian's mrpt-common. CPU time of the thread; of
// insertions, the median over the scans.
#include <benchmark/benchmark.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/serialization/CArchive.h>
#include <ridgemap/CRidgeMap2D.h>

#include <algorithm>
#include <functional>
#include <string>

#include "../../apps/common/simulator.h"
#include "one_loop.h"
#include "ratio_reporter.h"

namespace
{
using mrpt::maps::CMetricMap;
using ridgemap::CRidgeMap2D;
using ridgemap::benchmarks::cpuSeconds;
using ridgemap::benchmarks::SeenScan;
using Scans = std::vector<SeenScan>;

/** A drive through a hallway of 6 m with a corner, a partition and pillars; 361 beams over 180 degrees. */
Scans drive()
{
	using namespace ridgemap::apps;
	Scene scene = hallwayScene();
	scene.addWall({1, 1}, {4, 1});
	scene.addWall({1, 1.1}, {4, 1.1});
	for (const double x : {2.0, 6.0, 9.0}) scene.addArc({x, -1.5}, 0.3, 0, 6.2831853);
	Simulator simulator(scene, 5);
	LidarSensor lidar;
	lidar.fieldOfView = 3.14159265358979;
	Scans result;
	for (const Pose& p : posesAlong(scene.path, 0.1, 0.5))
	{
		const std::vector<double> ranges = simulator.scan(lidar, p);
		SeenScan s;
		s.scan = mrpt::obs::CObservation2DRangeScan::Create();
		s.scan->aperture = float(lidar.fieldOfView);
		s.scan->maxRange = float(lidar.maxRange);
		s.scan->resizeScan(ranges.size());
		for (std::size_t i = 0; i < ranges.size(); i++)
		{
			s.scan->setScanRange(i, float(ranges[i]));
			s.scan->setScanRangeValidity(i, ranges[i] > 0);
		}
		s.pose = mrpt::poses::CPose3D(p.x, p.y, 0, p.phi, 0, 0);
		result.push_back(s);
	}
	return result;
}

const Scans& simulated()
{
	static const Scans scans = drive();
	return scans;
}

std::shared_ptr<CRidgeMap2D> ridgeMap()
{
	return std::make_shared<CRidgeMap2D>();
}

/** Without viewing directions and free space: the map of the paper. */
std::shared_ptr<CRidgeMap2D> plainRidgeMap()
{
	ridgemap::Options options;
	options.sides = options.freeSpace = false;
	return std::make_shared<CRidgeMap2D>(options);
}

CMetricMap::Ptr pointsMap()
{
	auto map = std::make_shared<mrpt::maps::CSimplePointsMap>();
	map->insertionOptions.minDistBetweenLaserPoints = 0.02f;
	return map;
}

CMetricMap::Ptr grid(float resolution)
{
	return std::make_shared<mrpt::maps::COccupancyGridMap2D>(-25.0f, 25.0f, -25.0f, 25.0f, resolution);
}

void insertAll(CMetricMap& map, const Scans& scans)
{
	for (const SeenScan& s : scans) map.insertObservation(*s.scan, s.pose);
}

std::shared_ptr<CRidgeMap2D> filled(const Scans& scans)
{
	auto map = ridgeMap();
	insertAll(*map, scans);
	map->update();
	return map;
}

using GetScans = const Scans& (*)();
using MakeMap = std::function<CMetricMap::Ptr()>;

double median(std::vector<double> v)
{
	std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
	return v[v.size() / 2];
}

/** Median time of taking in a scan; `after` is done for every scan. */
void insertScans(benchmark::State& state, GetScans get, const MakeMap& make,
				 const std::function<void(CMetricMap&)>& after)
{
	const Scans& scans = get();
	for (auto _ : state)
	{
		const auto map = make();
		std::vector<double> seconds;
		for (const SeenScan& s : scans)
		{
			const double start = cpuSeconds();
			map->insertObservation(*s.scan, s.pose);
			if (after) after(*map);
			seconds.push_back(cpuSeconds() - start);
		}
		state.SetIterationTime(median(seconds));
	}
}

/** Time of one call, each on what `prepare` makes. */
template <class Prepare, class Fn>
void timeAlone(benchmark::State& state, Prepare prepare, Fn fn)
{
	for (auto _ : state)
	{
		auto subject = prepare();
		const double start = cpuSeconds();
		fn(*subject);
		state.SetIterationTime(cpuSeconds() - start);
	}
}

void buildMap(benchmark::State& state, GetScans get, const MakeMap& make)
{
	const Scans& scans = get();
	timeAlone(state, make,
			  [&](CMetricMap& map)
			  {
				  insertAll(map, scans);
				  if (auto* ridge = dynamic_cast<CRidgeMap2D*>(&map)) ridge->update();
			  });
}

CMetricMap::Ptr built(const MakeMap& make, const Scans& scans)
{
	auto map = make();
	insertAll(*map, scans);
	if (auto* ridge = dynamic_cast<CRidgeMap2D*>(map.get())) ridge->update();
	return map;
}

void copyMap(benchmark::State& state, GetScans get, const MakeMap& make)
{
	const auto map = built(make, get());
	timeAlone(
		state, [&] { return &map; },
		[](const CMetricMap::Ptr& m)
		{ benchmark::DoNotOptimize(std::dynamic_pointer_cast<CMetricMap>(m->duplicateGetSmartPtr())); });
}

void copyAndInsert(benchmark::State& state, GetScans get, const MakeMap& make)
{
	const auto map = built(make, get());
	const SeenScan& scan = get().front();
	timeAlone(
		state, [&] { return &map; },
		[&](const CMetricMap::Ptr& m)
		{
			const auto copy = std::dynamic_pointer_cast<CMetricMap>(m->duplicateGetSmartPtr());
			copy->insertObservation(*scan.scan, scan.pose);
		});
}

void serializeMap(benchmark::State& state, GetScans get, const MakeMap& make, bool write)
{
	const auto map = built(make, get());
	mrpt::io::CMemoryStream file;
	mrpt::serialization::archiveFrom(file) << *map;
	state.counters["bytes"] = double(file.getTotalBytesCount());
	timeAlone(
		state,
		[&]
		{
			file.Seek(0);
			return &file;
		},
		[&](mrpt::io::CMemoryStream& f)
		{
			auto archive = mrpt::serialization::archiveFrom(f);
			if (write)
				archive << *map;
			else
				archive.ReadObject();
		});
}

void nearestPoint(benchmark::State& state, GetScans get, const MakeMap& make)
{
	const auto map = built(make, get());
	const Scans& scans = get();
	std::vector<mrpt::math::TPoint2Df> queries;
	for (std::size_t i = 0; i < 1000; i++)
	{
		const SeenScan& s = scans[i % scans.size()];
		queries.push_back({float(s.pose.x() + 0.003 * double(i % 700)), float(s.pose.y() + 0.002 * double(i % 900))});
	}
	for (auto _ : state)
	{
		const double start = cpuSeconds();
		for (const auto& q : queries) benchmark::DoNotOptimize(map->squareDistanceToClosestCorrespondence(q.x, q.y));
		state.SetIterationTime((cpuSeconds() - start) / double(queries.size()));
	}
}

void eraseScan(benchmark::State& state, GetScans get)
{
	const auto map = filled(get());
	std::size_t i = 0;
	for (auto _ : state)
	{
		const SeenScan& s = get()[i++ % get().size()];
		const double start = cpuSeconds();
		map->eraseObservation(*s.scan, s.pose);
		map->update();
		state.SetIterationTime(cpuSeconds() - start);
		map->insertObservation(*s.scan, s.pose);
		map->update();
	}
}

void mergeHalves(benchmark::State& state, GetScans get)
{
	const Scans& scans = get();
	const auto middle = scans.begin() + std::ptrdiff_t(scans.size() / 2);
	const auto second = filled(Scans(middle, scans.end()));
	timeAlone(
		state, [&] { return filled(Scans(scans.begin(), middle)); },
		[&](CRidgeMap2D& map)
		{
			map.merge(*second);
			map.update();
		});
}

void mergePoints(benchmark::State& state, GetScans get)
{
	const Scans& scans = get();
	const auto middle = scans.begin() + std::ptrdiff_t(scans.size() / 2);
	const auto second = built(pointsMap, Scans(middle, scans.end()));
	timeAlone(
		state, [&] { return built(pointsMap, Scans(scans.begin(), middle)); },
		[&](CMetricMap& map)
		{
			dynamic_cast<mrpt::maps::CSimplePointsMap&>(map).insertAnotherMap(
				dynamic_cast<mrpt::maps::CSimplePointsMap*>(second.get()), mrpt::poses::CPose3D());
		});
}

template <class... Arguments>
void add(const std::string& name, int iterations, Arguments... arguments)
{
	benchmark::RegisterBenchmark(name.c_str(), arguments...)
		->UseManualTime()
		->Iterations(iterations)
		->Unit(benchmark::kMicrosecond);
}

void registerAll(const std::string& data, GetScans get)
{
	const std::pair<const char*, MakeMap> maps[] = {{"ridge map", [] { return ridgeMap(); }},
													{"grid 5 cm", [] { return grid(0.05f); }},
													{"grid 2 cm", [] { return grid(0.02f); }},
													{"grid 1 cm", [] { return grid(0.01f); }},
													{"points map", pointsMap}};
	const auto update = [](CMetricMap& m) { dynamic_cast<CRidgeMap2D&>(m).update(); };
	const MakeMap plain = [] { return plainRidgeMap(); };
	const std::string upToDate = "one scan, polylines up to date, " + data + "/",
					  lazily = "one scan, lazily, " + data + "/";
	add(upToDate + "ridge map", 1, insertScans, get, maps[0].second, update);
	add(upToDate + "ridge map, plain density", 1, insertScans, get, plain, update);
	add(upToDate + "grid 1 cm", 1, insertScans, get, maps[3].second, nullptr);
	for (const auto& [name, make] : maps) add(lazily + name, 1, insertScans, get, make, nullptr);
	add(lazily + "ridge map, plain density", 1, insertScans, get, plain, nullptr);
	for (const auto& [name, make] : maps) add("whole map, " + data + "/" + name, 3, buildMap, get, make);
	for (const auto& [name, make] : maps) add("copy, " + data + "/" + name, 20, copyMap, get, make);
	for (const auto& [name, make] : maps) add("copy and insert, " + data + "/" + name, 20, copyAndInsert, get, make);
	for (const auto& [name, make] : maps) add("write, " + data + "/" + name, 10, serializeMap, get, make, true);
	for (const auto& [name, make] : maps) add("read, " + data + "/" + name, 10, serializeMap, get, make, false);
	for (const auto& [name, make] : {maps[0], maps[4]})
		add("nearest point, " + data + "/" + name, 20, nearestPoint, get, make);
	add("merge halves, " + data + "/ridge map", 3, mergeHalves, get);
	add("merge halves, " + data + "/points map", 3, mergePoints, get);
	add("erase a scan, " + data + "/ridge map", 20, eraseScan, get);
}
}  // namespace

int main(int argc, char** argv)
{
	registerAll("simulated", simulated);
	if (ridgemap::benchmarks::hasOneLoop()) registerAll("one loop", ridgemap::benchmarks::oneLoop);
	return ridgemap::benchmarks::runWithRatios(argc, argv);
}
