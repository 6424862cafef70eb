// SPDX-License-Identifier: BSD-3-Clause
// Cost of counting the rays of a scan, beside the insertion of the same scan into a grid of 5 cm: the difference
// between `insertScan/1` and `insertScan/0` is what free space adds.
#include <benchmark/benchmark.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <ridgemap/observation_to_measurements.h>
#include <ridgemap/ridge_map.h>

#include <cmath>

namespace
{
using mrpt::obs::CObservation2DRangeScan;
constexpr double pi = 3.14159265358979323846;
constexpr double halfWidth = 8, halfHeight = 5;  ///< of the room [m]

/** What a scanner of 361 beams over 270 degrees sees in the middle of a room. */
CObservation2DRangeScan scanAt(double x, double y)
{
	CObservation2DRangeScan scan;
	scan.aperture = float(1.5 * pi);
	scan.maxRange = 30;
	scan.resizeScan(361);
	for (std::size_t i = 0; i < 361; i++)
	{
		const double angle = 1.5 * pi * (double(i) / 360 - 0.5), c = std::cos(angle), s = std::sin(angle);
		const double rx = (c > 0 ? halfWidth - x : halfWidth + x) / std::abs(c);
		const double ry = (s > 0 ? halfHeight - y : halfHeight + y) / std::abs(s);
		scan.setScanRange(i, float(std::min(rx, ry)));
		scan.setScanRangeValidity(i, true);
	}
	return scan;
}

constexpr int positions = 64;

mrpt::poses::CPose3D poseAt(int i)
{
	return {0.05 * (i % positions) - 1.6, 0.3 * std::sin(0.2 * i), 0, 0, 0, 0};
}

void insertScan(benchmark::State& state)
{
	ridgemap::Options options;
	options.freeSpace = state.range(0) != 0;
	ridgemap::RidgeMap map(options);
	std::vector<std::vector<ridgemap::Measurement>> scans;
	for (int i = 0; i < positions; i++)
		scans.push_back(ridgemap::observationToMeasurements(scanAt(poseAt(i).x(), poseAt(i).y()), poseAt(i), {}));
	const auto bytesPerSquareMetre = [&] { return double(map.statistics().freeBytes) / (4 * halfWidth * halfHeight); };
	for (const auto& scan : scans) map.insert(scan);
	state.counters["bytes/m2"] = bytesPerSquareMetre();
	std::size_t i = 0;
	for (auto _ : state) map.insert(scans[i++ % positions]);
	state.counters["bytes/m2 at the end"] = bytesPerSquareMetre();
}
BENCHMARK(insertScan)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void insertScanIntoGrid(benchmark::State& state)
{
	mrpt::maps::COccupancyGridMap2D grid(-10, 10, -10, 10, 0.05f);
	grid.insertionOptions.maxDistanceInsertion = 80;
	std::vector<CObservation2DRangeScan> scans;
	for (int i = 0; i < positions; i++) scans.push_back(scanAt(poseAt(i).x(), poseAt(i).y()));
	std::size_t i = 0;
	for (auto _ : state)
	{
		grid.insertObservation(scans[i % positions], poseAt(int(i % positions)));
		i++;
	}
}
BENCHMARK(insertScanIntoGrid)->Unit(benchmark::kMicrosecond);
}  // namespace
