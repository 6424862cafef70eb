// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>
#include <ridgemap/map_options.h>
#include <ridgemap/types.h>

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace ridgemap::apps
{
/** A scan and where the robot was. */
struct PosedScan
{
	mrpt::obs::CObservation2DRangeScan::Ptr scan;
	mrpt::poses::CPose3D pose;
};

/** Part of the map in a picture. */
struct View
{
	Box2 box;          ///< [m]
	double scale = 1;  ///< [pixels/m]

	double px(double x) const { return (x - box.min.x) * scale; }
	double py(double y) const { return (box.max.y - y) * scale; }
};

/** A kind of map that takes part in the comparison. */
class Contestant
{
 public:
	virtual ~Contestant() = default;

	virtual std::string name() const = 0;
	/** A new empty one of the same kind. */
	virtual std::unique_ptr<Contestant> fresh() const = 0;
	/** Takes in a scan completely: afterwards, queries see it. */
	virtual void insert(const PosedScan& s) = 0;
	virtual const mrpt::maps::CMetricMap& map() const = 0;
	/** Of the map itself, without what queries build [bytes]. */
	virtual std::size_t memory() const = 0;
	/** Points along its surface: every centimetre of a line, centres of occupied cells, points. */
	virtual std::vector<Point2> surface() const = 0;
	/** To the nearest point of its surface; infinite for an empty map [m]. Built by prepareDistances(). */
	virtual double distance(const Point2& p) const = 0;
	virtual void prepareDistances() {}
	/** Draws what the map knows onto a white picture. */
	virtual void draw(cv::Mat& picture, const View& view) const = 0;
};

/** The ridge map, the grids with 5, 2 and 1 cm, each with MRPT's beam angles and with the right ones, and the points
 * map. */
std::vector<std::unique_ptr<Contestant>> makeContestants(const MapOptions& options, const Box2& box);

}  // namespace ridgemap::apps
