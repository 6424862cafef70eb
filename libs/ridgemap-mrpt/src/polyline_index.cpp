// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/polyline_index.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ridgemap
{
namespace
{
/** Position of the foot of a point on a segment, 0 at `a` .. 1 at `b`. */
double footParameter(const Point2& a, const Point2& b, const Point2& p)
{
	const double ux = b.x - a.x, uy = b.y - a.y;
	const double lengthSqr = ux * ux + uy * uy;
	if (!(lengthSqr > 0)) return 0;
	return std::clamp(((p.x - a.x) * ux + (p.y - a.y) * uy) / lengthSqr, 0.0, 1.0);
}

/** The point at t; exactly a or b at the ends. */
Point2 along(const Point2& a, const Point2& b, double t)
{
	if (t >= 1) return b;
	return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

double distanceSqr(const Point2& a, const Point2& b)
{
	const double dx = a.x - b.x, dy = a.y - b.y;
	return dx * dx + dy * dy;
}

/** Relative error of coordinates, differences and distances in the single-precision tree, with room. */
constexpr double treeError = 1e-6;
/** Beyond this, squares of distances may leave the range of single precision [m]. */
constexpr double treeReach = 1e15;
/** A bucket is this number of samples wide. */
constexpr double bucketEdge = 5;
/** Rings of buckets that are looked at before the tree is asked. */
constexpr std::int64_t mostRings = 12;
}  // namespace

PolylineIndex::PolylineIndex(const std::vector<Polyline>& polylines, double spacing)
{
	if (!(spacing > 0)) throw std::invalid_argument("the spacing of a polyline index must be positive");
	for (std::size_t i = 0; i < polylines.size(); i++) addPolyline(polylines[i], std::uint32_t(i), spacing);
	fillBuckets(spacing);
}

PolylineIndex::PolylineIndex(double spacing, const std::vector<Point2>& points) : samples_(points)
{
	if (!(spacing > 0)) throw std::invalid_argument("the spacing of a polyline index must be positive");
	segments_.reserve(points.size());
	for (std::uint32_t i = 0; i < points.size(); i++)
	{
		segments_.push_back({points[i], points[i], i, 0, i, 1, 0, 1});
		sampleSegment_.push_back(i);
	}
	fillBuckets(spacing);
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
		const double parts = length > 0 ? std::sqrt(distanceSqr(a, b)) / length * n : 0;
		segments_.push_back({a, b, number, std::uint32_t(k - 1), first, n, at, parts});
		const bool last = k + 1 == points.size();
		for (std::uint32_t i = std::uint32_t(samples_.size()) - first; i < n && (last || i + 0.5 < at + parts); i++)
		{
			samples_.push_back(along(a, b, parts > 0 ? (i + 0.5 - at) / parts : 0));
			sampleSegment_.push_back(std::uint32_t(segments_.size() - 1));
		}
		at += parts;
	}
}

template <class Visit>
void PolylineIndex::forEachBucket(const Segment& s, Visit&& visit) const
{
	const auto column = [&](double x) { return std::int64_t(std::floor((x - corner_.x) * perMetre_)); };
	const auto row = [&](double y) { return std::int64_t(std::floor((y - corner_.y) * perMetre_)); };
	const std::int64_t x1 = std::min(columns_ - 1, column(std::max(s.a.x, s.b.x)));
	const std::int64_t y1 = std::min(rows_ - 1, row(std::max(s.a.y, s.b.y)));
	for (std::int64_t y = row(std::min(s.a.y, s.b.y)); y <= y1; y++)
		for (std::int64_t x = column(std::min(s.a.x, s.b.x)); x <= x1; x++) visit(std::size_t(y * columns_ + x));
}

void PolylineIndex::fillBuckets(double spacing)
{
	if (segments_.empty()) return;
	Box2 box;
	double reach = 0;
	for (const auto& s : segments_)
	{
		box.extend(s.a);
		box.extend(s.b);
		reach = std::max({reach, std::abs(s.b.x - s.a.x), std::abs(s.b.y - s.a.y)});
	}
	corner_ = box.min;
	// Buckets narrower than the longest segment would hold it many times; wide empty maps must not eat the memory.
	edge_ = std::max(bucketEdge * spacing, reach);
	const double width = box.max.x - box.min.x, height = box.max.y - box.min.y;
	const double most = 64.0 * double(segments_.size()) + 4096;
	while ((width / edge_ + 1) * (height / edge_ + 1) > most) edge_ *= 1.5;
	perMetre_ = 1 / edge_;
	columns_ = std::int64_t(width * perMetre_) + 1;
	rows_ = std::int64_t(height * perMetre_) + 1;
	bucketBegin_.assign(std::size_t(columns_ * rows_) + 1, 0);
	for (const auto& s : segments_) forEachBucket(s, [&](std::size_t i) { bucketBegin_[i + 1]++; });
	for (std::size_t i = 1; i < bucketBegin_.size(); i++) bucketBegin_[i] += bucketBegin_[i - 1];
	bucketSegments_.resize(bucketBegin_.back());
	auto next = bucketBegin_;
	for (std::uint32_t i = 0; i < segments_.size(); i++)
		forEachBucket(segments_[i], [&](std::size_t bucket) { bucketSegments_[next[bucket]++] = i; });
}

void PolylineIndex::consider(std::size_t segment, const Point2& query, Candidate& best) const
{
	const Segment& s = segments_[segment];
	const double d = distanceSqr(query, along(s.a, s.b, footParameter(s.a, s.b, query)));
	// The order of the polylines decides between equal distances, not the order in which they are found.
	if (d > best.distanceSqr || (d == best.distanceSqr && segment >= best.segment)) return;
	best = {d, segment};
}

PolylineIndex::Search PolylineIndex::searchBuckets(const Point2& query, double maxDistance, Candidate& best) const
{
	const double u = (query.x - corner_.x) * perMetre_, v = (query.y - corner_.y) * perMetre_;
	const double far = double(mostRings);
	if (!(u > -far && v > -far && u < double(columns_) + far && v < double(rows_) + far)) return Search::tooFar;
	const auto cx = std::int64_t(std::floor(u)), cy = std::int64_t(std::floor(v));
	const double fx = u - double(cx), fy = v - double(cy);
	const double inner = std::min({fx, 1 - fx, fy, 1 - fy});
	// Segments are in their buckets up to rounding.
	const double slack = 1e-12 * (std::abs(corner_.x) + std::abs(corner_.y) + double(columns_ + rows_) * edge_);
	for (std::int64_t ring = 0; ring <= mostRings; ring++)
	{
		const std::int64_t y0 = std::max<std::int64_t>(0, cy - ring), y1 = std::min(rows_ - 1, cy + ring);
		for (std::int64_t y = y0; y <= y1; y++)
		{
			const bool whole = y == cy - ring || y == cy + ring;
			const std::int64_t step = whole || ring == 0 ? 1 : 2 * ring;
			for (std::int64_t x = cx - ring; x <= cx + ring; x += step)
			{
				if (x < 0 || x >= columns_) continue;
				const auto bucket = std::size_t(y * columns_ + x);
				for (std::uint32_t i = bucketBegin_[bucket]; i < bucketBegin_[bucket + 1]; i++)
					consider(bucketSegments_[i], query, best);
			}
		}
		const double border = (double(ring) + inner) * edge_ - slack;
		if (border > maxDistance || (border > 0 && best.distanceSqr < border * border)) return Search::complete;
	}
	return Search::tooFar;
}

void PolylineIndex::buildTree() const
{
	Box2 box;
	for (const auto& s : samples_) box.extend(s);
	origin_ = {(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2};
	tree_.coordinates.reserve(2 * samples_.size());
	for (const auto& s : samples_)
	{
		tree_.coordinates.push_back(float(s.x - origin_.x));
		tree_.coordinates.push_back(float(s.y - origin_.y));
		extent_ = std::max({extent_, std::abs(s.x - origin_.x), std::abs(s.y - origin_.y)});
	}
	tree_.kdTreeEnsureIndexBuilt2D();
}

void PolylineIndex::searchTree(const Point2& query, double maxDistance, Candidate& best) const
{
	std::call_once(treeBuilt_, [this] { buildTree(); });
	const double x = query.x - origin_.x, y = query.y - origin_.y;
	const double reach = std::max({extent_, std::abs(x), std::abs(y)});
	if (reach > treeReach)
	{
		for (std::size_t i = 0; i < segments_.size(); i++) consider(i, query, best);
		return;
	}
	// The foot on the segment of the nearest sample bounds the distance. A segment that comes nearer lies between
	// samples of its polyline within that bound and one spacing; the segments from the one sample's to the next are
	// looked at.
	const double slack = treeError * reach;
	float sampleSqr = 0;
	const std::size_t first = tree_.kdTreeClosestPoint2D(float(x), float(y), sampleSqr);
	if (std::sqrt(double(sampleSqr)) - slack - halfSpacing_ > maxDistance) return;
	consider(sampleSegment_[first], query, best);
	const double radius = std::min(std::sqrt(best.distanceSqr), maxDistance) + halfSpacing_ + slack;
	thread_local std::vector<nanoflann::ResultItem<std::size_t, float>> found;
	tree_.kdTreeRadiusSearch2D(float(x), float(y), float(radius * radius * (1 + treeError)), found);
	for (const auto& f : found)
	{
		const std::size_t middle = sampleSegment_[f.first];
		const auto near = [&](std::size_t i)
		{
			const Segment &s = segments_[i], &m = segments_[middle];
			const double sample = double(f.first) - double(m.firstSample) + 0.5;
			return s.polyline == m.polyline && s.firstPart <= sample + 0.75 && s.firstPart + s.parts >= sample - 0.75;
		};
		for (std::size_t i = middle; i < segments_.size() && near(i); i++) consider(i, query, best);
		for (std::size_t i = middle; i-- > 0 && near(i);) consider(i, query, best);
	}
}

PolylineIndex::Candidate PolylineIndex::search(const Point2& query, double maxDistance) const
{
	Candidate best;
	if (segments_.empty() || !std::isfinite(query.x) || !std::isfinite(query.y) || !(maxDistance >= 0)) return best;
	if (searchBuckets(query, maxDistance, best) == Search::tooFar) searchTree(query, maxDistance, best);
	return best;
}

NearestPoint PolylineIndex::describe(const Candidate& best, const Point2& query) const
{
	const Segment& s = segments_[best.segment];
	const double t = footParameter(s.a, s.b, query);
	NearestPoint r;
	r.point = along(s.a, s.b, t);
	r.distance = std::hypot(query.x - r.point.x, query.y - r.point.y);
	r.polyline = s.polyline;
	r.segment = s.segment;
	const double part = std::max(0.0, s.firstPart + t * s.parts);
	r.sample = s.firstSample + std::min(s.sampleCount - 1, std::uint32_t(part));
	const double length = std::hypot(s.b.x - s.a.x, s.b.y - s.a.y);
	if (length > 0) r.direction = {(s.b.x - s.a.x) / length, (s.b.y - s.a.y) / length};
	return r;
}

std::optional<NearestPoint> PolylineIndex::nearest(const Point2& query, double maxDistance) const
{
	const Candidate best = search(query, maxDistance);
	if (best.segment >= segments_.size()) return std::nullopt;
	const NearestPoint result = describe(best, query);
	if (!(result.distance <= maxDistance)) return std::nullopt;
	return result;
}

double PolylineIndex::distance(const Point2& query, double maxDistance) const
{
	return std::min(maxDistance, std::sqrt(search(query, maxDistance).distanceSqr));
}

}  // namespace ridgemap
