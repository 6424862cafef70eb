// SPDX-License-Identifier: BSD-3-Clause
#include "places.h"

#include <ridgemap/observation_to_measurements.h>

#include <algorithm>
#include <cmath>

namespace ridgemap::apps
{
namespace
{
constexpr double straight = 0.02;  // walls are simplified to this [m]

std::vector<Segment> longSegments(const CRidgeMap2D& map, double least)
{
	std::vector<Segment> all;
	for (const Polyline& line : map.simplified(straight))
		for (std::size_t i = 1; i < line.points.size(); i++)
			if (const Segment s{line.points[i - 1], line.points[i]}; s.length() >= least) all.push_back(s);
	return all;
}

double cosine(const Segment& s, const Segment& t)
{
	return ((s.b.x - s.a.x) * (t.b.x - t.a.x) + (s.b.y - s.a.y) * (t.b.y - t.a.y)) / (s.length() * t.length());
}
}  // namespace

Box2 grown(Box2 box, double margin)
{
	box.min.x -= margin;
	box.min.y -= margin;
	box.max.x += margin;
	box.max.y += margin;
	return box;
}

Box2 around(const Point2& centre, double half)
{
	Box2 box;
	box.extend(centre);
	return grown(box, half);
}

Box2 boxOf(const std::vector<PosedScan>& scans)
{
	Box2 box;
	for (const PosedScan& s : scans)
	{
		box.extend(Point2{s.pose.x(), s.pose.y()});
		for (const Measurement& m : observationToMeasurements(*s.scan, s.pose, TInsertionOptions()))
			box.extend(Point2{m.x, m.y});
	}
	return box;
}

std::optional<Point2> sharpestCorner(const CRidgeMap2D& map)
{
	constexpr double arm = 0.8, gap = 0.3;
	const auto segments = longSegments(map, arm);
	double best = 0.3;
	std::optional<Point2> corner;
	for (std::size_t i = 0; i < segments.size(); i++)
		for (std::size_t j = i + 1; j < segments.size(); j++)
			for (const Point2& p : {segments[i].a, segments[i].b})
				for (const Point2& q : {segments[j].a, segments[j].b})
				{
					const double apart = std::hypot(p.x - q.x, p.y - q.y);
					const double badness = std::abs(cosine(segments[i], segments[j])) + apart;
					if (apart > gap || badness >= best) continue;
					best = badness;
					corner = Point2{(p.x + q.x) / 2, (p.y + q.y) / 2};
				}
	return corner;
}

std::optional<Point2> thinnestWall(const CRidgeMap2D& map, const std::vector<Segment>& truth)
{
	constexpr double nearest = 0.03, farthest = 0.4, parallel = 0.97, least = 0.4;
	std::vector<Segment> segments;
	for (const Segment& s : truth)
		if (s.seen && s.length() >= least) segments.push_back(s);
	if (truth.empty()) segments = longSegments(map, least);
	double best = farthest;
	std::optional<Point2> place;
	for (const Segment& s : segments)
		for (const Segment& t : segments)
		{
			if (&s == &t || std::abs(cosine(s, t)) < parallel) continue;
			const Point2 p = s.at(0.5);
			const double along = t.nearest(p), apart = t.distance(p);
			if (along <= 0 || along >= 1 || apart < nearest || apart >= best) continue;
			best = apart;
			const Point2 q = t.at(along);
			place = Point2{(p.x + q.x) / 2, (p.y + q.y) / 2};
		}
	return place;
}

}  // namespace ridgemap::apps
