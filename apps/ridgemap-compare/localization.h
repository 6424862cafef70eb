// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMetricMap.h>

#include <vector>

#include "scans.h"

namespace ridgemap::apps
{
/** How each map is used by the particle filter, the same for all of them. Likelihood of a beam that ends at distance d
 * from the map: hit * exp(-d^2 / (2 spread^2)) + (1 - hit) / range, with d at most `farthest`. */
struct FilterSettings
{
	std::size_t runs = 3;         ///< with different random numbers; results are pooled
	std::size_t particles = 600;  ///< a fixed number
	std::size_t beams = 40;       ///< of each scan
	std::size_t settling = 5;     ///< first scans, which do not count
	double spread = 0.1;          ///< [m]
	double hit = 0.95;
	double range = 80;       ///< [m]
	double farthest = 0.3;   ///< [m]
	double start = 0.5;      ///< particles start evenly within this of the first pose, each way [m] ...
	double startAngle = 15;  ///< ... and this [degrees]
	double lost = 0.5;       ///< an estimate this far off is lost [m]
};

/** Error of the estimates (means of the particles) against the poses of the second pass. */
struct Localization
{
	std::size_t count = 0;       ///< of estimates, over all runs; 0: not measured
	double median = 0, p99 = 0;  ///< [m]
	double heading = 0;          ///< median [degrees]
	double lost = 0;             ///< share of estimates that are lost
};

/** Follows the robot through the map by CMonteCarloLocalization2D. Odometry is what the poses say with noise; it and
 * all other random numbers are the same for every map. The map must not be empty. */
Localization localise(const mrpt::maps::CMetricMap& map, const std::vector<PosedScan>& secondPass,
					  const FilterSettings& settings = FilterSettings());

}  // namespace ridgemap::apps
