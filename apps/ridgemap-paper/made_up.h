// SPDX-License-Identifier: BSD-3-Clause
// Made-up data and the statistics of what became of them.
#pragma once

#include <ridgemap/ridge_map.h>

#include <vector>

#include "../common/random.h"
#include "../common/segment.h"
#include "../common/simulator.h"

namespace ridgemap::apps
{
/** Options with the density of the paper: one for measurements from all viewing directions. */
Options paperOptions(double sigma);

/** A Poisson process on a wall: `density` measurements per metre, normal noise in x and in y. */
void addWall(std::vector<Measurement>& points, const Segment& wall, double density, double noise, Random& random);

/** Measurements of the hallway of Fig. 2, cycle by cycle. */
struct HallwayDrive
{
	Scene scene;
	std::vector<Pose> poses;
	std::vector<std::vector<Measurement>> cycles;
	std::vector<Segment> truth;

	std::vector<Measurement> all() const;
};
HallwayDrive driveHallway(double rate, std::uint64_t seed, double spacing = 0.25);

std::vector<Point2> pointsOf(const std::vector<Measurement>& measurements);

/** Part of the polylines inside a box, each clipped to stretches between nodes inside of it. */
std::vector<Polyline> clipped(const std::vector<Polyline>& polylines, const Box2& box);

/** Mean and standard error of independent values. */
struct Mean
{
	double value = 0, error = 0;
};
Mean meanOf(const std::vector<double>& values);

/** The value below which a share of all values lie; the greatest for a share of 1. */
double quantile(std::vector<double> values, double share);

/** Straight line through points with equal weights. */
struct LineFit
{
	double slope = 0, slopeError = 0, intercept = 0;
};
LineFit fitLine(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace ridgemap::apps
