// SPDX-License-Identifier: BSD-3-Clause
#include "expected_corner.h"

#include <algorithm>
#include <cmath>

#include "true_ridge.h"

namespace ridgemap::apps
{
namespace
{
/** A function of one coordinate with its first two derivatives. */
struct Jet
{
	double value, first, second;
};

/** Kernel and noise together are a normal density of this standard deviation. */
struct Smoothing
{
	double spread;

	/** Across a wall: the density itself. */
	Jet across(double u) const
	{
		const double v = spread * spread, g = std::exp(-0.5 * u * u / v) / (spread * std::sqrt(2 * M_PI));
		return {g, -u / v * g, (u * u / v - 1) / v * g};
	}
	/** Along a wall from 0 to `arm`: its integral. */
	Jet along(double u, double arm) const
	{
		const Jet start = across(u), end = across(u - arm);
		const auto integral = [this](double x) { return 0.5 * std::erfc(-x / (spread * std::sqrt(2.0))); };
		return {integral(u) - integral(u - arm), start.value - end.value, start.first - end.first};
	}
};

OccupancySample expectedOccupancy(const Smoothing& s, double arm, const Point2& p)
{
	const Jet ax = s.along(p.x, arm), cx = s.across(p.x), ay = s.along(p.y, arm), cy = s.across(p.y);
	OccupancySample o;
	o.value = ax.value * cy.value + cx.value * ay.value;
	o.gx = ax.first * cy.value + cx.first * ay.value;
	o.gy = ax.value * cy.first + cx.value * ay.first;
	o.hxx = ax.second * cy.value + cx.second * ay.value;
	o.hxy = ax.first * cy.first + cx.first * ay.first;
	o.hyy = ax.value * cy.second + cx.value * ay.second;
	return o;
}
}  // namespace

Polyline expectedCornerRidge(double sigma, double noise, double arm, double reach)
{
	const Smoothing s{std::hypot(sigma, noise)};
	// <grad L, v1>, with v1 turned to the inside of the corner, changes its sign on the ridge.
	const auto criterion = [&](double x, double y)
	{
		const OccupancySample o = expectedOccupancy(s, arm, {x, y});
		const Point2 v = ridgeFunction(o).v1;
		return (o.gx * v.x + o.gy * v.y) * (v.x + v.y < 0 ? -1 : 1);
	};
	// On the lines at 45 degrees, from the diagonal along the wall on x; the other half is its mirror image.
	std::vector<Point2> half;
	const double step = s.spread / 50;
	double y = 0.5 * s.spread;
	for (double ahead = 0; ahead + y < reach; ahead += step)
	{
		double low = y - step, high = y + step;
		while (criterion(low + ahead, low) < 0) low -= step;
		while (criterion(high + ahead, high) > 0) high += step;
		for (int i = 0; i < 60; i++)
		{
			const double middle = 0.5 * (low + high);
			(criterion(middle + ahead, middle) > 0 ? low : high) = middle;
		}
		y = 0.5 * (low + high);
		half.push_back({y + ahead, y});
	}
	Polyline ridge;
	for (auto p = half.rbegin(); p != half.rend(); ++p) ridge.points.push_back({p->y, p->x});
	ridge.points.insert(ridge.points.end(), half.begin() + 1, half.end());
	return ridge;
}

}  // namespace ridgemap::apps
