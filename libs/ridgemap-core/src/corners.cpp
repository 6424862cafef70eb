// SPDX-License-Identifier: BSD-3-Clause
// Corner sharpening. A ridge cuts a corner of 90 degrees by 0.72 sqrt(sigma^2 + s^2) (paper section VI-C); lines fitted
// where the corner is no longer felt lead to where the surfaces meet.
#include <algorithm>
#include <optional>

#include "wall_path.h"
#include "walls.h"

namespace ridgemap
{
namespace
{
// Lengths in units of se = sqrt(sigma^2 + s^2), the width of the density across the wall.
constexpr double gap = 2.4;                      ///< from the apex to where a line is fitted
constexpr double windows[] = {4, 3, 2.25, 1.5};  ///< lengths over which it is fitted, the longest straight one counts
constexpr double largestRms = 0.08;              ///< of a straight arm about its line
constexpr double largestTurn = 0.9;              ///< cosine of the least turn that makes a corner, 0.45 rad
constexpr double leastTurn = -0.94;              ///< cosine of the greatest turn: sharper ones are hooks
constexpr double largestWidth = 1.6;             ///< of the stretch in which 20 to 80 % of the turn happen
constexpr double farApex = 2.5;                  ///< farthest that the intersection may lie from the polyline
constexpr double sampling = 0.25;

/** A corner to be made: the stretch that it replaces and its apex. */
struct Corner
{
	double from = 0, to = 0;  ///< arc lengths; from may be negative and to beyond the length on a closed path
	Vec2 apex;
};

class CornerFinder
{
 public:
	CornerFinder(const Path& path, double se) : path_(path), se_(se) {}

	std::vector<Corner> run(bool closed) const
	{
		std::vector<Corner> corners;
		const double step = sampling * se_, reach = gap * se_;
		const int n = int(path_.length() / step);
		for (int i = 0; i <= n; i++)
		{
			const double s = i * step;
			if (!isSharpest(s, step, reach)) continue;
			std::optional<Corner> corner = at(s);
			if (!corner) continue;
			const bool overlaps = !corners.empty() && corner->from < corners.back().to;
			const bool wraps = closed && !corners.empty() && corner->to - path_.length() > corners.front().from;
			if (!overlaps && !wraps) corners.push_back(*corner);
		}
		return corners;
	}

 private:
	/** Cosine of the turn between the directions behind and before s. */
	double turn(double s) const
	{
		const double skip = 0.8 * se_, length = 1.6 * se_;
		if (!path_.has(s - skip - length, s + skip + length)) return 1;
		return dot(path_.direction(s - skip - length, length), path_.direction(s + skip, length));
	}

	bool isSharpest(double s, double step, double reach) const
	{
		const double here = turn(s);
		if (here > largestTurn) return false;
		for (double d = step; d <= reach; d += step)
			if (turn(s - d) < here || turn(s + d) <= here) return false;
		return true;
	}

	/** The longest straight arm that ends `gap` from s, before (sign -1) or behind it (+1). */
	std::optional<FittedLine> arm(double s, int sign) const
	{
		for (const double w : windows)
		{
			const double near = s + sign * gap * se_, far = near + sign * w * se_;
			if (!path_.has(std::min(near, far), std::max(near, far))) continue;
			if (!path_.has(std::min(s, far), std::max(s, far))) continue;
			const FittedLine line = fitLine(path_, std::min(near, far), std::max(near, far), sampling * se_);
			if (line.rms <= largestRms * se_) return line;
		}
		return std::nullopt;
	}

	std::optional<Corner> at(double s) const
	{
		const std::optional<FittedLine> a = arm(s, -1), b = arm(s, +1);
		if (!a || !b) return std::nullopt;
		const double cosine = dot(a->direction, b->direction), sine = cross(a->direction, b->direction);
		if (cosine > largestTurn || cosine < leastTurn) return std::nullopt;
		const double t = cross(b->mean - a->mean, b->direction) / sine;
		const Vec2 apex = a->mean + t * a->direction;
		// The intersection must lie ahead of the one arm and behind the other, and near the polyline.
		if (dot(apex - path_.at(s - gap * se_), a->direction) < 0 ||
			dot(path_.at(s + gap * se_) - apex, b->direction) < 0)
			return std::nullopt;
		const double distance = norm(apex - path_.at(s));
		if (distance > farApex * se_) return std::nullopt;
		if (turningWidth(s, a->direction, b->direction) > largestWidth * se_) return std::nullopt;
		return Corner{s - gap * se_, s + gap * se_, apex};
	}

	/** Length of the stretch in which 20 to 80 % of the turn from a to b happen. */
	double turningWidth(double s, Vec2 a, Vec2 b) const
	{
		const double step = 0.1 * se_, whole = norm(b - a);
		double first = s - gap * se_, last = s + gap * se_;
		bool begun = false;
		for (double u = s - gap * se_; u < s + gap * se_; u += step)
		{
			const double share = norm(path_.direction(u, step) - a) / whole;
			if (!begun && share > 0.2)
			{
				first = u;
				begun = true;
			}
			if (share < 0.8) last = u + step;
		}
		return last - first;
	}

	const Path& path_;
	double se_;
};

/** Vertices of the line with those between the feet of each corner replaced by its apex. */
Polyline replaceCorners(const Polyline& line, const Path& path, const std::vector<Corner>& corners)
{
	Polyline result = line;
	result.points.clear();
	result.info.clear();
	std::size_t next = 0;
	const double length = path.length();
	const auto add = [&](const Corner& c)
	{
		result.points.push_back({c.apex.x, c.apex.y});
		result.info.push_back(madeVertex(VertexOrigin::corner));
	};
	const auto inside = [&](double s)
	{
		return std::any_of(corners.begin(), corners.end(),
						   [&](const Corner& c)
						   {
							   const bool wrapped = line.closed && ((s + length > c.from && s + length < c.to) ||
																	(s - length > c.from && s - length < c.to));
							   return (s > c.from && s < c.to) || wrapped;
						   });
	};
	for (std::size_t k = 0; k < line.points.size(); k++)
	{
		const double s = path.arc(k);
		for (; next < corners.size() && 0.5 * (corners[next].from + corners[next].to) <= s; next++) add(corners[next]);
		if (inside(s) || (line.closed && k + 1 == line.points.size())) continue;
		result.points.push_back(line.points[k]);
		result.info.push_back(line.info[k]);
	}
	if (line.closed)
	{
		result.points.push_back(result.points.front());
		result.info.push_back(result.info.front());
	}
	return result;
}
}  // namespace

Polyline sharpenCorners(const Polyline& line, const Options& options)
{
	const Path path(line);
	const double se = densityWidth(line, options.sigma);
	if (path.length() < 2 * (gap + windows[3]) * se) return line;
	const std::vector<Corner> corners = CornerFinder(path, se).run(line.closed);
	return corners.empty() ? line : replaceCorners(line, path, corners);
}

}  // namespace ridgemap
