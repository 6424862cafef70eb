// SPDX-License-Identifier: BSD-3-Clause
// Made-up surroundings of a robot.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "segment.h"

namespace ridgemap::apps
{
/** When a thing is there [s since the start]: from the first to before the second. */
struct Presence
{
	double from = 0, to = std::numeric_limits<double>::infinity();

	bool always() const { return from <= 0 && !std::isfinite(to); }
	bool at(double time) const { return time >= from && time < to; }
};

/** A straight piece of surface. */
struct Surface
{
	Segment shape;
	Presence when;
	double returned = 1;                   ///< share of beams that come back from it, 0 .. 1; the others pass: glass
	double widest = 0.5 * 3.141592653589;  ///< beams at greater angles to its normal pass in any case [rad]

	/** All beams come back. */
	bool opaque() const { return returned >= 1 && widest >= Surface().widest; }
	/** Share of the beams along a unit direction that come back. */
	double returnedAlong(double dx, double dy) const;
};

/** A round thing that goes from a to b and back, again and again. */
struct Mover
{
	double radius = 0;  ///< [m]
	double speed = 0;   ///< [m/s]
	Point2 a, b;
	Presence when;

	Point2 at(double time) const;
};

/** Surfaces, the way of the robot, and what moves. Map frame [m]. */
struct Scene
{
	std::vector<Surface> surfaces;  ///< arcs are chords within 10 um of the arc
	std::vector<Point2> path;       ///< corners of the way
	std::vector<Mover> movers;

	void addWall(Point2 a, Point2 b) { surfaces.push_back({{a, b}, {}}); }
	/** Counter-clockwise from one angle to the other [rad]. */
	void addArc(Point2 centre, double radius, double from, double to);
	/** Round posts from a on towards b, the last one not beyond it. */
	void addPosts(double radius, double spacing, Point2 a, Point2 b);
};

/** Fig. 2 of the paper: a hallway 6 m wide with a corner of 90 degrees, and a way past both of its corners. */
Scene hallwayScene();
/** A straight wall of 10 m, seen from 2 m. */
Scene wallScene();
/** Two walls of 5 m at a right angle, seen from inside. */
Scene cornerScene();

/** Reads a scene: lines `wall x1 y1 x2 y2`, `arc cx cy radius from to` (degrees, counter-clockwise), `glass share angle
 * x1 y1 x2 y2` (returns this share of the beams that come within that angle [degrees] of its normal), `posts radius
 * spacing x1 y1 x2 y2` (a row of round posts), `path x1 y1 x2 y2 ...`, `mover radius speed x1 y1 x2 y2`; in front of
 * all but the path, `during from to` says when it is there [s]. `#` starts a comment. Throws UserError with file and
 * line. */
Scene readScene(const std::string& path);

/** Reads the true surface that ridgemap-simulate wrote: lines `x1,y1,x2,y2[,seen]`, or, from other programs,
 * `x1 y1 x2 y2 number name`, of which all is taken to be seen. Throws UserError with file and line. */
std::vector<Segment> readTruth(const std::string& path);

/** Writes the file that readTruth() reads, coordinates with 17 digits. */
void writeTruth(std::ostream& out, const std::vector<Segment>& truth);

}  // namespace ridgemap::apps
