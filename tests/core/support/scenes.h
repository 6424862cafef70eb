// SPDX-License-Identifier: BSD-3-Clause
// Measurements of made-up surfaces.
#pragma once

#include <ridgemap/options.h>
#include <ridgemap/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "random.h"

namespace ridgemap::test
{
/** Measures shapes. All lengths of its functions are in units of sigma; the measurements come out in metres. */
class SceneBuilder
{
 public:
	/** @param noise standard deviation of a measurement in x and in y [sigma]
	 * @param density measurements per sigma of surface */
	SceneBuilder(std::uint64_t seed, double sigma, double noise, double density)
		: random_(seed), sigma_(sigma), noise_(noise), density_(density)
	{
	}

	SceneBuilder& wall(Point2 a, Point2 b);
	SceneBuilder& arc(Point2 centre, double radius, double fromAngle, double toAngle);
	SceneBuilder& circle(Point2 centre, double radius);
	SceneBuilder& outliers(std::size_t count, Point2 low, Point2 high);

	/** Everything added so far, turned about the origin and then shifted. */
	std::vector<Measurement> finish(Point2 shift = {}, double turn = 0) const;

 private:
	void add(Point2 p);

	Random random_;
	double sigma_, noise_, density_;
	std::vector<Point2> points_;
};

/** A scene with everything that makes ridges difficult: walls, corners, arcs, circles, T and X junctions, outliers,
 * at a random scale, place and angle. */
struct RandomScene
{
	std::uint64_t seed = 0;
	double sigma = 0.05;
	std::string what;  ///< parts, for reports
	std::vector<Measurement> measurements;

	/** The defaults at the scale of the scene. */
	Options options() const
	{
		Options o;
		o.sigma = sigma;
		return o;
	}
};
/** @param size how many parts; each has a surface of 20-60 sigma */
RandomScene randomScene(std::uint64_t seed, int size = 4);

/** Evenly spaced measurements without noise on the segment a-b, both ends included [m]. */
std::vector<Measurement> exactWall(Point2 a, Point2 b, double spacing);

/** Value of an environment variable that is a positive number, or the default. */
int fromEnvironment(const char* name, int byDefault);

}  // namespace ridgemap::test
