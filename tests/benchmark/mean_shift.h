// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <vector>

namespace ridgemap::benchmarks
{
/** What subspace-constrained mean shift came to. */
struct MeanShiftResult
{
	std::vector<Point2> points;   ///< on ridges, one for every measurement that got there
	std::size_t evaluations = 0;  ///< of the density and its derivatives
};

/** Plain subspace-constrained mean shift: every measurement climbs along the eigenvector across the ridge until it
 * moves by less than `tolerance` [m], with sums over all measurements within 5 sigma, found in a grid. */
MeanShiftResult meanShift(const std::vector<Measurement>& measurements, double sigma, double tolerance);

}  // namespace ridgemap::benchmarks
