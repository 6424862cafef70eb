// SPDX-License-Identifier: BSD-3-Clause
// Ends of walls. The kernels and the noise along the beams carry a ridge beyond the end of its surface and turn it
// aside there; the density along the wall tells where the surface ends: where it falls to half.
#include <cmath>

#include "wall_path.h"
#include "walls.h"

namespace ridgemap
{
namespace
{
// Lengths in units of se = sqrt(sigma^2 + s^2), the width of the density across the wall.
constexpr double leastLength = 7;                     ///< shorter lines are left as they are
constexpr double plateauFrom = 2.5, plateauTo = 4.5;  ///< stretch whose median density is that of the wall
constexpr double armFrom = 2.4, armTo = 6.4;          ///< stretch to which the line of the end is fitted
constexpr double largestRms = 0.12;                   ///< of a straight end about its line
constexpr double largestCut = 2.4;                    ///< farthest that an end is moved back
constexpr double redrawn = 1.5;  ///< length of the last stretch that is drawn along the fitted line
constexpr double guest = 4.5;    ///< ends that another line is led to, this near, are left as they are

/** A line seen from one of its ends. */
class EndView
{
 public:
	EndView(const Polyline& line, bool back) : line_(line), back_(back) {}
	std::size_t size() const { return line_.points.size(); }
	std::size_t index(std::size_t k) const { return back_ ? size() - 1 - k : k; }
	Vec2 point(std::size_t k) const { return {line_.points[index(k)].x, line_.points[index(k)].y}; }
	double occupancy(std::size_t k) const { return double(line_.info[index(k)].occupancy); }

 private:
	const Polyline& line_;
	bool back_;
};

/** Arc length from the end to where the density first exceeds half that of the wall; negative if it cannot be told. */
double halfDensity(const EndView& view, double se)
{
	std::vector<double> plateau;
	double s = 0;
	for (std::size_t k = 1; k < view.size() && s < plateauTo * se; k++)
	{
		s += norm(view.point(k) - view.point(k - 1));
		if (s > plateauFrom * se && s < plateauTo * se && view.occupancy(k) > 0) plateau.push_back(view.occupancy(k));
	}
	if (plateau.empty()) return -1;
	std::nth_element(plateau.begin(), plateau.begin() + std::ptrdiff_t(plateau.size() / 2), plateau.end());
	const double half = 0.5 * plateau[plateau.size() / 2];
	s = 0;
	for (std::size_t k = 0; k + 1 < view.size() && s < largestCut * se; k++)
	{
		const double a = view.occupancy(k), b = view.occupancy(k + 1), d = norm(view.point(k + 1) - view.point(k));
		if (a >= half) return s;
		if (b >= half) return std::min(largestCut * se, s + d * (half - a) / (b - a));
		s += d;
	}
	return largestCut * se;
}

/** Moves one end back to where the surface ends and draws the last stretch straight. */
void trimEnd(Polyline& line, bool back, double sigma)
{
	const double se = densityWidth(line, sigma);
	const Path path(line);
	if (path.length() < leastLength * se) return;
	const EndView view(line, back);
	const double cut = halfDensity(view, se);
	if (cut < 0) return;
	const double length = path.length();
	const double far = std::min(armTo * se, 0.8 * length);
	const FittedLine fit = back ? fitLine(path, length - far, length - armFrom * se, 0.25 * se)
								: fitLine(path, armFrom * se, far, 0.25 * se);
	if (fit.rms > largestRms * se) return;
	const Vec2 at = path.at(back ? length - cut : cut);
	const Vec2 end = fit.mean + dot(at - fit.mean, fit.direction) * fit.direction;
	std::size_t drop = 0;
	for (double s = 0; drop + 2 < view.size() && s < cut + redrawn * se; drop++)
		s += norm(view.point(drop + 1) - view.point(drop));
	if (drop > 0)
	{
		const auto from = back ? line.points.end() - std::ptrdiff_t(drop) : line.points.begin();
		const auto infoFrom = back ? line.info.end() - std::ptrdiff_t(drop) : line.info.begin();
		line.points.erase(from, from + std::ptrdiff_t(drop));
		line.info.erase(infoFrom, infoFrom + std::ptrdiff_t(drop));
	}
	line.points.insert(back ? line.points.end() : line.points.begin(), Point2{end.x, end.y});
	line.info.insert(back ? line.info.end() : line.info.begin(), madeVertex(VertexOrigin::end));
}
}  // namespace

double visitedRange(const Polyline& line, const Options& options)
{
	return guest * densityWidth(line, options.sigma);
}

Polyline trimEnds(const Polyline& line, bool front, bool back, const Options& options)
{
	Polyline result = line;
	if (front) trimEnd(result, false, options.sigma);
	if (back) trimEnd(result, true, options.sigma);
	return result;
}

}  // namespace ridgemap
