// SPDX-License-Identifier: BSD-3-Clause
#include "intervals.h"

namespace ridgemap::apps
{
namespace
{
/** Part of s where low <= n . p <= high. */
std::optional<Interval> inBand(const Segment& s, double nx, double ny, double low, double high)
{
	const double at0 = nx * s.a.x + ny * s.a.y, slope = nx * (s.b.x - s.a.x) + ny * (s.b.y - s.a.y);
	if (slope == 0) return at0 >= low && at0 <= high ? std::optional(Interval{0, 1}) : std::nullopt;
	const double t1 = (low - at0) / slope, t2 = (high - at0) / slope;
	const Interval i{std::max(0.0, std::min(t1, t2)), std::min(1.0, std::max(t1, t2))};
	return i.from <= i.to ? std::optional(i) : std::nullopt;
}
}  // namespace

IntervalSet unite(std::vector<Interval> intervals)
{
	std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) { return a.from < b.from; });
	IntervalSet set;
	for (const Interval& i : intervals)
		if (!set.empty() && i.from <= set.back().to)
			set.back().to = std::max(set.back().to, i.to);
		else
			set.push_back(i);
	return set;
}

IntervalSet intersect(const IntervalSet& a, const IntervalSet& b)
{
	IntervalSet result;
	for (const Interval& i : a)
		for (const Interval& j : b)
			if (const Interval k{std::max(i.from, j.from), std::min(i.to, j.to)}; k.from < k.to) result.push_back(k);
	return result;
}

double sizeOf(const IntervalSet& set)
{
	double sum = 0;
	for (const Interval& i : set) sum += i.to - i.from;
	return sum;
}

std::optional<Interval> nearPoint(const Segment& s, const Point2& p, double distance)
{
	const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y, n = dx * dx + dy * dy;
	const double ax = p.x - s.a.x, ay = p.y - s.a.y;
	if (!(n > 0)) return ax * ax + ay * ay <= distance * distance ? std::optional(Interval{0, 1}) : std::nullopt;
	const double middle = (ax * dx + ay * dy) / n, beside = (ax * dy - ay * dx) / std::sqrt(n);
	const double rest = distance * distance - beside * beside;
	if (rest < 0) return std::nullopt;
	const double half = std::sqrt(rest / n);
	const Interval i{std::max(0.0, middle - half), std::min(1.0, middle + half)};
	return i.from <= i.to ? std::optional(i) : std::nullopt;
}

std::optional<Interval> nearSegment(const Segment& s, const Segment& other, double distance)
{
	// A stadium is convex: the part in it is one interval, from the lowest to the highest of its three parts.
	std::vector<Interval> parts;
	const auto take = [&](const std::optional<Interval>& i)
	{
		if (i) parts.push_back(*i);
	};
	take(nearPoint(s, other.a, distance));
	take(nearPoint(s, other.b, distance));
	if (const double length = other.length(); length > 0)
	{
		const double ux = (other.b.x - other.a.x) / length, uy = (other.b.y - other.a.y) / length;
		const double along = ux * other.a.x + uy * other.a.y, across = uy * other.a.x - ux * other.a.y;
		const auto i = inBand(s, ux, uy, along, along + length);
		const auto j = inBand(s, uy, -ux, across - distance, across + distance);
		if (i && j && std::max(i->from, j->from) <= std::min(i->to, j->to))
			parts.push_back({std::max(i->from, j->from), std::min(i->to, j->to)});
	}
	if (parts.empty()) return std::nullopt;
	Interval hull = parts.front();
	for (const Interval& p : parts) hull = {std::min(hull.from, p.from), std::max(hull.to, p.to)};
	return hull;
}

}  // namespace ridgemap::apps
