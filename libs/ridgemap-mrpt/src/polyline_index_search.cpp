// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/polyline_index.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "candidate_cells.h"
#include "segment_geometry.h"

namespace ridgemap
{
namespace
{
/** Relative error of coordinates, differences and distances in the single-precision tree, with room. */
constexpr double treeError = 1e-6;
/** Beyond this, squares of distances may leave the range of single precision [m]. */
constexpr double treeReach = 1e15;
/** Rings of buckets that are looked at before the tree is asked. */
constexpr std::int64_t mostRings = 12;
}  // namespace

void PolylineIndex::consider(std::size_t segment, const Point2& query, Candidate& best) const
{
	const Segment& s = segments_[segment];
	const double d = squareBetween(query, footOn(s, query));
	// The order of the polylines decides between equal distances, not the order in which they are found.
	if (d > best.distanceSqr || (d == best.distanceSqr && segment >= best.segment)) return;
	best = {d, segment};
}

bool PolylineIndex::canBeSeen(std::size_t segment, const Point2& from) const
{
	constexpr double tolerance = 0.17;  // sine of the angle
	const Segment& s = segments_[segment];
	const int side = isPoint(segment) ? 0 : sides_[s.polyline];
	if (side == 0) return true;
	const double ux = s.b.x - s.a.x, uy = s.b.y - s.a.y, vx = from.x - s.a.x, vy = from.y - s.a.y;
	const double cross = side * (ux * vy - uy * vx);
	return cross >= 0 || cross * cross * s.perLengthSqr <= tolerance * tolerance * (vx * vx + vy * vy);
}

/** The nearest of the segments that are accepted, within so many rings of buckets. */
template <class Accept>
PolylineIndex::Search PolylineIndex::searchBuckets(const Point2& query, double maxDistance, std::int64_t rings,
												   Candidate& best, Accept&& accept) const
{
	const double u = (query.x - corner_.x) * perMetre_, v = (query.y - corner_.y) * perMetre_;
	const double far = double(rings);
	if (!(u > -far && v > -far && u < double(columns_) + far && v < double(rows_) + far))
		return far * edge_ - slack_ > maxDistance ? Search::complete : Search::tooFar;
	const auto cx = std::int64_t(std::floor(u)), cy = std::int64_t(std::floor(v));
	const double fx = u - double(cx), fy = v - double(cy);
	const double inner = std::min({fx, 1 - fx, fy, 1 - fy});
	for (std::int64_t ring = 0; ring <= rings; ring++)
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
					if (accept(bucketSegments_[i])) consider(bucketSegments_[i], query, best);
			}
		}
		const double border = (double(ring) + inner) * edge_ - slack_;
		if (border > maxDistance || (border > 0 && best.distanceSqr < border * border)) return Search::complete;
	}
	return Search::tooFar;
}

PolylineIndex::Search PolylineIndex::searchBuckets(const Point2& query, double maxDistance, Candidate& best) const
{
	return searchBuckets(query, maxDistance, mostRings, best, [](std::size_t) { return true; });
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
			const SampleRange& r = ranges_[i];
			const double sample = double(f.first) - double(ranges_[middle].firstSample) + 0.5;
			return segments_[i].polyline == segments_[middle].polyline && r.firstPart <= sample + 0.75 &&
				   r.firstPart + r.parts >= sample - 0.75;
		};
		for (std::size_t i = middle; i < segments_.size() && near(i); i++) consider(i, query, best);
		for (std::size_t i = middle; i-- > 0 && near(i);) consider(i, query, best);
	}
}

/** The segments in buckets that a square around the centre touches, with their distances, nearest first. */
void PolylineIndex::collectWithin(const Point2& centre, double reach, std::vector<CellCandidate>& found) const
{
	const auto clamped = [&](double at, double corner, std::int64_t n)
	{ return std::clamp<std::int64_t>(std::int64_t(std::floor((at - corner) * perMetre_)), 0, n - 1); };
	const double square = reach + slack_;
	const std::int64_t x0 = clamped(centre.x - square, corner_.x, columns_);
	const std::int64_t x1 = clamped(centre.x + square, corner_.x, columns_);
	const std::int64_t y0 = clamped(centre.y - square, corner_.y, rows_);
	const std::int64_t y1 = clamped(centre.y + square, corner_.y, rows_);
	found.clear();
	for (std::int64_t y = y0; y <= y1; y++)
		for (auto i = bucketBegin_[std::size_t(y * columns_ + x0)];
			 i < bucketBegin_[std::size_t(y * columns_ + x1) + 1]; i++)
		{
			const double d = squareBetween(centre, footOn(segments_[bucketSegments_[i]], centre));
			if (d <= reach * reach) found.push_back({float(d), bucketSegments_[i]});
		}
	std::sort(found.begin(), found.end(),
			  [](const CellCandidate& a, const CellCandidate& b)
			  { return a.leastSqr != b.leastSqr ? a.leastSqr < b.leastSqr : a.segment < b.segment; });
	found.erase(std::unique(found.begin(), found.end(),
							[](const CellCandidate& a, const CellCandidate& b) { return a.segment == b.segment; }),
				found.end());
}

const std::vector<CellCandidate>& PolylineIndex::candidatesOf(const Point2& centre) const
{
	// No point of the cell is farther than `half` from the centre. So the nearest segment of any of them is at most
	// nearest + half away from it, and nearest + 2 half from the centre.
	const double half = cells_->edge() * 0.7072 + slack_, reach = cellReach * edge_;
	// Single precision is rounded off by less than 1e-7.
	const auto lowerBoundSqr = [half](double v) { return v > half ? float((v - half) * (v - half) * (1 - 1e-6)) : 0; };
	thread_local std::vector<CellCandidate> list;
	Candidate best;
	searchBuckets(centre, reach, best);
	const double nearest = std::sqrt(best.distanceSqr);
	if (!(nearest <= reach))
	{
		list.assign(1, {lowerBoundSqr(reach), CellCandidate::beyond});
		return list;
	}
	collectWithin(centre, nearest + 2 * half, list);
	for (auto& c : list) c.leastSqr = lowerBoundSqr(std::sqrt(double(c.leastSqr)) * (1 - 1e-6));
	list.push_back({std::numeric_limits<float>::infinity(), CellCandidate::end});
	return list;
}

/** The list of the cell of a finite query; null where there are no cells. */
const CellCandidate* PolylineIndex::cellOf(const Point2& query) const
{
	return cells_->at(
		query, [this](const Point2& centre) -> const auto& { return candidatesOf(centre); });
}

PolylineIndex::Search PolylineIndex::searchCell(const CellCandidate* c, const Point2& query, double maxDistance,
												Candidate& best) const
{
	if (!c) return Search::tooFar;
	double limit = std::min(maxDistance * maxDistance, std::numeric_limits<double>::max());
	for (; c->leastSqr <= limit; c++)
	{
		if (c->segment == CellCandidate::beyond) return Search::tooFar;
		consider(c->segment, query, best);
		limit = std::min(limit, best.distanceSqr);
	}
	return Search::complete;
}

PolylineIndex::Candidate PolylineIndex::search(const Point2& query, double maxDistance) const
{
	Candidate best;
	if (segments_.empty() || !isFinite(query) || !(maxDistance >= 0)) return best;
	if (searchCell(cellOf(query), query, maxDistance, best) == Search::complete) return best;
	return searchWithoutCells(query, maxDistance);
}

PolylineIndex::Candidate PolylineIndex::searchWithoutCells(const Point2& query, double maxDistance) const
{
	Candidate best;
	if (searchBuckets(query, maxDistance, best) == Search::tooFar) searchTree(query, maxDistance, best);
	return best;
}

bool PolylineIndex::hasWithin(const Point2& query, double distance) const
{
	if (segments_.empty() || !isFinite(query)) return false;
	return searchWithoutCells(query, distance).distanceSqr <= distance * distance;
}

std::optional<Foot> PolylineIndex::foot(const Point2& query, double maxDistance) const
{
	const Candidate best = search(query, maxDistance);
	if (!(best.distanceSqr <= maxDistance * maxDistance) || best.segment >= segments_.size()) return std::nullopt;
	return Foot{footOn(segments_[best.segment], query), best.distanceSqr, best.segment};
}

std::optional<Foot> PolylineIndex::visibleFoot(const Point2& query, const Point2& from, double maxDistance) const
{
	const auto nearest = foot(query, maxDistance);
	if (!nearest || canBeSeen(nearest->segment, from)) return nearest;
	Candidate best;
	constexpr double mostVisibleRings = 100;
	const double rings = maxDistance * perMetre_ + 2;
	const auto accept = [&](std::size_t segment) { return canBeSeen(segment, from); };
	if (rings < mostVisibleRings)
		searchBuckets(query, maxDistance, std::int64_t(rings), best, accept);
	else
		for (std::size_t i = 0; i < segments_.size(); i++)
			if (accept(i)) consider(i, query, best);
	if (!(best.distanceSqr <= maxDistance * maxDistance) || best.segment >= segments_.size()) return std::nullopt;
	return Foot{footOn(segments_[best.segment], query), best.distanceSqr, best.segment};
}

Point2 PolylineIndex::direction(std::size_t segment) const
{
	const Segment& s = segments_[segment];
	const double length = std::hypot(s.b.x - s.a.x, s.b.y - s.a.y);
	if (!(length > 0)) return {};
	return {(s.b.x - s.a.x) / length, (s.b.y - s.a.y) / length};
}

std::size_t PolylineIndex::sampleOf(const Foot& foot) const
{
	const Segment& s = segments_[foot.segment];
	const SampleRange& r = ranges_[foot.segment];
	const double t = std::sqrt(squareBetween(s.a, foot.point) * s.perLengthSqr);
	const double part = std::max(0.0, r.firstPart + std::min(t, 1.0) * r.parts);
	return r.firstSample + std::min(r.sampleCount - 1, std::uint32_t(part));
}

std::optional<NearestPoint> PolylineIndex::nearest(const Point2& query, double maxDistance) const
{
	const auto f = foot(query, maxDistance);
	if (!f) return std::nullopt;
	const Segment& s = segments_[f->segment];
	const double distance = std::hypot(query.x - f->point.x, query.y - f->point.y);
	if (!(distance <= maxDistance)) return std::nullopt;
	return NearestPoint{f->point, distance, s.polyline, s.segment, sampleOf(*f), direction(f->segment)};
}

double PolylineIndex::distance(const Point2& query, double maxDistance) const
{
	return std::min(maxDistance, std::sqrt(search(query, maxDistance).distanceSqr));
}

double PolylineIndex::scatteredDistance(const Point2& query, double maxDistance) const
{
	if (segments_.empty() || !isFinite(query) || !(maxDistance >= 0)) return maxDistance;
	return std::min(maxDistance, std::sqrt(searchWithoutCells(query, maxDistance).distanceSqr));
}

void PolylineIndex::distancesSqr(const std::vector<Point2>& queries, double maxDistance,
								 std::vector<double>& distancesSqr) const
{
	const double farthest = maxDistance * maxDistance;
	distancesSqr.assign(queries.size(), farthest);
	if (segments_.empty()) return;
	// In steps of a few queries, so that the processor waits for the memory of all of them at once.
	constexpr std::size_t together = 16;
	std::array<const CellCandidate*, together> lists;
	for (std::size_t first = 0; first < queries.size(); first += together)
	{
		const std::size_t n = std::min(together, queries.size() - first);
		for (std::size_t i = 0; i < n; i++)
			lists[i] = isFinite(queries[first + i]) ? cellOf(queries[first + i]) : nullptr;
		for (std::size_t i = 0; i < n; i++)
		{
			const Point2& query = queries[first + i];
			Candidate best;
			if (searchCell(lists[i], query, maxDistance, best) == Search::tooFar) best = search(query, maxDistance);
			distancesSqr[first + i] = std::min(farthest, best.distanceSqr);
		}
	}
}

}  // namespace ridgemap
