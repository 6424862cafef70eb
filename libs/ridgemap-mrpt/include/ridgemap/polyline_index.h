// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/KDTreeCapable.h>
#include <ridgemap/types.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
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
	std::size_t sample = 0;    ///< index of the nearest of samples(), along the polyline
	Point2 direction;          ///< of the segment, unit length; zero for a point
};

/** The nearest point of a PolylineIndex, without what takes time to find out. */
struct Foot
{
	Point2 point;             ///< map frame [m]
	double distanceSqr = 0;   ///< from the query [m^2]
	std::size_t segment = 0;  ///< number of its segment, for PolylineIndex::direction() and isPoint()
};

class CandidateCells;
struct CellCandidate;

/** Finds the nearest point on polylines and among points. Small cells of the plane know the few segments that matter
 * within them; a cell finds them when it is first asked, in larger buckets or by MRPT's KD-tree over an even sampling.
 *
 * Immutable to its users, so safe for several threads. Exact for every finite query: cells, buckets and samples only
 * choose which segments are looked at. */
class PolylineIndex
{
 public:
	/** O(n) in samples and segments; the KD-tree is built by the first query that needs it, O(n log n).
	 * @param spacing greatest distance between neighbouring samples along a polyline [m], > 0.
	 * @param points each is a polyline, a segment and a sample of its own, behind those of the polylines. */
	PolylineIndex(const std::vector<Polyline>& polylines, double spacing, const std::vector<Point2>& points = {});
	~PolylineIndex();

	/** The nearest point; nothing if there is none within maxDistance, or the query is not finite. About 20 ns where
	 * queries were near before. */
	std::optional<Foot> foot(const Point2& query, double maxDistance) const;

	/** The nearest point on a polyline that can be seen from a place: one whose side (Polyline::side) is not turned
	 * away from it by more than about 10 degrees (sine 0.17), as seen from the start of the segment. Polylines without
	 * a side, and points, are seen from everywhere. A little slower than foot() where the nearest polyline of all can
	 * be seen; else O(segments within maxDistance). */
	std::optional<Foot> visibleFoot(const Point2& query, const Point2& from, double maxDistance) const;

	/** The same as foot() with all that is known about it. */
	std::optional<NearestPoint> nearest(const Point2& query,
										double maxDistance = std::numeric_limits<double>::infinity()) const;

	/** Distance to the nearest point, capped at maxDistance; maxDistance for a query that is not finite. */
	double distance(const Point2& query, double maxDistance) const;
	/** The same for many scattered queries with a small maxDistance, near to which nobody asks again: leaves the cells
	 * alone, which take longer to make than one search in the buckets. */
	double scatteredDistance(const Point2& query, double maxDistance) const;

	/** The squares of the distances of many queries, capped at maxDistance^2. @param distancesSqr takes the results. */
	void distancesSqr(const std::vector<Point2>& queries, double maxDistance, std::vector<double>& distancesSqr) const;

	/** Whether anything lies within a distance; for many scattered queries with a small one. */
	bool hasWithin(const Point2& query, double distance) const;

	/** Of a segment, unit length; zero for a point. */
	Point2 direction(std::size_t segment) const;
	/** Whether a segment is one of the points. */
	bool isPoint(std::size_t segment) const { return segment >= firstPoint_; }
	/** Index of the sample nearest to a foot along its polyline. */
	std::size_t sampleOf(const Foot& foot) const;

	/** The sampling: the middle of each of the equal parts of a polyline, in the order of the polylines. */
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
		double perLengthSqr;  ///< 1/|b - a|^2; 0 for a point
		std::uint32_t polyline, segment;
	};
	/** Where a segment lies in the sampling of its polyline. */
	struct SampleRange
	{
		std::uint32_t firstSample, sampleCount;  ///< of the polyline
		double firstPart, parts;                 ///< where the segment begins, and how long it is, counted in parts
	};
	struct Candidate
	{
		double distanceSqr = std::numeric_limits<double>::infinity();
		std::size_t segment = std::numeric_limits<std::size_t>::max();
	};
	/** Bound on the distances that matter, and whether the search has found all that lie within it. */
	enum class Search
	{
		complete,
		tooFar
	};

	void addSegment(const Point2& a, const Point2& b, std::uint32_t polyline, std::uint32_t number);
	void addPolyline(const Polyline& polyline, std::uint32_t number, double spacing);
	void chooseBuckets(double spacing);
	void fillBuckets();
	template <class Visit>
	void forEachBucket(const Segment& s, Visit&& visit) const;
	const std::vector<CellCandidate>& candidatesOf(const Point2& centre) const;
	void collectWithin(const Point2& centre, double reach, std::vector<CellCandidate>& found) const;
	void consider(std::size_t segment, const Point2& query, Candidate& best) const;
	Candidate searchWithoutCells(const Point2& query, double maxDistance) const;
	const CellCandidate* cellOf(const Point2& query) const;
	Search searchCell(const CellCandidate* list, const Point2& query, double maxDistance, Candidate& best) const;
	template <class Accept>
	Search searchBuckets(const Point2& query, double maxDistance, std::int64_t rings, Candidate& best,
						 Accept&& accept) const;
	Search searchBuckets(const Point2& query, double maxDistance, Candidate& best) const;
	bool canBeSeen(std::size_t segment, const Point2& from) const;
	void searchTree(const Point2& query, double maxDistance, Candidate& best) const;
	Candidate search(const Point2& query, double maxDistance) const;
	void buildTree() const;

	std::vector<Segment> segments_;
	std::vector<std::int8_t> sides_;   ///< of the polylines
	std::vector<SampleRange> ranges_;  ///< of the segments
	std::vector<Point2> samples_;
	std::vector<std::uint32_t> sampleSegment_;  ///< segment of each sample
	std::size_t firstPoint_ = 0;                ///< segments from here on are points
	double halfSpacing_ = 0;  ///< no point of a segment is farther than this from a sample of its segment's part [m]

	Point2 corner_;                   ///< lower left of the buckets [m]
	double edge_ = 1, perMetre_ = 1;  ///< of a bucket [m], and 1/edge
	std::int64_t columns_ = 0, rows_ = 0;
	double slack_ = 0;                        ///< segments are in their buckets up to this [m]
	std::vector<std::uint32_t> bucketBegin_;  ///< bucket i holds bucketSegments_[begin[i]] .. [begin[i+1]]
	std::vector<std::uint32_t> bucketSegments_;
	std::unique_ptr<CandidateCells> cells_;

	mutable std::once_flag treeBuilt_;
	mutable SampleTree tree_;
	mutable Point2 origin_;      ///< keeps the single-precision tree accurate far from the origin of the map
	mutable double extent_ = 0;  ///< greatest coordinate of a sample relative to origin_ [m]
};

}  // namespace ridgemap
