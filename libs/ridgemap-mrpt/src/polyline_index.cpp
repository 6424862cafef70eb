// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/polyline_index.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "candidate_cells.h"
#include "segment_geometry.h"

namespace ridgemap
{
namespace
{
/** A bucket is this number of samples wide; so many cells, too. */
constexpr double bucketEdge = 5;
}  // namespace

PolylineIndex::PolylineIndex(const std::vector<Polyline>& polylines, double spacing, const std::vector<Point2>& points)
{
	if (!(spacing > 0)) throw std::invalid_argument("the spacing of a polyline index must be positive");
	for (std::size_t i = 0; i < polylines.size(); i++) addPolyline(polylines[i], std::uint32_t(i), spacing);
	for (const auto& p : polylines) sides_.push_back(std::int8_t(p.side));
	firstPoint_ = segments_.size();
	segments_.reserve(firstPoint_ + points.size());
	samples_.reserve(samples_.size() + points.size());
	sampleSegment_.reserve(samples_.size() + points.size());
	for (std::size_t i = 0; i < points.size(); i++)
	{
		const auto sample = std::uint32_t(samples_.size());
		sampleSegment_.push_back(std::uint32_t(segments_.size()));
		addSegment(points[i], points[i], std::uint32_t(polylines.size() + i), 0);
		ranges_.push_back({sample, 1, 0, 1});
		samples_.push_back(points[i]);
	}
	if (segments_.empty()) return;
	chooseBuckets(spacing);
	fillBuckets();
}

PolylineIndex::~PolylineIndex() = default;

void PolylineIndex::addSegment(const Point2& a, const Point2& b, std::uint32_t polyline, std::uint32_t number)
{
	const double lengthSqr = squareBetween(a, b), perLengthSqr = 1 / lengthSqr;
	// So short a segment that this overflows is a point.
	segments_.push_back({a, b, std::isfinite(perLengthSqr) ? perLengthSqr : 0, polyline, number});
}

void PolylineIndex::addPolyline(const Polyline& polyline, std::uint32_t number, double spacing)
{
	const auto& points = polyline.points;
	const double length = polyline.length();
	if (points.size() < 2) return;
	const auto n = std::uint32_t(std::max(1.0, std::ceil(length / spacing)));
	const auto first = std::uint32_t(samples_.size());
	halfSpacing_ = std::max(halfSpacing_, length / n);
	double at = 0;  // in parts
	for (std::size_t k = 1; k < points.size(); k++)
	{
		const Point2 &a = points[k - 1], &b = points[k];
		const double parts = length > 0 ? std::sqrt(squareBetween(a, b)) / length * n : 0;
		addSegment(a, b, number, std::uint32_t(k - 1));
		ranges_.push_back({first, n, at, parts});
		const bool last = k + 1 == points.size();
		for (std::uint32_t i = std::uint32_t(samples_.size()) - first; i < n && (last || i + 0.5 < at + parts); i++)
		{
			samples_.push_back(along(a, b, parts > 0 ? (i + 0.5 - at) / parts : 0));
			sampleSegment_.push_back(std::uint32_t(segments_.size() - 1));
		}
		at += parts;
	}
}

void PolylineIndex::chooseBuckets(double spacing)
{
	Box2 box;
	double lengths = 0;
	for (const auto& s : segments_)
	{
		box.extend(s.a);
		box.extend(s.b);
		lengths += std::abs(s.b.x - s.a.x) + std::abs(s.b.y - s.a.y);
	}
	corner_ = box.min;
	edge_ = bucketEdge * spacing;
	const double width = box.max.x - box.min.x, height = box.max.y - box.min.y;
	// Wide empty maps and long segments must not eat the memory.
	const double most = 64.0 * double(segments_.size()) + (1 << 18);
	while ((width / edge_ + 1) * (height / edge_ + 1) + lengths / edge_ > most) edge_ *= 1.5;
	perMetre_ = 1 / edge_;
	columns_ = std::int64_t(width * perMetre_) + 1;
	rows_ = std::int64_t(height * perMetre_) + 1;
	slack_ = 1e-12 * (std::abs(corner_.x) + std::abs(corner_.y) + double(columns_ + rows_) * edge_);
	// Robots look at a map from within, and a little beyond its walls.
	const double margin = cellReach * edge_, cell = edge_ / bucketEdge;
	const auto count = [&](double length) { return std::int64_t((length + 2 * margin) / cell) + 1; };
	cells_ = std::make_unique<CandidateCells>(Point2{corner_.x - margin, corner_.y - margin}, cell, count(width),
											  count(height));
}

template <class Visit>
void PolylineIndex::forEachBucket(const Segment& s, Visit&& visit) const
{
	const auto clamped = [](double at, std::int64_t n)
	{ return std::min(n - 1, std::max<std::int64_t>(0, std::int64_t(std::floor(at)))); };
	const double ax = (s.a.x - corner_.x) * perMetre_, ay = (s.a.y - corner_.y) * perMetre_;
	const double bx = (s.b.x - corner_.x) * perMetre_, by = (s.b.y - corner_.y) * perMetre_;
	const double slack = slack_ * perMetre_;
	const std::int64_t y0 = clamped(std::min(ay, by) - slack, rows_), y1 = clamped(std::max(ay, by) + slack, rows_);
	const double slope = y1 > y0 ? (bx - ax) / (by - ay) : 0;
	for (std::int64_t y = y0; y <= y1; y++)
	{
		double low = std::min(ax, bx), high = std::max(ax, bx);
		if (y1 > y0)  // only what the segment covers within the row
		{
			const double u = ax + (double(y) - slack - ay) * slope, v = ax + (double(y + 1) + slack - ay) * slope;
			low = std::max(low, std::min(u, v));
			high = std::min(high, std::max(u, v));
		}
		const std::int64_t x1 = clamped(high + slack, columns_);
		for (std::int64_t x = clamped(low - slack, columns_); x <= x1; x++) visit(std::size_t(y * columns_ + x));
	}
}

void PolylineIndex::fillBuckets()
{
	bucketBegin_.assign(std::size_t(columns_ * rows_) + 1, 0);
	for (const auto& s : segments_) forEachBucket(s, [&](std::size_t i) { bucketBegin_[i + 1]++; });
	for (std::size_t i = 1; i < bucketBegin_.size(); i++) bucketBegin_[i] += bucketBegin_[i - 1];
	bucketSegments_.resize(bucketBegin_.back());
	auto next = bucketBegin_;
	for (std::uint32_t i = 0; i < segments_.size(); i++)
		forEachBucket(segments_[i], [&](std::size_t bucket) { bucketSegments_[next[bucket]++] = i; });
}

}  // namespace ridgemap
