// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <string>
#include <vector>

#include "../ridgemap-build/inputs.h"

namespace ridgemap::apps
{
/** A scan and where the robot was. */
struct PosedScan
{
	mrpt::obs::CObservation2DRangeScan::Ptr scan;
	mrpt::poses::CPose3D pose;
};

/** The scans of an input, all poses turned about the origin. */
struct Scans
{
	std::vector<PosedScan> all;
	std::size_t fromClouds = 0;  ///< of these, how many were made of other observations by scanOfCloud()
};

/** A pose that turns the map by this angle [degrees]. */
mrpt::poses::CPose3D turnBy(double degrees);

/** Reads 2-D scans, and other observations with points as scans. Throws UserError for fewer than two. */
Scans readScans(const std::string& path, const PoseChoice& poses, double degrees);

/** A scan of 7200 beams around the sensor with every point on the free beam next to it, which moves a point at 4 m by
 * 2 mm at most while there are few. Occupancy grids take in nothing but scans. */
mrpt::obs::CObservation2DRangeScan::Ptr scanOfCloud(const mrpt::obs::CObservation& observation);

/** A copy with up to `beams` of its valid beams, evenly chosen; the others are invalid. Inside of it are its points as
 * MRPT's maps take them, all of them: left to themselves, the maps would put other choices of points there, made with
 * the options of the one that asks first, and leave out points without a neighbour. */
mrpt::obs::CObservation2DRangeScan::Ptr thinned(const mrpt::obs::CObservation2DRangeScan& scan, std::size_t beams);

}  // namespace ridgemap::apps
