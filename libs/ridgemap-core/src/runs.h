// SPDX-License-Identifier: BSD-3-Clause
// Which stretches of a wall are straight or circular.
#pragma once

#include <ridgemap/types.h>

#include <vector>

#include "run_fit.h"

namespace ridgemap
{
/** A stretch of wall: samples [from, to), and the curve fitted to them unless it is a free one. */
struct Run
{
	WallShape shape = WallShape::curve;
	std::size_t from = 0, to = 0;
	FittedCurve curve;
};

/** What findRuns() goes by, in samples. Samples are a quarter of the width of the density apart. */
struct RunRules
{
	std::size_t least = 32;       ///< shortest run
	std::size_t leastWhole = 4;   ///< shortest run that is all of its wall from corner to corner
	double largestCurvature = 1;  ///< of an arc [1/m]
	bool bounded = false;         ///< corners or junctions on both sides
};

/** Samples that count as one, as their kernels overlap. */
constexpr double samplesPerIndependent = 10;

/** How much more the samples vary about short parabolas than their variances say, as a factor on their errors, 1 or
 * more: on real maps errors of the poses come on top of the noise. 1 where there are too few samples to tell. */
double excessError(const std::vector<WallSample>& samples);

/** Parts the samples into runs, in order and without gaps. A run is as long as the samples stay within three standard
 * errors of one line or arc. */
std::vector<Run> findRuns(const std::vector<WallSample>& samples, const RunRules& rules);

}  // namespace ridgemap
