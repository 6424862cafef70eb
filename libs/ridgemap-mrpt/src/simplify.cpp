// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/polyline_index.h>
#include <ridgemap/simplify.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "junctions.h"
#include "shortcuts.h"

namespace ridgemap
{
namespace
{
/** Number of segments, then sum of squared deviations. */
struct Cost
{
	std::size_t segments = std::numeric_limits<std::size_t>::max();
	double deviation = 0;

	bool operator<(const Cost& o) const
	{
		return segments != o.segments ? segments < o.segments : deviation < o.deviation;
	}
	bool isReached() const { return segments != std::numeric_limits<std::size_t>::max(); }
};

struct Route
{
	Cost cost;
	std::vector<std::size_t> vertices;
};

/** A chain with its shortcuts: the graph in which the best route from one vertex to another is looked for. */
struct Graph
{
	std::vector<std::vector<std::size_t>> next;
	DeviationSums sums;

	Graph(const std::vector<Point2>& chain, double tolerance, std::size_t reach)
		: next(shortcuts(chain, tolerance, reach)), sums(chain)
	{
	}
};

/** Dynamic programming from vertex `first` to vertex `last`, with at least `least` segments (1 .. 3): a state is a
 * vertex and the number of segments so far, counted up to `least`. */
Route bestRoute(const Graph& graph, std::size_t first, std::size_t last, std::size_t least)
{
	struct State
	{
		Cost cost;
		std::size_t vertex = 0, level = 0;  ///< of the state before
	};
	std::vector<State> states((last - first + 1) * (least + 1));
	const auto at = [&](std::size_t vertex, std::size_t level) -> State&
	{ return states[(vertex - first) * (least + 1) + level]; };
	at(first, 0).cost = {0, 0};
	for (std::size_t i = first; i < last; i++)
		for (std::size_t level = 0; level <= least; level++)
		{
			const Cost here = at(i, level).cost;
			if (!here.isReached()) continue;
			for (const std::size_t j : graph.next[i])
			{
				if (j > last) break;
				const Cost there{here.segments + 1, here.deviation + graph.sums.between(i, j)};
				State& next = at(j, std::min(level + 1, least));
				if (there < next.cost) next = {there, i, level};
			}
		}
	Route route;
	route.cost = at(last, least).cost;
	if (!route.cost.isReached()) return route;
	for (std::size_t vertex = last, level = least;;)
	{
		route.vertices.push_back(vertex);
		if (vertex == first) break;
		const State& s = at(vertex, level);
		vertex = s.vertex;
		level = s.level;
	}
	std::reverse(route.vertices.begin(), route.vertices.end());
	return route;
}

Polyline keepVertices(const Polyline& line, const std::vector<std::size_t>& vertices)
{
	Polyline kept = line;
	kept.points.clear();
	kept.info.clear();
	for (const std::size_t i : vertices)
	{
		kept.points.push_back(line.points[i]);
		if (i < line.info.size()) kept.info.push_back(line.info[i]);
	}
	return kept;
}

/** Between fixed vertices, of which the first and the last vertex are two. */
Polyline simplifyOpen(const Polyline& line, const std::vector<bool>& isFixed, double tolerance, std::size_t least)
{
	const std::size_t n = line.points.size();
	const Graph graph(line.points, tolerance, n);
	std::vector<std::size_t> vertices{0};
	for (std::size_t from = 0, to = 1; to < n; to++)
	{
		if (to + 1 < n && !isFixed[to]) continue;
		const Route route = bestRoute(graph, from, to, from == 0 && to + 1 == n ? std::min(least, n - 1) : 1);
		vertices.insert(vertices.end(), route.vertices.begin() + 1, route.vertices.end());
		from = to;
	}
	return keepVertices(line, vertices);
}

/** A closed polyline that starts at another of its vertices. */
Polyline startAt(const Polyline& line, std::size_t start)
{
	const std::size_t n = line.points.size() - 1;
	std::vector<std::size_t> order;
	for (std::size_t i = 0; i <= n; i++) order.push_back((start + i) % n);
	return keepVertices(line, order);
}

/** The vertices of which one must be in every route around: the starts of all shortcuts across one place, the place
 * being the one with the fewest of them. */
std::vector<std::size_t> possibleStarts(const Graph& twice, std::size_t n)
{
	std::vector<std::size_t> across(2 * n, 0);
	for (std::size_t i = 0; i < n; i++)
	{
		const std::size_t farthest = twice.next[i].back();
		for (std::size_t place = i; place < farthest && place < 2 * n; place++) across[place % n]++;
	}
	const std::size_t place =
		std::size_t(std::min_element(across.begin(), across.begin() + std::ptrdiff_t(n)) - across.begin());
	std::vector<std::size_t> starts;
	for (std::size_t i = 0; i < n; i++)
		if ((i <= place && place < twice.next[i].back()) || place + n < twice.next[i].back()) starts.push_back(i);
	return starts;
}

Polyline simplifyClosed(const Polyline& line, const std::vector<bool>& isFixed, double tolerance)
{
	constexpr std::size_t least = 3;
	const std::size_t n = line.points.size() - 1;
	if (n <= least) return line;
	const auto fixed = std::find(isFixed.begin(), isFixed.end() - 1, true);
	if (fixed != isFixed.end() - 1)
	{
		const auto shift = std::size_t(fixed - isFixed.begin());
		std::vector<bool> turned;
		for (std::size_t i = 0; i <= n; i++) turned.push_back(isFixed[(shift + i) % n]);
		return simplifyOpen(startAt(line, shift), turned, tolerance, least);
	}
	std::vector<Point2> twice(line.points.begin(), line.points.end() - 1);
	twice.insert(twice.end(), line.points.begin(), line.points.end());
	const Graph graph(twice, tolerance, n - 1);
	Route best;
	for (const std::size_t start : possibleStarts(graph, n))
		if (Route route = bestRoute(graph, start, start + n, least); route.cost < best.cost) best = std::move(route);
	for (std::size_t& i : best.vertices) i %= n;
	return keepVertices(line, best.vertices);
}

/** Greatest distance of points of `lines`, at most `step` apart, to the indexed polylines. */
double greatestDistance(const std::vector<Polyline>& lines, const PolylineIndex& to, double step)
{
	double greatest = 0;
	const auto look = [&](const Point2& p)
	{
		const auto nearest = to.nearest(p);
		greatest = std::max(greatest, nearest ? nearest->distance : std::numeric_limits<double>::infinity());
	};
	for (const Polyline& line : lines)
		for (std::size_t i = 0; i < line.points.size(); i++)
		{
			look(line.points[i]);
			if (i == 0) continue;
			const Point2 &a = line.points[i - 1], &b = line.points[i];
			const auto parts = std::size_t(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / step));
			for (std::size_t k = 1; k < parts; k++)
			{
				const double t = double(k) / double(parts);
				look({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
			}
		}
	return greatest;
}
}  // namespace

std::vector<Polyline> simplified(const std::vector<Polyline>& lines, double tolerance)
{
	if (!(tolerance >= 0) || !std::isfinite(tolerance))
		throw std::invalid_argument("tolerance of a simplification is " + std::to_string(tolerance) +
									"; it must be a number of metres from 0");
	std::vector<Polyline> out = withJunctions(lines);
	if (tolerance == 0) return out;
	const auto fixed = junctionVertices(out);
	for (std::size_t i = 0; i < out.size(); i++)
		out[i] =
			out[i].closed ? simplifyClosed(out[i], fixed[i], tolerance) : simplifyOpen(out[i], fixed[i], tolerance, 1);
	return out;
}

double greatestDeviation(const std::vector<Polyline>& a, const std::vector<Polyline>& b, double step)
{
	if (a.empty() && b.empty()) return 0;
	const double spacing = std::max(step, 0.05);
	return std::max(greatestDistance(a, PolylineIndex(b, spacing), step),
					greatestDistance(b, PolylineIndex(a, spacing), step));
}

}  // namespace ridgemap
