// SPDX-License-Identifier: BSD-3-Clause
#include "sampled_line.h"

#include <algorithm>
#include <cmath>

#include "free_cut.h"

namespace ridgemap
{
SampledLine::SampledLine(const Polyline& line, const FreeSpace& space, double sigma) : line_(line), path_(line)
{
	fillOccupancies();
	const double length = path_.length();
	const int pieces = std::max(1, int(std::ceil(length / (spacing * sigma))));
	step_ = length / pieces;
	// The last place of a closed line is its first.
	const int count = line.closed ? pieces : pieces + 1;
	std::size_t node = 1;
	for (int i = 0; i < count; i++) evidence_.push_back(evidenceAt(i * step_, node, space, sigma));
}

Evidence SampledLine::sum(std::size_t i, int reach, int& count) const
{
	Evidence total;
	count = 0;
	const int n = int(size());
	if (line_.closed) reach = std::min(reach, (n - 1) / 2);
	for (int k = int(i) - reach; k <= int(i) + reach; k++)
	{
		if (!line_.closed && (k < 0 || k >= n)) continue;
		const Evidence& e = evidence_[std::size_t((k + n) % n)];
		total.hits += e.hits;
		total.passes += e.passes;
		count++;
	}
	return total;
}

Polyline SampledLine::stretch(double a, double b) const
{
	Polyline part;
	const auto add = [&](Vec2 p, const VertexInfo& info)
	{
		if (!part.points.empty() && part.points.back() == Point2{p.x, p.y}) return;
		part.points.push_back({p.x, p.y});
		part.info.push_back(info);
	};
	add(path_.at(a), infoAt(a));
	const std::size_t nodes = line_.points.size();
	for (const double turn : {0.0, path_.length()})
	{
		if (turn > 0 && b <= path_.length()) break;
		for (std::size_t k = turn > 0 ? 1 : 0; k < nodes; k++)
			if (turn + path_.arc(k) > a && turn + path_.arc(k) < b)
				add({line_.points[k].x, line_.points[k].y}, line_.info[k]);
	}
	add(path_.at(b), infoAt(b));
	return part;
}

Evidence SampledLine::evidenceAt(double s, std::size_t& node, const FreeSpace& space, double sigma) const
{
	const Vec2 p = path_.at(s), before = behind(s - spacing * sigma), after = behind(s + spacing * sigma);
	while (node + 1 < line_.points.size() && path_.arc(node) < s) node++;
	Evidence e;
	e.hits = hitsOf(occupancyBetween(node, s));
	e.passes = passesAcross(space, space.frame().toLattice({p.x, p.y}), unit(Frame::rotateToLattice(after - before)));
	return e;
}

/** Vertices that wall passes have added lie on no ridge: their density is that of the ridge beside them. */
void SampledLine::fillOccupancies()
{
	const std::size_t n = line_.points.size();
	std::size_t last = n;  // the last vertex on a ridge, n: none yet
	for (std::size_t k = 0; k < n; k++)
	{
		const double here = double(line_.info[k].occupancy);
		occupancies_.push_back(here);
		if (!(here > 0)) continue;
		for (std::size_t i = last == n ? 0 : last + 1; i < k; i++)
		{
			const double before = last == n ? here : occupancies_[last];
			const double d = last == n ? 0 : path_.arc(k) - path_.arc(last);
			const double t = d > 0 ? (path_.arc(i) - path_.arc(last)) / d : 0;
			occupancies_[i] = before + t * (here - before);
		}
		last = k;
	}
	for (std::size_t i = last == n ? n : last + 1; i < n; i++) occupancies_[i] = occupancies_[last];
}

/** Place at an arc length that may lie beyond the ends of an open line. */
Vec2 SampledLine::behind(double s) const
{
	return path_.at(line_.closed ? s : std::max(0.0, std::min(path_.length(), s)));
}

/** Density between node - 1 and node. */
double SampledLine::occupancyBetween(std::size_t node, double s) const
{
	const double a = path_.arc(node - 1), d = path_.arc(node) - a, t = d > 0 ? (s - a) / d : 0;
	return (1 - t) * occupancies_[node - 1] + t * occupancies_[node];
}

VertexInfo SampledLine::infoAt(double s) const
{
	if (s >= path_.length() && line_.closed) s -= path_.length();
	std::size_t node = 1;
	while (node + 1 < line_.points.size() && path_.arc(node) < s) node++;
	const double a = path_.arc(node - 1), d = path_.arc(node) - a, t = d > 0 ? (s - a) / d : 0;
	const VertexInfo &u = line_.info[node - 1], &v = line_.info[node];
	const double curvature = (1 - t) * double(u.curvature) + t * double(v.curvature);
	VertexInfo info;
	info.occupancy = float(occupancyBetween(node, s));
	info.curvature = float(curvature);
	info.standardError = std::max(u.standardError, v.standardError);
	return info;
}

}  // namespace ridgemap
