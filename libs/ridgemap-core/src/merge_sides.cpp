// SPDX-License-Identifier: BSD-3-Clause
#include "merge_sides.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "wall_path.h"
#include "walls.h"

namespace ridgemap
{
namespace
{
constexpr double reach = 1.3;      ///< faces run along each other while they are nearer than this [sigma]
constexpr double ahead = 0.25;     ///< farthest that an opposite may lie ahead or behind [sigma]
constexpr double opposite = -0.9;  ///< largest cosine between the normals of two faces of a wall

/** Where another face lies opposite of a place. */
struct Opposite
{
	double distance = 0;
	std::size_t segment = 0;  ///< that ends at this vertex; 0: there is no opposite
	double t = 0;             ///< from its beginning (0) to its end (1)
	Vec2 foot;

	/** Vertex nearest to the foot. */
	std::size_t vertex() const { return t < 0.5 ? segment - 1 : segment; }
};

/** The longer of two lines is kept; which one that is must not depend on their order. */
bool isLonger(const Polyline& a, const Polyline& b)
{
	const double lengthA = a.length(), lengthB = b.length();
	if (lengthA != lengthB) return lengthA > lengthB;
	// What was seen from unknown places gives the same line twice, once for each side.
	if (a.side != b.side) return a.side > b.side;
	return std::lexicographical_compare(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
										[](const Point2& p, const Point2& q)
										{ return p.x != q.x ? p.x < q.x : p.y < q.y; });
}

/** Unit vector at a vertex to where the line was seen from. */
Vec2 normalAt(const Polyline& line, std::size_t k)
{
	const Vec2 d = vertexAt(line, std::min(k + 1, line.points.size() - 1)) - vertexAt(line, k > 0 ? k - 1 : 0);
	return double(line.side) * leftNormal(unit(d));
}

Opposite oppositeOf(Vec2 p, Vec2 normal, const Polyline& other, double sigma)
{
	Opposite best;
	best.distance = reach * sigma;
	for (std::size_t k = 1; k < other.points.size(); k++)
	{
		const Vec2 a = vertexAt(other, k - 1), b = vertexAt(other, k);
		const SegmentFoot foot = footOnSegment(a, b, p);
		if (foot.distance >= best.distance) continue;
		const Vec2 q = a + foot.t * (b - a);
		if (double(other.side) * dot(leftNormal(unit(b - a)), normal) > opposite) continue;
		if (std::abs(cross(normal, q - p)) > ahead * sigma) continue;
		best = {foot.distance, k, foot.t, q};
	}
	return best;
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
		Lines near;
		MemoKey key;
		key.add(lines[i]);
		for (const LinePtr& other : grid_.beside(int(i)))
		{
			if (other->side == 0) continue;
			near.push_back(other);
			key.add(other);
		}
		if (near.empty() || lines[i]->side == 0)
		{
			result.push_back(lines[i]);
			continue;
		}
		const Lines& parts = memo_.get(std::move(key), [&] { return merged(lines[i], near); });
		result.insert(result.end(), parts.begin(), parts.end());
	}
	shared_.forgetUnused();
	memo_.forgetUnused();
	return result;
}

SideMerger::Shared SideMerger::shared(const Polyline& longer, const Polyline& shorter) const
{
	const std::size_t n = longer.points.size();
	std::vector<Opposite> opposites;
	for (std::size_t k = 0; k < n; k++)
		opposites.push_back(oppositeOf(vertexAt(longer, k), normalAt(longer, k), shorter, sigma_));

	Shared result;
	std::vector<char> thin(n, 0);
	for (std::size_t first = 0; first < n; first++)
	{
		std::size_t end = first;
		double thickness = 0, length = 0;
		for (; end < n && opposites[end].segment > 0; end++)
		{
			const Vec2 p = vertexAt(longer, end);
			const double step = end > first ? norm(p - vertexAt(longer, end - 1)) : 1e-3 * sigma_;
			thickness += step * dot(p - opposites[end].foot, normalAt(longer, end));
			length += step;
		}
		if (end > first && thickness < distance_ * length) std::fill(&thin[first], &thin[0] + end, 1);
		first = end;
	}
	for (std::size_t k = 0; k < n; k++)
	{
		if (!thin[k]) continue;
		const Opposite& o = opposites[k];
		const double mine = double(longer.info[k].occupancy);
		const double other = double(std::min(shorter.info[o.segment - 1].occupancy, shorter.info[o.segment].occupancy));
		const Vec2 p = vertexAt(longer, k);
		const Vec2 to = mine + other > 0 ? p + (other / (mine + other)) * (o.foot - p) : p;
		result.moves.push_back({k, o.distance, {to.x, to.y}});
	}
	if (result.moves.empty()) return result;
	for (std::size_t k = 0; k < shorter.points.size(); k++)
	{
		const Opposite o = oppositeOf(vertexAt(shorter, k), normalAt(shorter, k), longer, sigma_);
		if (o.segment > 0 && thin[o.vertex()]) result.doubled.push_back(k);
	}
	return result;
}

Lines SideMerger::merged(const LinePtr& line, const Lines& near)
{
	std::vector<bool> doubled(line->points.size(), false);
	std::vector<double> thickness(line->points.size(), reach * sigma_);
	Polyline moved = *line;
	bool changed = false;
	for (const LinePtr& other : near)
	{
		const bool kept = isLonger(*line, *other);
		const LinePtr &longer = kept ? line : other, &shorter = kept ? other : line;
		const Shared& s = shared_.get(MemoKey().add(longer).add(shorter), [&] { return shared(*longer, *shorter); });
		changed = changed || !s.moves.empty();
		if (!kept)
			for (const std::size_t k : s.doubled) doubled[k] = true;
		else
			for (const Shared::Move& m : s.moves)
			{
				Point2& to = moved.points[m.vertex];
				const bool tie = m.thickness == thickness[m.vertex] && std::tie(m.to.x, m.to.y) < std::tie(to.x, to.y);
				if (m.thickness >= thickness[m.vertex] && !tie) continue;
				thickness[m.vertex] = m.thickness;
				to = m.to;
			}
	}
	if (!changed) return {line};
	if (moved.closed) moved.points.back() = moved.points.front();
	Lines parts;
	for (Polyline& part : withoutVertices(moved, doubled, StopReason::hitPolyline))
		parts.push_back(std::make_shared<const Polyline>(std::move(part)));
	return parts;
}

}  // namespace ridgemap
