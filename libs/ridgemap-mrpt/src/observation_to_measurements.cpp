// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <ridgemap/observation_to_measurements.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "beam_direction.h"

namespace ridgemap
{
namespace
{
using mrpt::math::TPoint3D;
using mrpt::poses::CPose3D;

constexpr double pi = 3.14159265358979323846;

/** Points in the frame of `pose` (vehicle or sensor) and where the sensor is in that frame. */
struct SensedPoints
{
	std::vector<TPoint3D> points;
	CPose3D pose;             ///< of the frame of the points, map frame
	TPoint3D sensor;          ///< in the frame of the points
	bool heightBand = false;  ///< points of a 3-D sensor
};

/** Collects measurements under the options: range, height and distance to the point before. */
class Collector
{
 public:
	explicit Collector(const TInsertionOptions& options) : options_(options) {}

	void add(const SensedPoints& sensed)
	{
		const bool band = sensed.heightBand && !isLevelSlice(sensed);
		const TPoint3D sensor = sensed.pose.composePoint(sensed.sensor);
		for (const auto& p : sensed.points)
		{
			const double range = (p - sensed.sensor).norm();
			if (!(range > 0 && range >= options_.minRange && range <= options_.maxRange)) continue;
			const TPoint3D g = sensed.pose.composePoint(p);
			if (band && !(g.z >= options_.minZ && g.z <= options_.maxZ)) continue;
			addPoint(g, sensor);
		}
	}

	std::vector<Measurement> take() { return std::move(measurements_); }

 private:
	static bool isLevelSlice(const SensedPoints& sensed)
	{
		constexpr double tolerance = 1e-3;
		double low = std::numeric_limits<double>::infinity(), high = -low;
		for (const auto& p : sensed.points)
		{
			const double z = sensed.pose.composePoint(p).z;
			if (!std::isfinite(z)) continue;
			low = std::min(low, z);
			high = std::max(high, z);
			if (high - low > tolerance) return false;
		}
		return true;
	}

	void addPoint(const TPoint3D& p, const TPoint3D& sensor)
	{
		if (options_.minDistBetweenPoints > 0 && !measurements_.empty())
		{
			const Measurement& last = measurements_.back();
			if (std::hypot(p.x - last.x, p.y - last.y) < options_.minDistBetweenPoints) return;
		}
		measurements_.push_back({p.x, p.y, sensor.x, sensor.y});
	}

	const TInsertionOptions& options_;
	std::vector<Measurement> measurements_;
};

/** MRPT's own conversion, in the vehicle frame. Without a least distance between points: MRPT compares with points that
 * may themselves have been left out. */
std::vector<TPoint3D> convertByMrpt(const mrpt::obs::CObservation& obs)
{
	mrpt::maps::CSimplePointsMap scratch;
	scratch.insertionOptions.minDistBetweenLaserPoints = 0;
	scratch.insertObservation(obs);
	const auto &x = scratch.getPointsBufferRef_x(), &y = scratch.getPointsBufferRef_y(),
			   &z = scratch.getPointsBufferRef_z();
	std::vector<TPoint3D> points(x.size());
	for (std::size_t i = 0; i < x.size(); i++) points[i] = {x[i], y[i], z[i]};
	return points;
}

std::vector<TPoint3D> zip(const std::vector<float>& x, const std::vector<float>& y, const std::vector<float>& z)
{
	std::vector<TPoint3D> points(std::min({x.size(), y.size(), z.size()}));
	for (std::size_t i = 0; i < points.size(); i++) points[i] = {x[i], y[i], z[i]};
	return points;
}

/** The plane of a scan is about horizontal. */
bool isLevel(const CPose3D& sensor, const TInsertionOptions& options)
{
	const double up = std::abs(sensor.getRotationMatrix()(2, 2));
	return up >= std::cos(options.planarityTolerance * pi / 180) - 1e-12;
}

void convert(const mrpt::obs::CObservation2DRangeScan& scan, const CPose3D& robotPose, const TInsertionOptions& options,
			 Collector& out)
{
	if (!isLevel(robotPose + scan.sensorPose, options)) return;
	if (scan.getScanSize() == 1)  // MRPT refuses these
	{
		std::vector<TPoint3D> points;
		const double range = scan.getScanRange(0);
		const Point2 u = beamDirection(scan, 0);
		if (scan.getScanRangeValidity(0) && range > 0 && range < double(scan.maxRange))
			points.push_back(scan.sensorPose.composePoint({range * u.x, range * u.y, 0}));
		out.add({points, robotPose, scan.sensorPose.translation(), false});
		return;
	}
	// Negative ranges would come out as points behind the sensor, like good ones: they are ruled out beforehand.
	mrpt::obs::CObservation2DRangeScan cleaned = scan;
	for (std::size_t i = 0; i < cleaned.getScanSize(); i++)
		if (!(cleaned.getScanRange(i) > 0 && std::isfinite(cleaned.getScanRange(i))))
			cleaned.setScanRangeValidity(i, false);
	out.add({convertByMrpt(cleaned), robotPose, scan.sensorPose.translation(), false});
}

void convert(const mrpt::obs::CObservation3DRangeScan& scan, const CPose3D& robotPose, const TInsertionOptions&,
			 Collector& out)
{
	scan.load();
	SensedPoints sensed{{}, robotPose + scan.sensorPose, {}, true};
	if (scan.hasPoints3D)
		// MRPT's points map would drop the point after each invalid one, so the stored points are taken as they are.
		sensed.points = zip(scan.points3D_x, scan.points3D_y, scan.points3D_z);
	else if (scan.hasRangeImage)
	{
		mrpt::maps::CSimplePointsMap scratch;
		mrpt::obs::CObservation3DRangeScan copy = scan;  // unprojecting is not const
		copy.unprojectInto(scratch);
		sensed.points.resize(scratch.size());
		for (std::size_t i = 0; i < scratch.size(); i++) scratch.getPoint(i, sensed.points[i]);
	}
	out.add(sensed);
}

void convert(const mrpt::obs::CObservationVelodyneScan& scan, const CPose3D& robotPose, const TInsertionOptions&,
			 Collector& out)
{
	SensedPoints sensed{{}, robotPose + scan.sensorPose, {}, true};
	if (scan.point_cloud.size() > 0)
		sensed.points = zip(scan.point_cloud.x, scan.point_cloud.y, scan.point_cloud.z);
	else
	{
		mrpt::obs::CObservationVelodyneScan copy = scan;  // generating the cloud is not const
		copy.generatePointCloud();
		sensed.points = zip(copy.point_cloud.x, copy.point_cloud.y, copy.point_cloud.z);
	}
	out.add(sensed);
}

void convert(const mrpt::obs::CObservationPointCloud& cloud, const CPose3D& robotPose, const TInsertionOptions&,
			 Collector& out)
{
	cloud.load();
	if (!cloud.pointcloud) return;
	// MRPT before 2.11.3 ignores the pose of the robot here.
	SensedPoints sensed{{}, robotPose + cloud.sensorPose, {}, true};
	sensed.points.resize(cloud.pointcloud->size());
	for (std::size_t i = 0; i < sensed.points.size(); i++) cloud.pointcloud->getPoint(i, sensed.points[i]);
	out.add(sensed);
}

void convert(const mrpt::obs::CObservationRange& sonar, const CPose3D& robotPose, const TInsertionOptions&,
			 Collector& out)
{
	// One by one, for each echo has a sensor of its own. MRPT spreads an echo over its cone.
	// A cone beyond half a turn is no surface, and would take points without end.
	if (!(sonar.sensorConeApperture >= 0 && sonar.sensorConeApperture <= pi)) return;
	for (const auto& echo : sonar.sensedData)
	{
		if (!(echo.sensedDistance > 0 && std::isfinite(echo.sensedDistance))) continue;
		if (echo.sensedDistance < sonar.minSensorDistance || echo.sensedDistance > sonar.maxSensorDistance) continue;
		const CPose3D sensorPose(echo.sensorPose);
		SensedPoints sensed{{}, robotPose, sensorPose.translation(), false};
		if (sonar.sensorConeApperture < 1e-6)
			sensed.points.push_back(sensorPose.composePoint({echo.sensedDistance, 0, 0}));  // MRPT gives nothing
		else
		{
			mrpt::obs::CObservationRange single;
			single.minSensorDistance = sonar.minSensorDistance;
			single.maxSensorDistance = sonar.maxSensorDistance;
			single.sensorConeApperture = sonar.sensorConeApperture;
			single.sensedData.push_back(echo);
			sensed.points = convertByMrpt(single);
		}
		out.add(sensed);
	}
}

/** Calls convert() for the class of the observation; false if there is none. */
template <class T>
bool convertIf(const mrpt::obs::CObservation& obs, const CPose3D& robotPose, const TInsertionOptions& options,
			   Collector& out)
{
	const auto* known = dynamic_cast<const T*>(&obs);
	if (known) convert(*known, robotPose, options, out);
	return known != nullptr;
}
}  // namespace

bool canConvertToMeasurements(const mrpt::obs::CObservation& obs)
{
	using namespace mrpt::obs;
	return dynamic_cast<const CObservation2DRangeScan*>(&obs) || dynamic_cast<const CObservation3DRangeScan*>(&obs) ||
		   dynamic_cast<const CObservationVelodyneScan*>(&obs) || dynamic_cast<const CObservationPointCloud*>(&obs) ||
		   dynamic_cast<const CObservationRange*>(&obs);
}

std::vector<Measurement> observationToMeasurements(const mrpt::obs::CObservation& obs, const CPose3D& robotPose,
												   const TInsertionOptions& options)
{
	using namespace mrpt::obs;
	Collector out(options);
	convertIf<CObservation2DRangeScan>(obs, robotPose, options, out) ||
		convertIf<CObservation3DRangeScan>(obs, robotPose, options, out) ||
		convertIf<CObservationVelodyneScan>(obs, robotPose, options, out) ||
		convertIf<CObservationPointCloud>(obs, robotPose, options, out) ||
		convertIf<CObservationRange>(obs, robotPose, options, out);
	return out.take();
}

std::vector<FreeRay> observationToFreeRays(const mrpt::obs::CObservation& obs, const CPose3D& robotPose,
										   const TInsertionOptions& options)
{
	std::vector<FreeRay> rays;
	const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&obs);
	if (!scan || !(options.freeRayRange > 0)) return rays;
	const CPose3D sensor = robotPose + scan->sensorPose;
	if (!isLevel(sensor, options)) return rays;
	const double sensorRange = scan->maxRange > 0 ? double(scan->maxRange) : options.freeRayRange;
	const double farthest = std::min(sensorRange, options.maxRange), free = std::min(sensorRange, options.freeRayRange);
	for (std::size_t i = 0; i < scan->getScanSize(); i++)
	{
		if (!(double(scan->getScanRange(i)) >= farthest)) continue;
		const Point2 u = beamDirection(*scan, i);
		const TPoint3D end = sensor.composePoint({free * u.x, free * u.y, 0});
		rays.push_back({sensor.x(), sensor.y(), end.x, end.y});
	}
	return rays;
}

ObservedScan observedScan(const mrpt::obs::CObservation& obs, const CPose3D& robotPose,
						  const TInsertionOptions& options)
{
	return {mrpt::Clock::toDouble(obs.timestamp), observationToMeasurements(obs, robotPose, options),
			observationToFreeRays(obs, robotPose, options)};
}

}  // namespace ridgemap
