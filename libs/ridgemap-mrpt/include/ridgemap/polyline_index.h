// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/KDTreeCapable.h>
#include <ridgemap/types.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace ridgemap
{
/** The point of a set of polylines that is nearest to a query. */
struct NearestPoint
{
	Point2 point;              ///< the foot, map frame [m]
	double distance = 0;       ///< from the query to the foot [m]
	std::size_t polyline = 0;  ///< index of the polyline
	std::size_t segment = 0;   ///< the foot lies between points[segment] and points[segment + 1]
	std::size_t sample = 0;    ///< index of the nearest of samples() on that segment
};

/** Finds the nearest point on polylines: MRPT's KD-tree over an even sampling, then exact feet on the segments.
 *
 * Immutable once built, so safe for several threads. Exact for every finite query: the samples only choose which
 * segments are looked at. */
class PolylineIndex
{
 public:
	/** Builds the tree; O(n log n) in the samples.
	 * @param spacing greatest distance between neighbouring samples of a segment [m], > 0. */
	PolylineIndex(const std::vector<Polyline>& polylines, double spacing);

	/** The nearest point; nothing if there is none within maxDistance, or the query is not finite. */
	std::optional<NearestPoint> nearest(const Point2& query,
										double maxDistance = std::numeric_limits<double>::infinity()) const;

	/** The sampling: the middle of each of the equal parts of a segment, in the order of the polylines. */
	const std::vector<Point2>& samples() const { return samples_; }

 private:
	/** The samples relative to an origin, in the form that MRPT's KD-tree wants. */
	struct SampleTree : public mrpt::math::KDTreeCapable<SampleTree, float>
	{
		std::vector<float> coordinates;  ///< x and y in turn

		std::size_t kdtree_get_point_count() const { return coordinates.size() / 2; }
		float kdtree_get_pt(std::size_t i, int dim) const { return coordinates[2 * i + std::size_t(dim)]; }
		template <class BoundingBox>
		bool kdtree_get_bbox(BoundingBox&) const
		{
			return false;
		}
	};

	struct Segment
	{
		Point2 a, b;
		std::uint32_t polyline, segment;
		std::uint32_t firstSample, sampleCount;
	};

	void addSegment(const Point2& a, const Point2& b, std::uint32_t polyline, std::uint32_t segment, double spacing);
	void consider(std::size_t segment, const Point2& query, double& bestSqr, std::size_t& best) const;
	NearestPoint describe(std::size_t segment, const Point2& query) const;
	std::size_t exhaustive(const Point2& query, double& bestSqr) const;

	std::vector<Segment> segments_;
	std::vector<Point2> samples_;
	std::vector<std::uint32_t> sampleSegment_;  ///< segment of each sample
	SampleTree tree_;
	Point2 origin_;           ///< keeps the single-precision tree accurate far from the origin of the map
	double extent_ = 0;       ///< greatest coordinate of a sample relative to origin_ [m]
	double halfSpacing_ = 0;  ///< no point of a segment is farther than this from its nearest sample [m]
};

}  // namespace ridgemap
