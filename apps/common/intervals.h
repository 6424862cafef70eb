// SPDX-License-Identifier: BSD-3-Clause
// Parts of segments that lie within reach of something: intervals of the share t = 0 .. 1 of the way.
#pragma once

#include <optional>
#include <vector>

#include "segment.h"

namespace ridgemap::apps
{
struct Interval
{
	double from = 0, to = 0;
};

/** A set of disjoint intervals in rising order. */
using IntervalSet = std::vector<Interval>;

/** Sorts and joins intervals. */
IntervalSet unite(std::vector<Interval> intervals);
IntervalSet intersect(const IntervalSet& a, const IntervalSet& b);
double sizeOf(const IntervalSet& set);

/** Part of s within a distance of a point. */
std::optional<Interval> nearPoint(const Segment& s, const Point2& p, double distance);

/** Part of s within a distance of another segment. */
std::optional<Interval> nearSegment(const Segment& s, const Segment& other, double distance);

}  // namespace ridgemap::apps
