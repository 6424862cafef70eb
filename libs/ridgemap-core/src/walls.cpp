// SPDX-License-Identifier: BSD-3-Clause
#include "walls.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "wall_path.h"

namespace ridgemap
{
namespace
{
constexpr double alwaysAttach =
	1.5;  ///< free ends this close to another line are joined whatever their direction [sigma]
constexpr double leastArc =
	3;  ///< parts of the same line nearer than this along the line are not "another line" [sigma]

Vec2 vec(const Point2& p)
{
	return {p.x, p.y};
}

/** One open end of a line. */
struct LineEnd
{
	int line = -1;
	bool atBack = false;

	bool operator==(const LineEnd& o) const { return line == o.line && atBack == o.atBack; }
};

/** Nearest place to a free end. */
struct Target
{
	bool found = false;
	double distance = 0;
	Point2 foot;
	LineEnd end;  ///< the open end that the foot is, if it is one (line >= 0)
};

/** All segments of some lines, found by place. */
class SegmentGrid
{
 public:
	SegmentGrid(const std::vector<Polyline>& lines, double cell) : lines_(lines), cell_(cell)
	{
		arc_.resize(lines.size());
		for (std::size_t i = 0; i < lines.size(); i++)
		{
			const std::vector<Point2>& p = lines[i].points;
			arc_[i].assign(1, 0.0);
			for (std::size_t k = 1; k < p.size(); k++)
			{
				arc_[i].push_back(arc_[i].back() + norm(vec(p[k]) - vec(p[k - 1])));
				forCells(p[k - 1], p[k], 0,
						 [&](std::vector<std::pair<int, int>>& c) {
							 c.push_back({int(i), int(k)});
						 });
			}
		}
	}

	double arc(int line, std::size_t node) const { return arc_[std::size_t(line)][node]; }
	double length(int line) const { return arc_[std::size_t(line)].back(); }

	/** Calls fn(line, number of the segment's second node) for the segments near p; a segment may come twice. */
	template <class Fn>
	void forNear(const Point2& p, double radius, Fn fn)
	{
		forCells(p, p, radius,
				 [&](const std::vector<std::pair<int, int>>& c)
				 {
					 for (const auto& s : c) fn(s.first, std::size_t(s.second));
				 });
	}

 private:
	template <class Fn>
	void forCells(const Point2& a, const Point2& b, double grow, Fn fn)
	{
		const auto index = [&](double v) { return std::int64_t(std::floor(v / cell_)); };
		for (auto y = index(std::min(a.y, b.y) - grow); y <= index(std::max(a.y, b.y) + grow); y++)
			for (auto x = index(std::min(a.x, b.x) - grow); x <= index(std::max(a.x, b.x) + grow); x++)
				fn(cells_[{y, x}]);
	}

	const std::vector<Polyline>& lines_;
	double cell_;
	std::vector<std::vector<double>> arc_;  ///< arc length at every node
	std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::pair<int, int>>> cells_;
};

class EndJoiner
{
 public:
	EndJoiner(const std::vector<Polyline>& lines, const Options& options)
		: lines_(lines),
		  sigma_(options.sigma),
		  reach_(options.attachDistance * options.sigma),
		  grid_(lines, 4 * options.sigma)
	{
		targets_.resize(2 * lines.size());
		for (std::size_t i = 0; i < lines.size(); i++)
			if (!lines[i].closed)
				for (const bool atBack : {false, true})
					if (!isLed({int(i), atBack})) targetOf({int(i), atBack}) = findTarget({int(i), atBack});
	}

	std::vector<Polyline> run()
	{
		std::vector<Polyline> result;
		std::vector<char> used(lines_.size(), 0);
		// Open groups first from their own beginnings, then what is left: loops of bridged lines.
		for (int pass = 0; pass < 2; pass++)
			for (std::size_t i = 0; i < lines_.size(); i++)
			{
				if (used[i]) continue;
				if (lines_[i].closed)
				{
					if (pass == 1) result.push_back(lines_[i]);
					continue;
				}
				for (const bool atBack : {false, true})
					if (!used[i] && (pass == 1 || !bridged({int(i), atBack})))
						result.push_back(group({int(i), atBack}, used));
			}
		return result;
	}

 private:
	/** An earlier round has led this end to another line: its last vertex lies on no ridge. */
	bool isLed(LineEnd e) const
	{
		const std::vector<VertexInfo>& info = lines_[std::size_t(e.line)].info;
		return (e.atBack ? info.back() : info.front()).origin == VertexOrigin::junction;
	}

	Target& targetOf(LineEnd e) { return targets_[std::size_t(2 * e.line + e.atBack)]; }

	const Point2& place(LineEnd e) const
	{
		const std::vector<Point2>& p = lines_[std::size_t(e.line)].points;
		return e.atBack ? p.back() : p.front();
	}

	/** Unit direction in which a line leaves at its end, taken over the last 1.5 sigma. */
	Vec2 outward(LineEnd e) const
	{
		const std::vector<Point2>& p = lines_[std::size_t(e.line)].points;
		const Vec2 tip = vec(place(e));
		Vec2 d;
		for (std::size_t k = 1; k < p.size(); k++)
		{
			d = tip - vec(e.atBack ? p[p.size() - 1 - k] : p[k]);
			if (norm(d) > 1.5 * sigma_) break;
		}
		return unit(d);
	}

	Target findTarget(LineEnd e)
	{
		Target best;
		best.distance = reach_;
		const Vec2 tip = vec(place(e)), direction = outward(e);
		grid_.forNear(place(e), reach_,
					  [&](int line, std::size_t k)
					  {
						  const std::vector<Point2>& p = lines_[std::size_t(line)].points;
						  const Vec2 a = vec(p[k - 1]), b = vec(p[k]);
						  const SegmentFoot foot = footOnSegment(a, b, tip);
						  if (foot.distance >= best.distance) return;
						  if (line == e.line)
						  {
							  const double at = grid_.arc(line, k - 1) + foot.t * norm(b - a);
							  const double away = e.atBack ? grid_.length(line) - at : at;
							  if (away < std::max(leastArc * sigma_, 3 * foot.distance)) return;
						  }
						  const Vec2 q = a + foot.t * (b - a);
						  if (foot.distance > alwaysAttach * sigma_ && dot(q - tip, direction) < 0.5 * foot.distance)
							  return;
						  best.found = true;
						  best.distance = foot.distance;
						  best.foot = {q.x, q.y};
						  best.end = {};
						  if (lines_[std::size_t(line)].closed) return;
						  if (k == 1 && foot.t <= 0) best = {true, foot.distance, p.front(), {line, false}};
						  if (k + 1 == p.size() && foot.t >= 1) best = {true, foot.distance, p.back(), {line, true}};
					  });
		return best;
	}

	/** Two free ends that are each other's nearest place. */
	bool bridged(LineEnd e)
	{
		const Target& t = targetOf(e);
		return t.found && t.end.line >= 0 && targetOf(t.end).found && targetOf(t.end).end == e;
	}

	/** The line made by entering at `first` and crossing all bridges. */
	Polyline group(LineEnd first, std::vector<char>& used)
	{
		Polyline result;
		const bool openStart = !bridged(first);
		if (openStart) lead(first, result);
		result.startReason = reasonAt(first);
		LineEnd in = first;
		for (;;)
		{
			used[std::size_t(in.line)] = 1;
			const std::vector<Point2>& p = lines_[std::size_t(in.line)].points;
			for (std::size_t k = 0; k < p.size(); k++)
			{
				const Point2& q = p[in.atBack ? p.size() - 1 - k : k];
				if (!result.points.empty() && result.points.back() == q) continue;
				result.points.push_back(q);
				result.info.push_back(lines_[std::size_t(in.line)].info[in.atBack ? p.size() - 1 - k : k]);
			}
			const LineEnd out{in.line, !in.atBack};
			result.endReason = reasonAt(out);
			if (!bridged(out))
			{
				lead(out, result);
				break;
			}
			in = targetOf(out).end;
			if (used[std::size_t(in.line)])
			{
				result.points.push_back(result.points.front());
				result.info.push_back(result.info.front());
				result.closed = true;
				result.startReason = result.endReason = StopReason::closedLoop;
				break;
			}
		}
		return result;
	}

	/** Adds the way from a free end to its foot on another line. */
	void lead(LineEnd e, Polyline& result)
	{
		const Target& t = targetOf(e);
		if (!t.found || t.foot == place(e)) return;
		result.points.push_back(t.foot);
		result.info.push_back(madeVertex(VertexOrigin::junction));
	}

	StopReason reasonAt(LineEnd e)
	{
		if (targetOf(e).found) return StopReason::hitPolyline;
		const Polyline& line = lines_[std::size_t(e.line)];
		return e.atBack ? line.endReason : line.startReason;
	}

	const std::vector<Polyline>& lines_;
	double sigma_, reach_;
	SegmentGrid grid_;
	std::vector<Target> targets_;
};
}  // namespace

std::vector<Polyline> cutWeak(const std::vector<Polyline>& lines, const Options& options)
{
	std::vector<Polyline> result;
	for (const Polyline& line : lines)
	{
		const std::size_t n = line.points.size();
		const auto weak = [&](std::size_t k) { return line.info[k].curvature < float(options.minCurvature); };
		std::size_t first = 0;
		while (first < n && !weak(first)) first++;
		if (first == n)
		{
			result.push_back(line);
			continue;
		}
		// A closed line is cut at its first weak vertex, so that no run is torn at its arbitrary beginning.
		const std::size_t begin = line.closed ? first : 0, count = line.closed ? n - 1 : n;
		Polyline run;
		const auto finish = [&](StopReason reason)
		{
			run.endReason = reason;
			if (run.points.size() >= 2) result.push_back(run);
			run = Polyline();
			run.startReason = StopReason::notARidge;
		};
		run.startReason = line.closed ? StopReason::notARidge : line.startReason;
		for (std::size_t i = 0; i < count; i++)
		{
			const std::size_t k = line.closed ? (begin + i) % count : i;
			if (weak(k))
			{
				finish(StopReason::notARidge);
				continue;
			}
			run.points.push_back(line.points[k]);
			run.info.push_back(line.info[k]);
		}
		finish(line.closed ? StopReason::notARidge : line.endReason);
	}
	return result;
}

std::vector<Polyline> pruneShort(const std::vector<Polyline>& lines, const Options& options)
{
	std::vector<Polyline> result;
	for (const Polyline& line : lines)
		if (line.length() >= options.pruneLength * options.sigma) result.push_back(line);
	return result;
}

std::vector<Polyline> attachFreeEnds(const std::vector<Polyline>& lines, const Options& options)
{
	constexpr int rounds = 3;
	std::vector<Polyline> result = lines;
	for (int i = 0; i < rounds; i++) result = EndJoiner(result, options).run();
	return result;
}

std::vector<Polyline> makeWalls(const std::vector<Polyline>& ridges, const Options& options)
{
	std::vector<Polyline> walls = options.minCurvature > 0 ? cutWeak(ridges, options) : ridges;
	if (options.prune) walls = pruneShort(walls, options);
	// Corners first: free ends are then led to where the walls are in the end.
	if (options.sharpen) walls = sharpenCorners(walls, options);
	if (options.attach) walls = attachFreeEnds(walls, options);
	if (options.trim) walls = trimEnds(walls, options);
	if (options.straighten) walls = straightenRuns(walls, options);
	if (options.correctBends) walls = correctBends(walls, options);
	return walls;
}

}  // namespace ridgemap
