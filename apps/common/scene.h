// SPDX-License-Identifier: BSD-3-Clause
// Made-up surroundings of a robot.
#pragma once

#include <string>
#include <vector>

#include "segment.h"

namespace ridgemap::apps
{
/** A round thing that goes from a to b and back, again and again. */
struct Mover
{
	double radius = 0;  ///< [m]
	double speed = 0;   ///< [m/s]
	Point2 a, b;

	Point2 at(double time) const;
};

/** Surfaces, the way of the robot, and what moves. Map frame [m]. */
struct Scene
{
	std::vector<Segment> surfaces;  ///< arcs are chords within 10 um of the arc
	std::vector<Point2> path;       ///< corners of the way
	std::vector<Mover> movers;

	void addWall(Point2 a, Point2 b) { surfaces.push_back({a, b}); }
	/** Counter-clockwise from one angle to the other [rad]. */
	void addArc(Point2 centre, double radius, double from, double to);
};

/** Fig. 2 of the paper: a hallway 6 m wide with a corner of 90 degrees, and a way past both of its corners. */
Scene hallwayScene();
/** A straight wall of 10 m, seen from 2 m. */
Scene wallScene();
/** Two walls of 5 m at a right angle, seen from inside. */
Scene cornerScene();

/** Reads a scene: lines `wall x1 y1 x2 y2`, `arc cx cy radius from to` (degrees, counter-clockwise), `path x1 y1 x2 y2
 * ...`, `mover radius speed x1 y1 x2 y2`; `#` starts a comment. Throws UserError with file and line. */
Scene readScene(const std::string& path);

/** Reads the true surface that ridgemap-simulate wrote: lines `x1,y1,x2,y2[,seen]`, or, from other programs,
 * `x1 y1 x2 y2 number name`, of which all is taken to be seen. Throws UserError with file and line. */
std::vector<Segment> readTruth(const std::string& path);

/** Writes the file that readTruth() reads, coordinates with 17 digits. */
void writeTruth(std::ostream& out, const std::vector<Segment>& truth);

}  // namespace ridgemap::apps
