// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <vector>

namespace ridgemap::benchmarks
{
struct SeenScan
{
	mrpt::obs::CObservation2DRangeScan::Ptr scan;
	mrpt::poses::CPose3D pose;
	mrpt::maps::CSimplePointsMap points;  ///< robot frame
};

/** The one-loop rawlog of Debian's package mrpt-common is there. */
bool hasOneLoop();

/** Its scans at the poses that icp-slam on a ridge map finds; made once. */
const std::vector<SeenScan>& oneLoop();

}  // namespace ridgemap::benchmarks
