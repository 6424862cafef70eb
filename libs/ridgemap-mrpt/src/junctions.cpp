// SPDX-License-Identifier: BSD-3-Clause
#include "junctions.h"

#include <algorithm>
#include <utility>

namespace ridgemap
{
namespace
{
constexpr double nanometre = 1e-9;

bool byPlace(const Point2& a, const Point2& b)
{
	return a.x != b.x ? a.x < b.x : a.y < b.y;
}

/** The ends of all open polylines, by x. */
std::vector<Point2> endsOf(const std::vector<Polyline>& lines)
{
	std::vector<Point2> ends;
	for (const Polyline& line : lines)
		if (!line.closed && !line.points.empty())
		{
			ends.push_back(line.points.front());
			ends.push_back(line.points.back());
		}
	std::sort(ends.begin(), ends.end(), byPlace);
	ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
	return ends;
}

/** Position along the segment from a to b, if p lies inside it, strictly between 0 and 1. */
bool liesInside(const Point2& a, const Point2& b, const Point2& p, double& along)
{
	if (p == a || p == b) return false;
	const double dx = b.x - a.x, dy = b.y - a.y, lengthSqr = dx * dx + dy * dy;
	along = (p.x - a.x) * dx + (p.y - a.y) * dy;
	if (!(along > 0 && along < lengthSqr)) return false;
	const double beside = (p.x - a.x) * dy - (p.y - a.y) * dx;
	return beside * beside <= nanometre * nanometre * lengthSqr;
}

std::vector<Point2> endsInside(const Point2& a, const Point2& b, const std::vector<Point2>& ends)
{
	const double low = std::min(a.x, b.x) - nanometre, high = std::max(a.x, b.x) + nanometre;
	std::vector<std::pair<double, Point2>> found;
	for (auto it = std::lower_bound(ends.begin(), ends.end(), Point2{low, a.y},
									[](const Point2&p, const Point2&q) { return p.x < q.x; });
		 it != ends.end() && it->x <= high; ++it)
		if (double along = 0; liesInside(a, b, *it, along)) found.emplace_back(along, *it);
	std::sort(found.begin(), found.end(),
			  [](const auto& u, const auto& v)
			  { return u.first != v.first ? u.first < v.first : byPlace(u.second, v.second); });
	std::vector<Point2> points;
	for (const auto& f : found) points.push_back(f.second);
	return points;
}
}  // namespace

std::vector<Polyline> withJunctions(const std::vector<Polyline>& lines)
{
	const std::vector<Point2> ends = endsOf(lines);
	std::vector<Polyline> out = lines;
	for (Polyline& line : out)
	{
		Polyline split = line;
		split.points.clear();
		split.info.clear();
		for (std::size_t i = 0; i < line.points.size(); i++)
		{
			if (i > 0)
				for (const Point2& p : endsInside(line.points[i - 1], line.points[i], ends))
				{
					split.points.push_back(p);
					if (!line.info.empty()) split.info.emplace_back();
				}
			split.points.push_back(line.points[i]);
			if (i < line.info.size()) split.info.push_back(line.info[i]);
		}
		line = std::move(split);
	}
	return out;
}

std::vector<std::vector<bool>> junctionVertices(const std::vector<Polyline>& lines)
{
	const std::vector<Point2> ends = endsOf(lines);
	std::vector<std::vector<bool>> fixed;
	for (const Polyline& line : lines)
	{
		fixed.emplace_back();
		for (const Point2& p : line.points)
			fixed.back().push_back(std::binary_search(ends.begin(), ends.end(), p, byPlace));
	}
	return fixed;
}

}  // namespace ridgemap
