// SPDX-License-Identifier: BSD-3-Clause
// How far a map is from the true surface (paper section VI, equation (9)).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "segment.h"

namespace ridgemap::apps
{
/** Integral and maximum of the distance to the truth along pieces of a map. */
struct DistanceSum
{
	double length = 0;          ///< [m]
	double squareIntegral = 0;  ///< of the squared distance to the nearest true point [m^3]
	double maximum = 0;         ///< greatest distance [m]

	/** Root mean square distance, equation (9) [m]; 0 for no length. */
	double rmsd() const { return length > 0 ? std::sqrt(squareIntegral / length) : 0; }
	DistanceSum& operator+=(const DistanceSum& o);
};

/** The distance from a-b to the nearest of the true segments, integrated in closed form: the squared distance to each
 * of them is a quadratic in three stretches, and the lower envelope of all is taken. O(m^3) in the m true segments that
 * can be nearest somewhere on a-b. */
DistanceSum integrateDistance(const Point2& a, const Point2& b, const std::vector<Segment>& truth);

/** What counts as right. */
struct EvaluationSettings
{
	double within = 0.1;        ///< a map point this far from the truth, and the other way round, is a hit [m]
	double cornerRadius = 1;    ///< what is this near to a corner counts as `corners` [m]
	double cornerAngle = 0.35;  ///< true segments that share an end and turn by more form a corner [rad]
};

/** Figures of one polyline. */
struct PolylineEvaluation
{
	DistanceSum distance;
	DistanceSum right;  ///< of this, what is within reach of the truth
};

/** Figures of a map. */
struct Evaluation
{
	std::vector<PolylineEvaluation> polylines;  ///< in the order of the map
	DistanceSum all;                            ///< length-weighted over all polylines
	DistanceSum corners, straight;              ///< of these, near to corners and elsewhere
	DistanceSum right;                          ///< of these, what is within reach of the truth
	std::size_t cornerCount = 0;                ///< true corners

	double truthLength = 0;                                ///< true surface that was seen [m]
	double truthCovered = 0;                               ///< of this, with a map point within reach [m]
	double truthCornerLength = 0, truthCornerCovered = 0;  ///< the same near to corners [m]
	double spurious = 0;                                   ///< map farther from the truth than within reach [m]
	double duplicates = 0;      ///< map that lies beside a stretch of truth that the map has already [m]
	std::size_t surfaces = 0;   ///< connected true surfaces that were seen
	std::size_t fragments = 0;  ///< polylines that lie within reach of a surface, summed over the surfaces

	double completeness() const { return truthLength > 0 ? truthCovered / truthLength : 0; }
};

/** Compares a map with the truth, all of it in closed form. Throws std::invalid_argument for an empty truth. */
Evaluation evaluate(const std::vector<Polyline>& map, const std::vector<Segment>& truth,
					const EvaluationSettings& settings);

/** Ends of true segments at which the surface turns. */
std::vector<Point2> cornersOf(const std::vector<Segment>& truth, double leastAngle);

}  // namespace ridgemap::apps
