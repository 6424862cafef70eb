// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>
#include <ridgemap/map_options.h>
#include <ridgemap/types.h>

#include <vector>

namespace ridgemap
{
/** Whether observationToMeasurements() knows the class of the observation: CObservation2DRangeScan,
 * CObservation3DRangeScan, CObservationVelodyneScan, CObservationPointCloud and CObservationRange. */
bool canConvertToMeasurements(const mrpt::obs::CObservation& obs);

/** The surface points that an observation saw, each with the position of its sensor, in the map frame.
 *
 * MRPT's own conversion gives the points in the vehicle frame, in single precision; the pose of the vehicle is composed
 * in double precision, so that places far from the origin lose nothing and the same arguments give the same numbers.
 * Points that are not finite, nearer than minRange (or at no distance at all, or behind the sensor) or farther than
 * maxRange are left out; so are points of 3-D sensors outside of [minZ, maxZ], except for clouds that are a level
 * slice (all points within 1 mm of one height), which are treated as 2-D scans. A 2-D scan whose plane is inclined by
 * more than planarityTolerance gives nothing.
 *
 * @return empty for an observation without usable points and for unknown classes.
 * Thread-safe as long as nobody else loads or changes the observation. Throws std::exception if data stored outside of
 * the observation cannot be read. */
std::vector<Measurement> observationToMeasurements(const mrpt::obs::CObservation& obs,
												   const mrpt::poses::CPose3D& robotPose,
												   const TInsertionOptions& options);

/** Beams of a 2-D scan that met nothing, as rays in the map frame up to options.freeRayRange or the range of the
 * sensor, whichever is less; none while freeRayRange is 0, and none for other observations. A beam met nothing if its
 * range is infinite, or at least the maximum range of the sensor or options.maxRange. Ranges that are 0, negative or
 * NaN are unknown and say nothing. */
std::vector<FreeRay> observationToFreeRays(const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& robotPose,
										   const TInsertionOptions& options);

/** All that an observation says about surfaces and free space. */
struct ObservedScan
{
	double time = 0;  ///< of the observation [s since 1970]
	std::vector<Measurement> measurements;
	std::vector<FreeRay> freeRays;

	bool empty() const { return measurements.empty() && freeRays.empty(); }
};
ObservedScan observedScan(const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& robotPose,
						  const TInsertionOptions& options);

}  // namespace ridgemap
