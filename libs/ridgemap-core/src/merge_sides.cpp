// SPDX-License-Identifier: BSD-3-Clause
#include "merge_sides.h"

#include <algorithm>
#include <cmath>

#include "wall_path.h"
#include "walls.h"

namespace ridgemap
{
namespace
{
constexpr double parallel = 0.9;  ///< least cosine between lines that run along each other

/** Where another line runs along a vertex. */
struct Companion
{
	bool found = false, longer = false;
	double distance = 0;
	Vec2 foot;
	double occupancy = 0;
};

/** The longer of two lines is kept; which one that is must not depend on their order. */
bool isLonger(const Polyline& a, double lengthA, const Polyline& b, double lengthB)
{
	if (lengthA != lengthB) return lengthA > lengthB;
	const Point2 &p = a.points.front(), &q = b.points.front();
	return p.x != q.x ? p.x < q.x : p.y < q.y;
}

Vec2 directionAt(const Polyline& line, std::size_t k)
{
	return unit(vertexAt(line, std::min(k + 1, line.points.size() - 1)) - vertexAt(line, k > 0 ? k - 1 : 0));
}

void tryLine(const Polyline& other, Vec2 p, Vec2 direction, bool longer, Companion& best)
{
	for (std::size_t k = 1; k < other.points.size(); k++)
	{
		const Vec2 a = vertexAt(other, k - 1), b = vertexAt(other, k);
		const SegmentFoot foot = footOnSegment(a, b, p);
		if (foot.distance >= best.distance || std::abs(dot(unit(b - a), direction)) < parallel) continue;
		best = {true, longer, foot.distance, a + foot.t * (b - a),
				double(std::min(other.info[k - 1].occupancy, other.info[k].occupancy))};
	}
}
}  // namespace

SideMerger::SideMerger(const Options& options)
	: sigma_(options.sigma), distance_(options.mergeDistance * options.sigma), grid_(4 * options.sigma)
{
}

Lines SideMerger::merge(const Lines& lines)
{
	const auto hasSide = [](const LinePtr& l) { return l->side != 0; };
	if (!(distance_ > 0) || std::none_of(lines.begin(), lines.end(), hasSide)) return lines;
	grid_.follow(lines);
	Lines result;
	for (std::size_t i = 0; i < lines.size(); i++)
	{
		std::vector<int> numbers;
		const Polyline& line = *lines[i];
		for (std::size_t k = 0; k < line.points.size(); k++)
			for (const int n : grid_.near(line.points[k], distance_))
				if (n != int(i) && lines[std::size_t(n)]->side != 0) numbers.push_back(n);
		std::sort(numbers.begin(), numbers.end());
		numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
		if (numbers.empty() || line.side == 0)
		{
			result.push_back(lines[i]);
			continue;
		}
		MemoKey key;
		Lines near;
		key.add(lines[i]);
		for (const int n : numbers)
		{
			near.push_back(lines[std::size_t(n)]);
			key.add(near.back());
		}
		const Lines& parts = memo_.get(std::move(key), [&] { return merged(lines[i], near); });
		result.insert(result.end(), parts.begin(), parts.end());
	}
	memo_.forgetUnused();
	return result;
}

Lines SideMerger::merged(const LinePtr& line, const Lines& near) const
{
	const double length = line->length();
	std::vector<bool> longer;
	for (const LinePtr& other : near) longer.push_back(isLonger(*other, other->length(), *line, length));
	std::vector<bool> doubled(line->points.size(), false);
	Polyline moved = *line;
	bool changed = false;
	for (std::size_t k = 0; k < line->points.size(); k++)
	{
		const Vec2 p = vertexAt(*line, k), direction = directionAt(*line, k);
		Companion best;
		best.distance = distance_;
		for (std::size_t i = 0; i < near.size(); i++) tryLine(*near[i], p, direction, longer[i], best);
		if (!best.found) continue;
		changed = true;
		doubled[k] = best.longer;
		const double mine = double(line->info[k].occupancy), sum = mine + best.occupancy;
		const Vec2 q = sum > 0 ? p + (best.occupancy / sum) * (best.foot - p) : p;
		moved.points[k] = {q.x, q.y};
	}
	if (!changed) return {line};
	if (moved.closed) moved.points.back() = moved.points.front();
	Lines parts;
	for (Polyline& part : withoutVertices(moved, doubled, StopReason::hitPolyline))
		parts.push_back(std::make_shared<const Polyline>(std::move(part)));
	return parts;
}

}  // namespace ridgemap
