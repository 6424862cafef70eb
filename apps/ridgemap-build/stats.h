// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/CRidgeMap2D.h>

#include <iosfwd>
#include <string>

#include "builder.h"
#include "outputs.h"

namespace ridgemap::apps
{
/** Median, 99 % and maximum of times. */
struct TimeFigures
{
	double median = 0, p99 = 0, max = 0, sum = 0;  ///< [ms]
};
TimeFigures figuresOf(std::vector<double> milliseconds);

/** Writes PREFIX_stats.json: all options and figures of a run. Only the times in it differ between equal runs. */
void writeStats(std::ostream& out, const CRidgeMap2D& map, const Builder& builder, const Feed& feed, double seconds,
				const Outputs::FileSizes& sizes);

/** The summary for people, on stdout. */
void printSummary(const CRidgeMap2D& map, const Builder& builder, bool everyScan, double seconds,
				  const Outputs& outputs);

}  // namespace ridgemap::apps
