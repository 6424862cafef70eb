// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <cstddef>
#include <vector>

namespace ridgemap
{
/** For every vertex i of a chain, the later vertices j, ascending, such that the segment from i to j is within the
 * tolerance of all vertices between them. The next vertex is always among them. Looks no farther than `reach` vertices
 * ahead. */
std::vector<std::vector<std::size_t>> shortcuts(const std::vector<Point2>& chain, double tolerance, std::size_t reach);

/** Sums over the vertices of a chain, for sums of squared distances to any segment in O(1). */
class DeviationSums
{
 public:
	explicit DeviationSums(const std::vector<Point2>& chain);

	/** Sum of the squared distances of the vertices between i and j to the line through these two [m^2]. */
	double between(std::size_t i, std::size_t j) const;

 private:
	struct Sums
	{
		double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
	};
	std::vector<Point2> chain_;  ///< relative to its first vertex
	std::vector<Sums> before_;   ///< over the vertices before each
};

}  // namespace ridgemap
