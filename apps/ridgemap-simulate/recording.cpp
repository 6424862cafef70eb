// SPDX-License-Identifier: BSD-3-Clause
#include "recording.h"

#include <mrpt/core/Clock.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/serialization/CArchive.h>
#include <ridgemap/atomic_file.h>
#include <ridgemap/gz_archive.h>
#include <ridgemap/polyline_csv.h>

#include <filesystem>
#include <stdexcept>

namespace ridgemap::apps
{
namespace
{
constexpr double startTime = 1.6e9;  // of the recording [s since 1970]

mrpt::obs::CObservation::Ptr cloudOf(const std::vector<Measurement>& points, const Pose& pose)
{
	auto cloud = mrpt::obs::CObservationPointCloud::Create();
	auto map = mrpt::maps::CSimplePointsMap::Create();
	const double c = std::cos(pose.phi), s = std::sin(pose.phi);
	for (const Measurement& m : points)
	{
		const double dx = m.x - pose.x, dy = m.y - pose.y;
		map->insertPoint(float(c * dx + s * dy), float(c * dy - s * dx), 0);
	}
	cloud->pointcloud = map;
	return cloud;
}

mrpt::obs::CObservation::Ptr scanOf(const std::vector<double>& ranges, const LidarSensor& sensor)
{
	auto scan = mrpt::obs::CObservation2DRangeScan::Create();
	scan->aperture = float(sensor.fieldOfView);
	scan->maxRange = float(sensor.maxRange);
	scan->stdError = float(sensor.range.constant);
	scan->resizeScan(ranges.size());
	for (std::size_t i = 0; i < ranges.size(); i++)
	{
		scan->setScanRange(i, float(ranges[i] > 0 ? ranges[i] : sensor.maxRange));
		scan->setScanRangeValidity(i, ranges[i] > 0);
	}
	return scan;
}

std::vector<Measurement> pointsOf(const std::vector<double>& ranges, const LidarSensor& sensor, const Pose& pose)
{
	std::vector<Measurement> points;
	for (std::size_t i = 0; i < ranges.size(); i++)
	{
		if (!(ranges[i] > 0)) continue;
		const double angle = pose.phi + (double(i) / double(ranges.size() - 1) - 0.5) * sensor.fieldOfView;
		points.push_back({pose.x + ranges[i] * std::cos(angle), pose.y + ranges[i] * std::sin(angle), pose.x, pose.y});
	}
	return points;
}

mrpt::poses::CPose2D mrptPose(const Pose& p)
{
	return {p.x, p.y, p.phi};
}

void writeRawlog(mrpt::serialization::CArchive& archive, const Recording& recording, const CommandLine& c)
{
	Random random(c.seed + 1);
	mrpt::poses::CPose2D last;
	for (const Recording::Cycle& cycle : recording.cycles)
	{
		const mrpt::poses::CPose2D step = mrptPose(cycle.pose) - last;
		last = mrptPose(cycle.pose);
		const auto noisy = [&](double v) { return v * (1 + c.odometryNoise * random.normal()); };
		const double x = noisy(step.x()), y = noisy(step.y()), phi = noisy(step.phi());
		mrpt::obs::CActionRobotMovement2D movement;
		movement.computeFromOdometry({x, y, phi}, {});
		movement.timestamp = cycle.observation->timestamp;
		mrpt::obs::CActionCollection actions;
		actions.insert(movement);
		mrpt::obs::CSensoryFrame frame;
		frame.insert(cycle.observation);
		archive << actions << frame;
	}
}

void writeSimplemap(mrpt::serialization::CArchive& archive, const Recording& recording, const CommandLine& c)
{
	Random random(c.seed + 2);
	mrpt::maps::CSimpleMap map;
	for (const Recording::Cycle& cycle : recording.cycles)
	{
		auto frame = mrpt::obs::CSensoryFrame::Create();
		frame->insert(cycle.observation);
		Pose pose = cycle.pose;
		pose.x += c.poseNoise * random.normal();
		pose.y += c.poseNoise * random.normal();
		pose.phi += c.headingNoise * random.normal();
		map.insert(mrpt::poses::CPosePDFGaussian::Create(mrptPose(pose)), frame);
	}
	archive << map;
}

void writeMeasurements(std::ostream& out, const Recording& recording)
{
	writeMeasurementsCsvHeader(out);
	for (const Recording::Cycle& cycle : recording.cycles)
		for (const Measurement& m : cycle.measurements) appendMeasurementCsv(out, m);
}

void writePoses(std::ostream& out, const Recording& recording)
{
	out << "# t x y phi\n";
	for (const Recording::Cycle& cycle : recording.cycles)
	{
		char line[160];
		std::snprintf(line, sizeof(line), "%.9f %.17g %.17g %.17g\n", startTime + cycle.pose.time, cycle.pose.x,
					  cycle.pose.y, cycle.pose.phi);
		out << line;
	}
}

}  // namespace

Recording simulate(const CommandLine& c, const Scene& scene)
{
	Recording recording;
	Simulator simulator(scene, c.seed);
	for (const Pose& pose : posesAlong(scene.path, c.spacing, c.speed))
	{
		Recording::Cycle cycle;
		cycle.pose = pose;
		if (c.lidar)
		{
			const std::vector<double> ranges = simulator.scan(c.scanner, pose);
			cycle.measurements = pointsOf(ranges, c.scanner, pose);
			cycle.observation = scanOf(ranges, c.scanner);
		}
		else
		{
			cycle.measurements = simulator.measure(c.paper, pose);
			cycle.observation = cloudOf(cycle.measurements, pose);
		}
		cycle.observation->timestamp = mrpt::Clock::fromDouble(startTime + pose.time);
		cycle.observation->sensorLabel = c.lidar ? "LASER" : "POINTS";
		recording.cycles.push_back(std::move(cycle));
	}
	recording.truth = simulator.truth();
	return recording;
}

std::vector<std::string> writeRecording(const CommandLine& c, const Recording& recording)
{
	if (const auto directory = std::filesystem::path(c.prefix).parent_path(); !directory.empty())
		std::filesystem::create_directories(directory);
	AtomicFile rawlog(c.prefix + ".rawlog"), simplemap(c.prefix + ".simplemap.gz"),
		measurements(c.prefix + "_measurements.csv"), poses(c.prefix + "_poses.txt"), truth(c.prefix + "_truth.csv");
	writeGzArchive(rawlog, [&](mrpt::serialization::CArchive& out) { writeRawlog(out, recording, c); });
	writeGzArchive(simplemap, [&](mrpt::serialization::CArchive& out) { writeSimplemap(out, recording, c); });
	writeMeasurements(measurements.stream(), recording);
	writePoses(poses.stream(), recording);
	writeTruth(truth.stream(), recording.truth);
	std::vector<std::string> names;
	for (AtomicFile* f : {&rawlog, &simplemap, &measurements, &poses, &truth})
	{
		f->commit();
		names.push_back(f->path());
	}
	return names;
}

}  // namespace ridgemap::apps
