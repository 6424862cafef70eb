// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "evaluation.h"

namespace ridgemap::apps
{
namespace
{
/** c0 + c1 t + c2 t^2, the squared distance to a true point or line at the share t of the way. */
struct Quadratic
{
	double c0, c1, c2;
	double at(double t) const { return c0 + t * (c1 + t * c2); }
	/** Integral from t to u, in powers of (u - t) to keep small results exact. */
	double integral(double t, double u) const
	{
		const double h = u - t, slope = c1 + 2 * c2 * t;
		return h * (at(t) + h * (0.5 * slope + h * c2 / 3));
	}
};

/** The three stretches of the squared distance to one segment: before its start, beside it, behind its end. */
struct Stretches
{
	double from, to;  ///< where the foot lies inside of the segment; from > to if nowhere
	bool rising;      ///< the foot moves from a to b
	Quadratic toA, toLine, toB;

	const Quadratic& at(double t) const
	{
		if (t < from) return rising ? toA : toB;
		if (t > to) return rising ? toB : toA;
		return toLine;
	}
};

Quadratic toPoint(const Segment& s, const Point2& p)
{
	const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y, ax = s.a.x - p.x, ay = s.a.y - p.y;
	return {ax * ax + ay * ay, 2 * (ax * dx + ay * dy), dx * dx + dy * dy};
}

Stretches stretches(const Segment& s, const Segment& truth)
{
	const double inf = std::numeric_limits<double>::infinity(), length = truth.length();
	Stretches r{-inf, inf, true, toPoint(s, truth.a), {0, 0, 0}, toPoint(s, truth.b)};
	if (!(length > 0)) return r.toLine = r.toA, r;
	const double ux = (truth.b.x - truth.a.x) / length, uy = (truth.b.y - truth.a.y) / length;
	const double ax = s.a.x - truth.a.x, ay = s.a.y - truth.a.y, dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
	const double beside = ax * uy - ay * ux, drift = dx * uy - dy * ux;
	r.toLine = {beside * beside, 2 * beside * drift, drift * drift};
	const double along = ax * ux + ay * uy, slope = dx * ux + dy * uy;
	if (std::abs(slope) <= 1e-15 * length)
	{
		if (along < 0) r.toLine = r.toA;
		if (along > length) r.toLine = r.toB;
		return r;
	}
	r.rising = slope > 0;
	const double atA = -along / slope, atB = (length - along) / slope;
	r.from = std::min(atA, atB);
	r.to = std::max(atA, atB);
	return r;
}

/** Appends the places within (from, to) where p and q are equal. */
void addMeetings(const Quadratic& p, const Quadratic& q, double from, double to, std::vector<double>& places)
{
	const double a = q.c2 - p.c2, b = q.c1 - p.c1, c = q.c0 - p.c0;
	const double discriminant = b * b - 4 * a * c;
	if (discriminant < 0) return;
	const double w = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
	if (a != 0 && w / a > from && w / a < to) places.push_back(w / a);
	if (w != 0 && c / w > from && c / w < to) places.push_back(c / w);
}

/** Adds the lower envelope of the quadratics over [from, to]. */
void addEnvelope(const std::vector<Quadratic>& quadratics, double from, double to, double length, DistanceSum& sum)
{
	std::vector<double> cuts{from, to};
	for (std::size_t i = 0; i < quadratics.size(); i++)
		for (std::size_t j = 0; j < i; j++) addMeetings(quadratics[i], quadratics[j], from, to, cuts);
	std::sort(cuts.begin(), cuts.end());
	for (std::size_t i = 1; i < cuts.size(); i++)
	{
		const double t = cuts[i - 1], u = cuts[i], middle = 0.5 * (t + u);
		const Quadratic& lowest =
			*std::min_element(quadratics.begin(), quadratics.end(),
							  [middle](const Quadratic& a, const Quadratic& b) { return a.at(middle) < b.at(middle); });
		sum.squareIntegral += length * std::max(0.0, lowest.integral(t, u));
		// A quadratic that opens upwards is greatest at an end.
		for (const double at : {t, u}) sum.maximum = std::max(sum.maximum, std::sqrt(std::max(0.0, lowest.at(at))));
	}
}

}  // namespace

DistanceSum& DistanceSum::operator+=(const DistanceSum& o)
{
	length += o.length;
	squareIntegral += o.squareIntegral;
	maximum = std::max(maximum, o.maximum);
	return *this;
}

DistanceSum integrateDistance(const Point2& a, const Point2& b, const std::vector<Segment>& truth)
{
	const Segment s{a, b};
	DistanceSum sum;
	sum.length = s.length();
	if (!(sum.length > 0)) return sum;
	// What is farther from the middle than the nearest by more than the length can be nearest nowhere.
	const Point2 middle = s.at(0.5);
	double nearest = std::numeric_limits<double>::infinity();
	for (const Segment& t : truth) nearest = std::min(nearest, t.distance(middle));
	std::vector<Stretches> candidates;
	std::vector<double> cuts{0, 1};
	for (const Segment& t : truth)
	{
		if (t.distance(middle) > nearest + sum.length * (1 + 1e-9)) continue;
		candidates.push_back(stretches(s, t));
		for (const double cut : {candidates.back().from, candidates.back().to})
			if (cut > 0 && cut < 1) cuts.push_back(cut);
	}
	std::sort(cuts.begin(), cuts.end());
	std::vector<Quadratic> quadratics;
	for (std::size_t i = 1; i < cuts.size(); i++)
	{
		if (!(cuts[i] > cuts[i - 1])) continue;
		quadratics.clear();
		for (const Stretches& c : candidates) quadratics.push_back(c.at(0.5 * (cuts[i - 1] + cuts[i])));
		addEnvelope(quadratics, cuts[i - 1], cuts[i], sum.length, sum);
	}
	return sum;
}

}  // namespace ridgemap::apps
