// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "../common/segment.h"
#include "contestant.h"

namespace ridgemap::apps
{
/** Widths of the bars of the histograms, and how many there are; the last one holds all that is beyond. */
constexpr double barWidth = 0.005;
constexpr std::size_t bars = 21;

/** Distances of points to something. */
struct Distances
{
	std::size_t count = 0;
	double rms = 0, median = 0;  ///< rms of those below 0.1 m [m]
	double beyond = 0;           ///< share above 0.1 m
	std::vector<double> histogram;
};

/** Durations of equal tasks [us]. */
struct Times
{
	double cold = 0;  ///< the first one, which builds what queries need
	double median = 0, p99 = 0;
	double growth = 1;  ///< median of the last tenth over the median of the first tenth
};

/** All figures of one map. */
struct Figures
{
	std::string name;
	std::size_t memory = 0, serialized = 0, compressed = 0;  ///< [bytes]
	Times insertion, likelihood, matching;
	Distances surface;        ///< surface of the map to the truth
	double completeness = 0;  ///< share of the seen truth with a surface within 3 cm
	Distances heldOut;        ///< ends of scans that the map was built without
};

/** Builds the map of all scans in `map` and measures everything but heldOut. The truth may be empty. */
Figures measure(Contestant& map, const std::vector<PosedScan>& scans, const std::vector<Segment>& truth);

/** Builds `folds` maps, each without one scan in `folds`, and looks at the scans left out. */
Distances crossValidate(const Contestant& kind, const std::vector<PosedScan>& scans, std::size_t folds);

}  // namespace ridgemap::apps
