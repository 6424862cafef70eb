// SPDX-License-Identifier: BSD-3-Clause
// What a sensor on a robot sees of a scene.
#pragma once

#include <cstdint>
#include <vector>

#include "random.h"
#include "scene.h"

namespace ridgemap::apps
{
/** Where the robot is, map frame. */
struct Pose
{
	double x = 0, y = 0;  ///< [m]
	double phi = 0;       ///< [rad]
	double time = 0;      ///< since the start [s]
};

/** Standard deviation of a measurement at a distance r from the sensor: constant + perMetre * r [m]. */
struct NoiseModel
{
	double constant = 0, perMetre = 0;
	double at(double r) const { return constant + perMetre * r; }
};

/** The sensor of section VI-A: in every cycle a Poisson number of measurements, spread over the visible surface in
 * proportion to the cross-section that it shows to the sensor. */
struct PaperSensor
{
	double view = 4;                      ///< the surface is seen up to this distance [m]
	double rate = 150;                    ///< mean number of measurements per cycle
	NoiseModel depth{0.01, 0.01};         ///< along the line of sight
	NoiseModel transverse{0.005, 0.005};  ///< across it
	double outliers = 0;                  ///< share of measurements that lie anywhere in view, 0 .. 1
};

/** A scanner with evenly spaced beams. */
struct LidarSensor
{
	int beams = 361;
	double fieldOfView = 4.71238898038469;  ///< [rad]
	double maxRange = 20;                   ///< [m]
	NoiseModel range{0.02, 0};              ///< of the range
	double outliers = 0;                    ///< share of beams that return any range, 0 .. 1
};

/** Simulates the cycles of a drive. Everything is a function of scene and seed. */
class Simulator
{
 public:
	Simulator(const Scene& scene, std::uint64_t seed);

	/** Measurements of one cycle, with the sensor position. Marks the surface in view as seen. */
	std::vector<Measurement> measure(const PaperSensor& sensor, const Pose& pose);

	/** Ranges of one scan from right to left; 0 for a beam without return. Marks the surface in view as seen. */
	std::vector<double> scan(const LidarSensor& sensor, const Pose& pose);

	/** The surfaces that are there all the time, cut where seen and unseen parts meet (to 2 cm). */
	std::vector<Segment> truth() const;

 private:
	struct Piece
	{
		std::size_t surface;
		double from, to;  ///< shares of the surface
		Point2 centre;
		bool seen;
	};
	/** A pane that a beam comes to. */
	struct Pane
	{
		double range;     ///< [m]
		double returned;  ///< share of beams along this one that come back
	};
	/** Range to the first mover or surface along a unit direction that lets no beam pass, infinite if there is none. */
	double cast(const Point2& origin, double dx, double dy, double time) const;
	/** What lets some beams pass, up to a range, the nearest first. */
	std::vector<Pane> panes(const Point2& origin, double dx, double dy, double time, double range) const;
	/** Range from which a beam comes back, infinite if it does not. */
	double echo(const Point2& origin, double dx, double dy, double time);
	std::vector<Piece*> look(const Pose& pose, double range, double halfAngle);
	/** Share of beams towards the middle of a piece that come back from it. */
	double returnedFrom(const Piece& piece, const Pose& pose) const;
	Measurement sample(const PaperSensor& sensor, const Pose& pose, const Piece& piece);

	const Scene scene_;
	Random random_;
	std::vector<Piece> pieces_;
};

/** Poses along the path of the scene, `spacing` metres apart at `speed` [m/s], looking ahead. A path of one point gives
 * one pose. */
std::vector<Pose> posesAlong(const std::vector<Point2>& path, double spacing, double speed);

}  // namespace ridgemap::apps
