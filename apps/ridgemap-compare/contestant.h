// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <ridgemap/map_options.h>
#include <ridgemap/types.h>

#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "scans.h"

namespace ridgemap::apps
{

/** Part of the map in a picture. */
struct View
{
	Box2 box;          ///< [m]
	double scale = 1;  ///< [pixels/m]

	double px(double x) const { return (x - box.min.x) * scale; }
	double py(double y) const { return (box.max.y - y) * scale; }
};

/** A map that takes part in the comparison. */
class Contestant
{
 public:
	virtual ~Contestant() = default;

	/** Takes in a scan completely: afterwards, queries see it. */
	virtual void insert(const PosedScan& s) = 0;
	virtual const mrpt::maps::CMetricMap& map() const = 0;
	/** A smaller map that is good for localisation only; null if there is none. */
	virtual mrpt::maps::CMetricMap::Ptr forLocalization() const { return nullptr; }
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

/** Makes empty maps of one kind. */
struct ContestantKind
{
	std::string name;
	std::function<std::unique_ptr<Contestant>()> make;
};

/** What the maps are told in advance. */
struct Surroundings
{
	Box2 box;                   ///< what a grid will have to hold, so that it never grows
	bool madeOfPoints = false;  ///< some scans come from scanOfCloud()
};

/** The ridge map, the grids with 5, 2 and 1 cm, each with MRPT's beam angles and with the right ones, and the points
 * map; all with the likelihood of FilterSettings. Scans made of points have no beam angles to be wrong about. */
std::vector<ContestantKind> contestantKinds(const MapOptions& options, const Surroundings& around);

}  // namespace ridgemap::apps
