// SPDX-License-Identifier: BSD-3-Clause
#include "wall_maker.h"

#include <algorithm>
#include <cmath>

#include "wall_path.h"
#include "walls.h"

namespace ridgemap
{
namespace
{
constexpr double seatReach =
	1;  ///< farthest that a led end is moved when the line below it has been drawn anew [sigma]

bool isLed(const Polyline& line, bool back)
{
	return !line.closed && (back ? line.info.back() : line.info.front()).origin == VertexOrigin::junction;
}
}  // namespace

WallMaker::WallMaker(const Options& options)
	: options_(options),
	  clear_(options),
	  withdraw_(options),
	  sides_(options),
	  joiners_{EndJoiner(options), EndJoiner(options), EndJoiner(options)},
	  grid_(4 * options.sigma),
	  closeGaps_(options)
{
}

std::vector<Polyline> WallMaker::make(const Lines& ridges, const FreeSpace& space)
{
	// What rays passed through goes before lines are pruned and joined, so that no other line is led to it.
	Lines lines = clear_.cut(cutRidges(ridges), space, false);
	lines = sides_.merge(withoutShort(lines));
	lines = shape(withoutShort(lines));
	if (options_.attach) lines = joinEnds(lines);
	if (options_.trim) lines = trim(lines);
	// Bridges, leads and corners in free space are withdrawn while vertices still know the density.
	lines = withdraw_.cut(lines, space, options_.prune);
	lines = straighten(lines);
	if (options_.attach) lines = closeGaps_.close(seat(lines));

	std::vector<Polyline> walls;
	for (const LinePtr& line : lines) walls.push_back(*line);
	return walls;
}

/** Without weak stretches. */
Lines WallMaker::cutRidges(const Lines& ridges)
{
	if (!(options_.minCurvature > 0)) return ridges;
	Lines result;
	for (const LinePtr& ridge : ridges)
	{
		const auto cut = [&]
		{
			Lines parts;
			for (Polyline& part : cutWeak(*ridge, options_))
				parts.push_back(std::make_shared<const Polyline>(std::move(part)));
			return parts;
		};
		const Lines& parts = strong_.get(MemoKey().add(ridge), cut);
		result.insert(result.end(), parts.begin(), parts.end());
	}
	strong_.forgetUnused();
	return result;
}

Lines WallMaker::withoutShort(const Lines& lines) const
{
	if (!options_.prune) return lines;
	Lines result;
	for (const LinePtr& line : lines)
		if (!isShort(*line, options_)) result.push_back(line);
	return result;
}

/** Corners come before ends are joined: these are then led to where the walls are. */
Lines WallMaker::shape(const Lines& lines)
{
	Lines result;
	for (const LinePtr& line : lines)
	{
		const auto sharpened = [&] { return std::make_shared<const Polyline>(sharpenCorners(*line, options_)); };
		result.push_back(options_.sharpen ? shaped_.get(MemoKey().add(line), sharpened) : line);
	}
	shaped_.forgetUnused();
	return result;
}

Lines WallMaker::joinEnds(const Lines& lines)
{
	Lines result = lines;
	for (EndJoiner& round : joiners_) result = round.join(result);
	return result;
}

/** Free ends go back to the end of the surface, unless another line was led to them. */
Lines WallMaker::trim(const Lines& lines)
{
	std::vector<Point2> guests;
	for (const LinePtr& line : lines)
		for (const bool back : {false, true})
			if (isLed(*line, back)) guests.push_back(endOf(*line, back));
	std::sort(guests.begin(), guests.end(), [](const Point2& a, const Point2& b) { return a.x < b.x; });
	const auto visited = [&](const Point2& p, double range)
	{
		const auto first = std::lower_bound(guests.begin(), guests.end(), p.x - range,
											[](const Point2& g, double x) { return g.x < x; });
		return std::any_of(first, guests.end(),
						   [&](const Point2& g) {
							   return g.x < p.x + range && norm(Vec2{g.x - p.x, g.y - p.y}) < range;
						   });
	};
	Lines result;
	for (const LinePtr& line : lines)
	{
		std::array<bool, 2> free{};
		for (const bool back : {false, true})
		{
			if (line->closed || reasonAt(*line, back) == StopReason::hitPolyline) continue;
			free[back] = !visited(endOf(*line, back), visitedRange(*line, options_));
		}
		if (!free[0] && !free[1])
			result.push_back(line);
		else
			result.push_back(trimmed_.get(
				MemoKey().add(line).add(free[0]).add(free[1]),
				[&] { return std::make_shared<const Polyline>(trimEnds(*line, free[0], free[1], options_)); }));
	}
	trimmed_.forgetUnused();
	return result;
}

Lines WallMaker::straighten(const Lines& lines)
{
	Lines result;
	for (const LinePtr& line : lines)
		result.push_back(straightened_.get(MemoKey().add(line),
										   [&]
										   {
											   Polyline p = *line;
											   if (options_.straighten) p = straightenRuns(p, options_);
											   if (options_.correctBends) p = correctBends(p, options_);
											   const WallNoise noise = wallNoise(*line, options_.sigma);
											   p.noise = noise.noise;
											   p.noiseSupported = noise.supported;
											   return std::make_shared<const Polyline>(std::move(p));
										   }));
	straightened_.forgetUnused();
	return result;
}

/** Led ends go to where the lines below them have come to lie. */
Lines WallMaker::seat(const Lines& lines)
{
	grid_.follow(lines);
	Lines result;
	for (const LinePtr& line : lines)
	{
		LineGrid::NearEnds near =
			grid_.nearEnds(line, seatReach * options_.sigma, lines, [&](bool back) { return isLed(*line, back); });
		if (near.numbers[0].size() + near.numbers[1].size() == 0)
			result.push_back(line);
		else
			result.push_back(seated_.get(std::move(near.key), [&] { return seated(line, near.numbers, lines); }));
	}
	seated_.forgetUnused();
	return result;
}

LinePtr WallMaker::seated(const LinePtr& line, const std::array<std::vector<int>, 2>& near, const Lines& lines) const
{
	Polyline p = *line;
	const std::size_t n = p.points.size();
	for (const bool back : {false, true})
	{
		const Point2 at = endOf(*line, back), before = line->points[back ? n - 2 : 1];
		const Vec2 tip{at.x, at.y}, along = unit(tip - Vec2{before.x, before.y});
		const bool fitted = line->info[back ? n - 2 : 0].shape != WallShape::curve;
		double best = seatReach * options_.sigma;
		for (const int i : near[back])
		{
			const std::vector<Point2>& q = lines[std::size_t(i)]->points;
			for (std::size_t k = 1; k < q.size(); k++)
			{
				const bool own = lines[std::size_t(i)] == line && (back ? k + 2 >= n : k <= 2);
				const Vec2 a{q[k - 1].x, q[k - 1].y}, b{q[k].x, q[k].y};
				const SegmentFoot foot = footOnSegment(a, b, tip);
				if (own || foot.distance >= best) continue;
				best = foot.distance;
				Vec2 seat = a + foot.t * (b - a);
				// Along its own direction, where the segment is met that way. A fitted line is not turned aside: a
				// vertex will close the gap.
				const double sine = cross(along, b - a), t = sine != 0 ? cross(a - tip, b - a) / sine : 0;
				const double u = sine != 0 ? cross(a - tip, along) / sine : -1;
				if (u >= 0 && u <= 1 && std::abs(t) < seatReach * options_.sigma)
					seat = tip + t * along;
				else if (fitted)
					seat = tip;
				(back ? p.points.back() : p.points.front()) = {seat.x, seat.y};
			}
		}
	}
	return std::make_shared<const Polyline>(std::move(p));
}

}  // namespace ridgemap
