// SPDX-License-Identifier: BSD-3-Clause
// What tests ask about polylines.
#pragma once

#include <ridgemap/ridge_map.h>

#include <string>
#include <unordered_map>
#include <vector>

#include "oracle.h"

namespace ridgemap::test
{
/** All segments of some polylines, found by place. */
class SegmentIndex
{
 public:
	struct Segment
	{
		Point2 a, b;
		std::size_t line = 0;
		double arc = 0;                    ///< arc length at a [m]
		bool first = false, last = false;  ///< an open end of its polyline is at a, at b
	};

	/** @param cell size of the cells of the index, about the distances that will be asked for [m] */
	SegmentIndex(const std::vector<Polyline>& lines, double cell);

	const std::vector<Segment>& segments() const { return segments_; }

	/** Distance to the nearest segment that `accept` does not turn down, at most `reach`. */
	template <class Accept>
	double nearest(Point2 p, double reach, Accept accept) const
	{
		double best = reach;
		forCells(p, p, reach,
				 [&](std::int64_t key)
				 {
					 const auto cell = cells_.find(key);
					 if (cell == cells_.end()) return;
					 for (const std::size_t k : cell->second)
					 {
						 const Segment& s = segments_[k];
						 const SegmentFoot foot = footOnSegment({s.a.x, s.a.y}, {s.b.x, s.b.y}, {p.x, p.y});
						 if (foot.distance < best && accept(s, foot)) best = foot.distance;
					 }
				 });
		return best;
	}
	double nearest(Point2 p, double reach) const
	{
		return nearest(p, reach, [](const Segment&, const SegmentFoot&) { return true; });
	}

 private:
	template <class Fn>
	void forCells(Point2 a, Point2 b, double grow, Fn fn) const
	{
		const auto index = [&](double v) { return std::int64_t(std::floor(v / cell_)); };
		for (std::int64_t y = index(std::min(a.y, b.y) - grow); y <= index(std::max(a.y, b.y) + grow); y++)
			for (std::int64_t x = index(std::min(a.x, b.x) - grow); x <= index(std::max(a.x, b.x) + grow); x++)
				fn(x * 0x100000000 + y);
	}

	double cell_;
	std::vector<Segment> segments_;
	std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

/** Calls fn(point, segment, arc length) for points at most `step` apart on every segment. */
template <class Fn>
void forSamples(const SegmentIndex& index, double step, Fn fn)
{
	for (const SegmentIndex::Segment& s : index.segments())
	{
		const double length = std::hypot(s.b.x - s.a.x, s.b.y - s.a.y);
		const int n = std::max(1, int(std::ceil(length / step)));
		for (int k = 0; k < n; k++)
		{
			const double t = (k + 0.5) / n;
			fn(Point2{s.a.x + t * (s.b.x - s.a.x), s.a.y + t * (s.b.y - s.a.y)}, s, s.arc + t * length);
		}
	}
}

double totalLength(const std::vector<Polyline>& lines);

/** Distance from the ridges to the true ones, on samples 0.1 sigma apart. */
struct Accuracy
{
	std::size_t samples = 0;
	std::size_t beyondEps = 0;  ///< samples farther than eps from a true ridge, or on none
	double worst = 0;           ///< [eps]; 50 where there is no ridge within sigma
	Point2 worstPlace;
};
Accuracy measureAccuracy(const Oracle& oracle, const std::vector<Polyline>& ridges, const Options& options);

/** How many of the measurements whose projection has L >= L_tol have a polyline there. */
struct Coverage
{
	std::size_t projected = 0, withinEps = 0, withinSigma = 0;

	Coverage& operator+=(const Coverage& o);
};
Coverage measureCoverage(const Oracle& oracle, const std::vector<Measurement>& measurements,
						 const std::vector<Polyline>& ridges, const Options& options);

/** Length that runs within eps of another, or a distant part of the same, polyline in about its direction [m]. */
double duplicatedLength(const std::vector<Polyline>& lines, const Options& options);

/** Open ends of polylines that have another polyline within `reach`, but touch none, nor a distant part of their own.
 */
std::size_t danglingEnds(const std::vector<Polyline>& lines, double reach);

/** Equality to the last bit; else a line that says what is different first. */
std::string firstDifference(const std::vector<Polyline>& a, const std::vector<Polyline>& b);
std::string firstDifference(const std::vector<CellRecord>& a, const std::vector<CellRecord>& b);

}  // namespace ridgemap::test
