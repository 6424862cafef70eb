// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "../common/segment.h"
#include "contestant.h"
#include "localization.h"

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

/** Processor time of equal tasks, over all threads [us]. */
struct Times
{
	double cold = 0;  ///< the first one, which builds what queries need
	double median = 0, p99 = 0;
	double growth = 1;  ///< median of the last tenth over the median of the first tenth
};

/** Durations of queries: the first time with a scan, and at once again. */
struct QueryTimes
{
	Times fresh;
	double again = 0;  ///< median [us]
};

/** All figures of one map. */
struct Figures
{
	std::string name;
	std::size_t memory = 0, serialized = 0, compressed = 0;  ///< [bytes]
	std::size_t heap = 0;     ///< what the program holds more after building and all queries, caches included [bytes]
	std::size_t onRobot = 0;  ///< compressed, of what localisation needs [bytes]
	Times insertion;
	QueryTimes likelihood, matching;
	Distances surface;        ///< surface of the map to the truth
	double completeness = 0;  ///< share of the seen truth with a surface within 3 cm
	Distances heldOut;        ///< ends of scans that the map was built without
	Localization localization;
	Localization onRobotLocalization;  ///< in the map of which onRobot is the size
};

/** What the maps are built of and measured with. */
struct Material
{
	std::vector<PosedScan> scans;
	std::vector<PosedScan> secondPass;  ///< to be localised in the map of all scans; may be empty
	std::vector<Segment> truth;         ///< may be empty
	std::size_t folds = 0;              ///< 0: no scans are held out
};

/** A map of all scans and its figures. */
struct Measured
{
	std::unique_ptr<Contestant> map;
	Figures figures;
};

/** Builds the map of all scans and measures it; with folds, builds that many further maps, each without one scan in
 * `folds`, and looks at the scans left out. Without a second pass, those that the first of these maps was built without
 * are localised in it. */
Measured measure(const ContestantKind& kind, const Material& material);

}  // namespace ridgemap::apps
