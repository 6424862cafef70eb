// SPDX-License-Identifier: BSD-3-Clause
#include "contestant.h"

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <ridgemap/CRidgeMap2D.h>

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "localization.h"

namespace ridgemap::apps
{
namespace
{
constexpr float occupied = 0.35f;          ///< cells below are part of the surface: probability of being free
constexpr double frozenTolerance = 0.005;  // [m]
constexpr double infinite = std::numeric_limits<double>::infinity();

cv::Point pixel(const View& v, const Point2& p)
{
	return {int(std::lround(v.px(p.x) * 16)), int(std::lround(v.py(p.y) * 16))};
}

double distanceToPoints(const mrpt::maps::CSimplePointsMap& points, const Point2& p)
{
	if (points.empty()) return infinite;
	float squared = 0;
	points.kdTreeClosestPoint2D(float(p.x), float(p.y), squared);
	return std::sqrt(double(squared));
}

class RidgeContestant : public Contestant
{
 public:
	explicit RidgeContestant(const MapOptions& options) : map_(options) {}

	void insert(const PosedScan& s) override
	{
		map_.insertObservation(*s.scan, s.pose);
		map_.update();
	}
	const mrpt::maps::CMetricMap& map() const override { return map_; }
	mrpt::maps::CMetricMap::Ptr forLocalization() const override
	{
		auto frozen = std::make_shared<CRidgeMap2D>(map_);
		frozen->freeze(frozenTolerance);
		return frozen;
	}
	std::size_t memory() const override { return map_.core().statistics().bytes; }
	double distance(const Point2& p) const override
	{
		const auto nearest = map_.nearestWallPoint(p);
		return nearest ? nearest->distance : infinite;
	}

	std::vector<Point2> surface() const override
	{
		std::vector<Point2> points;
		for (const Polyline& line : map_.walls())
			for (std::size_t i = 1; i < line.points.size(); i++)
			{
				const Point2 &a = line.points[i - 1], &b = line.points[i];
				const auto n = std::size_t(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / 0.01));
				for (std::size_t k = 0; k < n; k++)
				{
					const double t = (double(k) + 0.5) / double(n);
					points.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
				}
			}
		return points;
	}

	void draw(cv::Mat& picture, const View& view) const override
	{
		for (const Polyline& line : map_.walls())
		{
			std::vector<cv::Point> pixels;
			for (const Point2& p : line.points) pixels.push_back(pixel(view, p));
			cv::polylines(picture, pixels, false, cv::Scalar(96, 32, 16), 2, cv::LINE_AA, 4);
		}
	}

 private:
	CRidgeMap2D map_;
};

class GridContestant : public Contestant
{
 public:
	GridContestant(double resolution, bool rightAngles, const Surroundings& around, const FilterSettings& filter)
		: rightAngles_(rightAngles),
		  map_(float(around.box.min.x), float(around.box.max.x), float(around.box.min.y), float(around.box.max.y),
			   float(resolution))
	{
		map_.insertionOptions.maxDistanceInsertion = 80;
		// MRPT's default is true. Between the beams of scans made of points, nothing was measured.
		map_.insertionOptions.considerInvalidRangesAsFreeSpace = !around.madeOfPoints;
		auto& likelihood = map_.likelihoodOptions;
		likelihood.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
		likelihood.LF_decimation = 1;
		likelihood.LF_stdHit = float(filter.spread);
		likelihood.LF_zHit = float(filter.hit);
		likelihood.LF_zRandom = float(1 - filter.hit);
		likelihood.LF_maxRange = float(filter.range);
		likelihood.LF_maxCorrsDistance = float(filter.farthest);
	}

	void insert(const PosedScan& s) override
	{
		if (rightAngles_)
			map_.insertObservation(corrected(*s.scan), s.pose);
		else
			map_.insertObservation(*s.scan, s.pose);
	}
	const mrpt::maps::CMetricMap& map() const override { return map_; }
	std::size_t memory() const override
	{
		return std::size_t(map_.getSizeX()) * map_.getSizeY() * sizeof(mrpt::maps::COccupancyGridMap2D::cellType);
	}

	std::vector<Point2> surface() const override
	{
		std::vector<Point2> points;
		for (unsigned y = 0; y < map_.getSizeY(); y++)
			for (unsigned x = 0; x < map_.getSizeX(); x++)
				if (map_.getCell(int(x), int(y)) < occupied) points.push_back({map_.idx2x(x), map_.idx2y(y)});
		return points;
	}
	void prepareDistances() override
	{
		centres_.clear();
		for (const Point2& p : surface()) centres_.insertPointFast(float(p.x), float(p.y), 0);
		centres_.mark_as_modified();
	}
	double distance(const Point2& p) const override { return distanceToPoints(centres_, p); }

	void draw(cv::Mat& picture, const View& view) const override
	{
		for (int row = 0; row < picture.rows; row++)
			for (int column = 0; column < picture.cols; column++)
			{
				const double x = view.box.min.x + (column + 0.5) / view.scale;
				const double y = view.box.max.y - (row + 0.5) / view.scale;
				const int gray = int(255 * map_.getPos(float(x), float(y)));
				picture.at<cv::Vec3b>(row, column) = cv::Vec3b::all(std::uint8_t(gray));
			}
	}

 private:
	bool rightAngles_;
	mrpt::maps::COccupancyGridMap2D map_;
	mrpt::maps::CSimplePointsMap centres_;

	/** The grid spreads N beams over the aperture in steps of aperture/N from its edge, while they are aperture/(N-1)
	 * apart. With a greater aperture and a turned sensor its beams come to lie where they were. */
	static mrpt::obs::CObservation2DRangeScan corrected(const mrpt::obs::CObservation2DRangeScan& scan)
	{
		mrpt::obs::CObservation2DRangeScan out = scan;
		const double n = double(scan.getScanSize());
		if (n < 2) return out;
		const double step = double(scan.aperture) / (n - 1);
		out.aperture = float(step * n);
		out.sensorPose = scan.sensorPose + mrpt::poses::CPose3D(0, 0, 0, scan.rightToLeft ? step / 2 : -step / 2, 0, 0);
		return out;
	}
};

class PointsContestant : public Contestant
{
 public:
	PointsContestant(const Surroundings& around, const FilterSettings& filter)
	{
		// With a distance, MRPT leaves out points without a neighbour, too: of scans made of points, nearly all.
		map_.insertionOptions.minDistBetweenLaserPoints = around.madeOfPoints ? 0 : 0.02f;
		map_.insertionOptions.isPlanarMap = true;
		map_.likelihoodOptions.decimation = 1;
		map_.likelihoodOptions.max_corr_distance = filter.farthest;
		// It takes the mean of the squared distances where the others take the sum over the beams.
		map_.likelihoodOptions.sigma_dist = 2 * filter.spread * filter.spread / double(filter.beams);
	}
	void insert(const PosedScan& s) override { map_.insertObservation(*s.scan, s.pose); }
	const mrpt::maps::CMetricMap& map() const override { return map_; }
	std::size_t memory() const override { return map_.size() * 3 * sizeof(float); }
	double distance(const Point2& p) const override { return distanceToPoints(map_, p); }

	std::vector<Point2> surface() const override
	{
		std::vector<Point2> points;
		for (std::size_t i = 0; i < map_.size(); i++)
			points.push_back({map_.getPointsBufferRef_x()[i], map_.getPointsBufferRef_y()[i]});
		return points;
	}
	void draw(cv::Mat& picture, const View& view) const override
	{
		for (const Point2& p : surface())
			if (p.x > view.box.min.x && p.x < view.box.max.x && p.y > view.box.min.y && p.y < view.box.max.y)
				cv::circle(picture, pixel(view, p), 16, cv::Scalar(96, 32, 16), -1, cv::LINE_AA, 4);
	}

 private:
	mrpt::maps::CSimplePointsMap map_;
};
}  // namespace

std::vector<ContestantKind> contestantKinds(const MapOptions& options, const Surroundings& around)
{
	const FilterSettings filter;
	MapOptions ridge = options;
	ridge.likelihood.decimation = 1;
	ridge.likelihood.sigmaHit = filter.spread;
	ridge.likelihood.zHit = filter.hit;
	ridge.likelihood.zRand = 1 - filter.hit;
	ridge.likelihood.zMax = filter.range;
	ridge.likelihood.maxDistance = filter.farthest;
	std::vector<ContestantKind> kinds;
	kinds.push_back({"ridge map", [=] { return std::make_unique<RidgeContestant>(ridge); }});
	for (const bool rightAngles : {true, false})
		for (const int centimetres : {5, 2, 1})
		{
			if (!rightAngles && around.madeOfPoints) continue;
			const std::string remark = rightAngles ? "" : ", MRPT's beam angles";
			const auto make = [=]
			{ return std::make_unique<GridContestant>(0.01 * centimetres, rightAngles, around, filter); };
			kinds.push_back({"grid " + std::to_string(centimetres) + " cm" + remark, make});
		}
	kinds.push_back({"points map", [=] { return std::make_unique<PointsContestant>(around, filter); }});
	return kinds;
}

}  // namespace ridgemap::apps
