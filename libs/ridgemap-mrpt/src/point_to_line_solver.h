// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/point_to_line_matching.h>

namespace ridgemap
{
/** Gauss-Newton with one scale of the weights [m], until a step is shorter than `enough` [m, rad]. */
Alignment descend(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& start,
				  const MatchingGate& gate, double scale, double enough, const TMatchingOptions& options);

/** How well points lie on the targets. */
struct Fit
{
	Fit() = default;
	Fit(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& pose, bool sides);

	/** How well the points lie on the targets, by how well they do at another pose; of the points only that have
	 * targets at both: where the robot looks into what the map does not hold yet, a pose further back would find more
	 * targets, and yet be wrong. Negative if these are less than half of those that have targets at the other pose. */
	double relativeTo(const Fit& o) const;

	double score = 0;           ///< see Alignment::score
	std::vector<double> terms;  ///< by point, 1/(1 + (d/0.05 m)^2); 0: no target within reach
};

/** The direction of travel that the points say least about, such as along a hallway. Unit length. */
Point2 weakestDirection(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& pose,
						const MatchingGate& gate, double scale, bool sides);

}  // namespace ridgemap
