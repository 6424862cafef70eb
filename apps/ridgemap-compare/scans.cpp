// SPDX-License-Identifier: BSD-3-Clause
#include "scans.h"

#include <mrpt/maps/CPointsMap.h>
#include <ridgemap/observation_to_measurements.h>

#include <cmath>

#include "../common/user_error.h"

namespace ridgemap::apps
{
using mrpt::obs::CObservation2DRangeScan;

namespace
{
constexpr double pi = 3.14159265358979323846;
constexpr std::size_t cloudBeams = 7200;
constexpr double step = 2 * pi / double(cloudBeams);
}  // namespace

mrpt::poses::CPose3D turnBy(double degrees)
{
	return {0, 0, 0, degrees * pi / 180, 0, 0};
}

CObservation2DRangeScan::Ptr scanOfCloud(const mrpt::obs::CObservation& observation)
{
	const auto points = observationToMeasurements(observation, mrpt::poses::CPose3D(), TInsertionOptions());
	auto scan = CObservation2DRangeScan::Create();
	scan->timestamp = observation.timestamp;
	scan->sensorLabel = observation.sensorLabel;
	scan->aperture = float(2 * pi - step);
	scan->maxRange = float(TInsertionOptions().maxRange);
	scan->resizeScan(cloudBeams);
	for (std::size_t i = 0; i < cloudBeams; i++) scan->setScanRangeValidity(i, false);
	if (points.empty()) return scan;
	scan->sensorPose = mrpt::poses::CPose3D(points.front().sensorX, points.front().sensorY, 0, 0, 0, 0);
	std::size_t used = 0;
	for (const Measurement& m : points)
	{
		if (++used > cloudBeams / 2) break;  // so dense a cloud says all it can
		const double dx = m.x - m.sensorX, dy = m.y - m.sensorY;
		auto beam = std::size_t((std::atan2(dy, dx) + pi) / step) % cloudBeams;
		while (scan->getScanRangeValidity(beam)) beam = (beam + 1) % cloudBeams;
		scan->setScanRange(beam, float(std::hypot(dx, dy)));
		scan->setScanRangeValidity(beam, true);
	}
	return scan;
}

Scans readScans(const std::string& path, const PoseChoice& poses, double degrees)
{
	const mrpt::poses::CPose3D turn = turnBy(degrees);
	Scans scans;
	const auto reader = openReader(path, poses);
	for (Frame frame; reader->next(frame);)
	{
		if (!frame.observation || !frame.pose) continue;
		auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(frame.observation);
		if (!scan && canConvertToMeasurements(*frame.observation))
		{
			scan = scanOfCloud(*frame.observation);
			scans.fromClouds++;
		}
		if (scan) scans.all.push_back({scan, turn + *frame.pose});
	}
	if (scans.all.size() < 2)
		throw UserError("'" + path + "' holds fewer than two scans with poses", "give a .simplemap or .rawlog");
	return scans;
}

CObservation2DRangeScan::Ptr thinned(const CObservation2DRangeScan& scan, std::size_t beams)
{
	std::vector<std::size_t> valid;
	for (std::size_t i = 0; i < scan.getScanSize(); i++)
		if (scan.getScanRangeValidity(i)) valid.push_back(i);
	auto copy = CObservation2DRangeScan::Create(scan);
	if (valid.size() > beams)
	{
		for (const std::size_t i : valid) copy->setScanRangeValidity(i, false);
		for (std::size_t k = 0; k < beams; k++)
			copy->setScanRangeValidity(valid[(2 * k + 1) * valid.size() / (2 * beams)], true);
	}
	mrpt::maps::CPointsMap::TInsertionOptions all;
	all.minDistBetweenLaserPoints = 0;
	all.isPlanarMap = true;
	(void)copy->buildAuxPointsMap<mrpt::maps::CPointsMap>(&all);
	return copy;
}

}  // namespace ridgemap::apps
