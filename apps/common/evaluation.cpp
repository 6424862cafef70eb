// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation.h"

#include <stdexcept>

#include "intervals.h"

namespace ridgemap::apps
{
namespace
{
constexpr double sameEnd = 1e-6;  // [m]

bool meet(const Point2& a, const Point2& b)
{
	return std::hypot(a.x - b.x, a.y - b.y) < sameEnd;
}

/** Number of the connected surface that each true segment belongs to. */
std::vector<std::size_t> surfacesOf(const std::vector<Segment>& truth)
{
	std::vector<std::size_t> surface(truth.size());
	for (std::size_t i = 0; i < truth.size(); i++)
	{
		surface[i] = i;
		for (std::size_t j = 0; j < i; j++)
		{
			if (!(meet(truth[i].a, truth[j].a) || meet(truth[i].a, truth[j].b) || meet(truth[i].b, truth[j].a) ||
				  meet(truth[i].b, truth[j].b)))
				continue;
			const std::size_t from = surface[j], to = surface[i];
			std::replace(surface.begin(), surface.begin() + std::ptrdiff_t(i) + 1, from, to);
		}
	}
	return surface;
}

/** Parts of a segment that are near to corners. */
IntervalSet cornerParts(const Segment& s, const std::vector<Point2>& corners, double radius)
{
	std::vector<Interval> parts;
	for (const Point2& c : corners)
		if (const auto i = nearPoint(s, c, radius)) parts.push_back(*i);
	return unite(parts);
}

/** Sums up what one segment of the map contributes. */
struct SegmentSums
{
	DistanceSum near, far;  ///< of corners
};
SegmentSums sumsOf(const Segment& s, const std::vector<Segment>& truth, const IntervalSet& corner)
{
	SegmentSums sums;
	double at = 0;
	for (const Interval& i : corner)
	{
		if (i.from > at) sums.far += integrateDistance(s.at(at), s.at(i.from), truth);
		sums.near += integrateDistance(s.at(i.from), s.at(i.to), truth);
		at = i.to;
	}
	if (at < 1) sums.far += integrateDistance(s.at(at), s.b, truth);
	return sums;
}

/** Shadows of the map on the true segments. */
struct Coverage
{
	std::vector<std::vector<Interval>> covered;  ///< truth within reach of the map
	std::vector<std::vector<Interval>> shadows;  ///< feet of map segments on the truth that is nearest to them
	std::vector<std::vector<char>> touched;      ///< by polyline: surfaces within reach
};

void addSegment(const Segment& s, const std::vector<Segment>& truth, double within, Coverage& coverage,
				std::vector<char>& touched, std::vector<Interval>& hits)
{
	const Point2 middle = s.at(0.5);
	std::size_t nearest = 0;
	for (std::size_t i = 0; i < truth.size(); i++)
	{
		if (truth[i].distance(middle) < truth[nearest].distance(middle)) nearest = i;
		if (truth[i].distance(middle) > within + s.length()) continue;
		if (const auto c = nearSegment(truth[i], s, within)) coverage.covered[i].push_back(*c);
		if (const auto h = nearSegment(s, truth[i], within))
		{
			hits.push_back(*h);
			touched[i] = 1;
		}
	}
	const double t1 = truth[nearest].nearest(s.a), t2 = truth[nearest].nearest(s.b);
	if (truth[nearest].distance(middle) <= within)
		coverage.shadows[nearest].push_back({std::min(t1, t2), std::max(t1, t2)});
}

void addCoverage(const Coverage& coverage, const std::vector<Segment>& truth, const std::vector<Point2>& corners,
				 const EvaluationSettings& settings, Evaluation& e)
{
	for (std::size_t i = 0; i < truth.size(); i++)
	{
		const double length = truth[i].length();
		double shadows = 0;
		for (const Interval& s : coverage.shadows[i]) shadows += s.to - s.from;
		e.duplicates += length * std::max(0.0, shadows - sizeOf(unite(coverage.shadows[i])));
		if (!truth[i].seen) continue;
		const IntervalSet covered = unite(coverage.covered[i]);
		const IntervalSet corner = cornerParts(truth[i], corners, settings.cornerRadius);
		e.truthLength += length;
		e.truthCovered += length * sizeOf(covered);
		e.truthCornerLength += length * sizeOf(corner);
		e.truthCornerCovered += length * sizeOf(intersect(covered, corner));
	}
}

void countFragments(const Coverage& coverage, const std::vector<Segment>& truth, Evaluation& e)
{
	const std::vector<std::size_t> surface = surfacesOf(truth);
	std::vector<char> seen(truth.size(), 0);
	for (std::size_t i = 0; i < truth.size(); i++)
		if (truth[i].seen) seen[surface[i]] = 1;
	e.surfaces = std::size_t(std::count(seen.begin(), seen.end(), 1));
	for (const std::vector<char>& touched : coverage.touched)
	{
		std::vector<char> surfaces(truth.size(), 0);
		for (std::size_t i = 0; i < truth.size(); i++)
			if (touched[i]) surfaces[surface[i]] = 1;
		e.fragments += std::size_t(std::count(surfaces.begin(), surfaces.end(), 1));
	}
}

}  // namespace

std::vector<Point2> cornersOf(const std::vector<Segment>& truth, double leastAngle)
{
	std::vector<Point2> corners;
	const auto leaving = [](const Segment& s, bool fromA)
	{
		const double sign = fromA ? 1 : -1, length = s.length();
		return Point2{sign * (s.b.x - s.a.x) / length, sign * (s.b.y - s.a.y) / length};
	};
	for (std::size_t i = 0; i < truth.size(); i++)
		for (std::size_t j = 0; j < i; j++)
			for (int ends = 0; ends < 4; ends++)
			{
				const bool atA = ends & 1, otherAtA = ends & 2;
				const Point2 p = atA ? truth[i].a : truth[i].b;
				if (!meet(p, otherAtA ? truth[j].a : truth[j].b)) continue;
				const Point2 u = leaving(truth[i], atA), v = leaving(truth[j], otherAtA);
				const double turn = std::acos(std::clamp(-(u.x * v.x + u.y * v.y), -1.0, 1.0));
				if (turn > leastAngle) corners.push_back(p);
			}
	return corners;
}

Evaluation evaluate(const std::vector<Polyline>& map, const std::vector<Segment>& truth,
					const EvaluationSettings& settings)
{
	if (truth.empty()) throw std::invalid_argument("evaluation: there is no true surface");
	Evaluation e;
	const std::vector<Point2> corners = cornersOf(truth, settings.cornerAngle);
	e.cornerCount = corners.size();
	Coverage coverage;
	coverage.covered.resize(truth.size());
	coverage.shadows.resize(truth.size());
	for (const Polyline& polyline : map)
	{
		PolylineEvaluation p;
		coverage.touched.emplace_back(truth.size(), 0);
		for (std::size_t i = 1; i < polyline.points.size(); i++)
		{
			const Segment s{polyline.points[i - 1], polyline.points[i]};
			const SegmentSums sums = sumsOf(s, truth, cornerParts(s, corners, settings.cornerRadius));
			e.corners += sums.near;
			e.straight += sums.far;
			(p.distance += sums.near) += sums.far;
			std::vector<Interval> hits;
			addSegment(s, truth, settings.within, coverage, coverage.touched.back(), hits);
			for (const Interval& hit : unite(hits)) p.right += integrateDistance(s.at(hit.from), s.at(hit.to), truth);
		}
		e.all += p.distance;
		e.right += p.right;
		e.spurious += std::max(0.0, p.distance.length - p.right.length);
		e.polylines.push_back(p);
	}
	addCoverage(coverage, truth, corners, settings, e);
	countFragments(coverage, truth, e);
	return e;
}

}  // namespace ridgemap::apps
