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
}  // namespace

PolylineIndex::PolylineIndex(const std::vector<Polyline>& polylines, double spacing) : halfSpacing_(spacing / 2)
{
	if (!(spacing > 0)) throw std::invalid_argument("the spacing of a polyline index must be positive");
	Box2 box;
	for (const auto& polyline : polylines)
		for (const auto& p : polyline.points) box.extend(p);
	if (!box.empty()) origin_ = {(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2};
	for (std::size_t i = 0; i < polylines.size(); i++)
	{
		const auto& points = polylines[i].points;
		for (std::size_t k = 1; k < points.size(); k++)
			addSegment(points[k - 1], points[k], std::uint32_t(i), std::uint32_t(k - 1), spacing);
	}
	for (const auto& s : samples_)
	{
		tree_.coordinates.push_back(float(s.x - origin_.x));
		tree_.coordinates.push_back(float(s.y - origin_.y));
		extent_ = std::max({extent_, std::abs(s.x - origin_.x), std::abs(s.y - origin_.y)});
	}
	tree_.kdTreeEnsureIndexBuilt2D();
}

void PolylineIndex::addSegment(const Point2& a, const Point2& b, std::uint32_t polyline, std::uint32_t segment,
							   double spacing)
{
	const double parts = std::max(1.0, std::ceil(std::sqrt(distanceSqr(a, b)) / spacing));
	const auto n = std::uint32_t(parts);
	segments_.push_back({a, b, polyline, segment, std::uint32_t(samples_.size()), n});
	for (std::uint32_t i = 0; i < n; i++)
	{
		samples_.push_back(along(a, b, (i + 0.5) / n));
		sampleSegment_.push_back(std::uint32_t(segments_.size() - 1));
	}
}

void PolylineIndex::consider(std::size_t segment, const Point2& query, double& bestSqr, std::size_t& best) const
{
	const Segment& s = segments_[segment];
	const double d = distanceSqr(query, along(s.a, s.b, footParameter(s.a, s.b, query)));
	// The order of the polylines decides between equal distances, not the order in which the tree finds them.
	if (d > bestSqr || (d == bestSqr && segment >= best)) return;
	bestSqr = d;
	best = segment;
}

NearestPoint PolylineIndex::describe(std::size_t segment, const Point2& query) const
{
	const Segment& s = segments_[segment];
	const double t = footParameter(s.a, s.b, query);
	NearestPoint r;
	r.point = along(s.a, s.b, t);
	r.distance = std::hypot(query.x - r.point.x, query.y - r.point.y);
	r.polyline = s.polyline;
	r.segment = s.segment;
	r.sample = s.firstSample + std::min(s.sampleCount - 1, std::uint32_t(t * s.sampleCount));
	return r;
}

std::size_t PolylineIndex::exhaustive(const Point2& query, double& bestSqr) const
{
	std::size_t best = segments_.size();
	for (std::size_t i = 0; i < segments_.size(); i++) consider(i, query, bestSqr, best);
	return best;
}

std::optional<NearestPoint> PolylineIndex::nearest(const Point2& query, double maxDistance) const
{
	if (segments_.empty() || !std::isfinite(query.x) || !std::isfinite(query.y)) return std::nullopt;
	const double x = query.x - origin_.x, y = query.y - origin_.y;
	const double reach = std::max({extent_, std::abs(x), std::abs(y)});
	double bestSqr = std::numeric_limits<double>::infinity();
	std::size_t best = segments_.size();
	if (reach > treeReach)
		best = exhaustive(query, bestSqr);
	else
	{
		// The foot on the segment of the nearest sample bounds the distance; any segment that comes nearer has a sample
		// within that bound and half a spacing.
		const double slack = treeError * reach;
		float sampleSqr = 0;
		const std::size_t first = tree_.kdTreeClosestPoint2D(float(x), float(y), sampleSqr);
		if (std::sqrt(double(sampleSqr)) - slack - halfSpacing_ > maxDistance) return std::nullopt;
		consider(sampleSegment_[first], query, bestSqr, best);
		const double radius = std::min(std::sqrt(bestSqr), maxDistance) + halfSpacing_ + slack;
		thread_local std::vector<nanoflann::ResultItem<std::size_t, float>> found;
		tree_.kdTreeRadiusSearch2D(float(x), float(y), float(radius * radius * (1 + treeError)), found);
		for (const auto& f : found)
			if (sampleSegment_[f.first] != best) consider(sampleSegment_[f.first], query, bestSqr, best);
	}
	const NearestPoint result = describe(best, query);
	if (!(result.distance <= maxDistance)) return std::nullopt;
	return result;
}

}  // namespace ridgemap
