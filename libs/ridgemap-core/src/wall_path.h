// SPDX-License-Identifier: BSD-3-Clause
// What the passes that shape walls share: polylines by arc length, lines fitted to them.
#pragma once

#include <ridgemap/types.h>

#include <algorithm>
#include <vector>

#include "vec2.h"

namespace ridgemap
{
/** Vertex number k. */
inline Vec2 vertexAt(const Polyline& line, std::size_t k)
{
	return {line.points[k].x, line.points[k].y};
}

/** First or last point of a line. */
inline const Point2& endOf(const Polyline& line, bool back)
{
	return back ? line.points.back() : line.points.front();
}

/** Why the line ends at its first or last point. */
inline StopReason reasonAt(const Polyline& line, bool back)
{
	return back ? line.endReason : line.startReason;
}

/** A polyline by arc length. */
class Path
{
 public:
	explicit Path(const Polyline& line) : closed_(line.closed)
	{
		for (const Point2& p : line.points)
		{
			if (!points_.empty()) s_.push_back(s_.back() + norm(Vec2{p.x, p.y} - points_.back()));
			points_.push_back({p.x, p.y});
			if (s_.empty()) s_.push_back(0);
		}
	}

	double length() const { return s_.back(); }
	double arc(std::size_t node) const { return s_[node]; }
	/** The stretch a..b exists: always on a closed path, if it is not longer than the path. */
	bool has(double a, double b) const { return closed_ ? b - a < length() : a >= 0 && b <= length(); }

	Vec2 at(double s) const
	{
		if (closed_) s -= length() * std::floor(s / length());
		const auto it = std::upper_bound(s_.begin(), s_.end(), s);
		const std::size_t k =
			std::min<std::size_t>(std::size_t(std::max<std::ptrdiff_t>(it - s_.begin(), 1)), s_.size() - 1);
		const double d = s_[k] - s_[k - 1], t = d > 0 ? (s - s_[k - 1]) / d : 0;
		return points_[k - 1] + std::max(0.0, std::min(1.0, t)) * (points_[k] - points_[k - 1]);
	}

	/** Direction from s to s + h. */
	Vec2 direction(double s, double h) const { return unit(at(s + h) - at(s)); }

 private:
	bool closed_;
	std::vector<Vec2> points_;
	std::vector<double> s_;
};

/** A line fitted by total least squares. */
struct FittedLine
{
	Vec2 mean, direction;
	double rms = 0;
};

/** Fits a line to the stretch a..b of a path, by points at most `step` apart. */
FittedLine fitLine(const Path& path, double a, double b, double step);

/** Vertex that a pass adds: it lies on no ridge. */
inline VertexInfo madeVertex(VertexOrigin origin)
{
	VertexInfo v;
	v.origin = origin;
	return v;
}

/** sqrt(sigma^2 + s^2), the width of the density across a wall [m], from the median curvature of its vertices, which is
 * 1/(1 + (s/sigma)^2). */
double densityWidth(const Polyline& line, double sigma);

/** Noise of the measurements across a wall, s^2 = -L/lambda1 - sigma^2. */
struct WallNoise
{
	double noise = 0;        ///< median over the vertices [m]
	bool supported = false;  ///< at least five vertices, half of the length within a factor of 1.5 of the median
};
WallNoise wallNoise(const Polyline& line, double sigma);

}  // namespace ridgemap
