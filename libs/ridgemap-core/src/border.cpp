// SPDX-License-Identifier: BSD-3-Clause
#include "border.h"

#include <algorithm>
#include <limits>

namespace ridgemap
{
namespace
{
constexpr double scanStep = 0.5;   ///< distance of samples along a border [sigma]
constexpr double goodAngle = 0.3;  ///< sine of the angle between ridge and border that is good enough
constexpr double nearMiss =
	0.1;  ///< a ridge that comes this close to a border without crossing it is too close [sigma]
constexpr double rootTolerance = 1e-6;  ///< [sigma]
constexpr double sameCrossing = 0.01;   ///< found from two sides, one crossing may come out this far apart [sigma]
constexpr int maxSplits = 5;

/** Normals from which ridges are looked for in a sided field: every ridge has one of them within 45 degrees. */
constexpr Vec2 sides[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

/** Calls fn(normal) for all normals from which ridges must be looked for. */
template <class Fn>
void forEachSide(const TileField& field, Fn fn)
{
	for (const Vec2& side : sides)
	{
		fn(side);
		if (!field.isSided()) return;
	}
}

/** A sample on the border, with f and its derivative along the border. */
struct BorderSample
{
	double s = 0;  ///< arc length from the start of the segment
	RidgePoint r;
	double f = 0;
	double slope = 0;
};

/** Scan of one straight segment of a border for ridges seen from about one side. */
class SegmentScan
{
 public:
	SegmentScan(const TileField& field, const Options& options, Vec2 from, Vec2 to, Vec2 side)
		: field_(field),
		  options_(options),
		  from_(from),
		  to_(to),
		  side_(side),
		  length_(norm(to - from)),
		  direction_(unit(to - from))
	{
	}

	/** Finds the crossings; `s0` is the arc length of the border where the segment starts. */
	void run(double s0, std::vector<Crossing>& crossings)
	{
		const int n = std::max(1, int(std::ceil(length_ / scanStep)));
		BorderSample previous = sampleAt(0, nullptr);
		for (int i = 1; i <= n; i++)
		{
			const BorderSample next = sampleAt(length_ * i / n, nullptr);
			if (isWorth(previous) && isWorth(next)) interval(previous, next, 0, s0, crossings);
			previous = next;
		}
	}

	/** Least sine of an angle between ridge and border seen so far; 0 after a near miss. */
	double quality() const { return quality_; }

 private:
	bool isWorth(const BorderSample& b) const { return b.r.occupancy >= 0.5 * options_.lTol; }

	BorderSample sampleAt(double s, const BorderSample* like) const
	{
		BorderSample b;
		b.s = s;
		const Vec2 p = s < length_ ? from_ + s * direction_ : to_;  // exact at the vertices, which borders share
		b.r = evaluateRidge(field_, p, like ? like->r.v1 : side_);
		orient(b, like);
		return b;
	}

	/** Gives v1 of `b` the sense of that of `like`, where it has no sense of its own. */
	void orient(BorderSample& b, const BorderSample* like) const
	{
		if (like && !field_.isSided() && dot(b.r.v1, like->r.v1) < 0)
		{
			b.r.v1 = -b.r.v1;
			b.r.f = -b.r.f;
			b.r.df = -b.r.df;
		}
		b.f = b.r.f;
		b.slope = dot(b.r.df, direction_);
	}

	void interval(const BorderSample& a, BorderSample b, int depth, double s0, std::vector<Crossing>& crossings)
	{
		orient(b, &a);
		if (dot(a.r.v1, b.r.v1) < 0.8)
		{
			if (depth >= maxSplits) return;
			const BorderSample middle = sampleAt(0.5 * (a.s + b.s), &a);
			interval(a, middle, depth + 1, s0, crossings);
			interval(middle, b, depth + 1, s0, crossings);
			return;
		}
		if ((a.f < 0) != (b.f < 0))
			addRoot(a, b, s0, crossings);
		else if (depth < maxSplits && a.f * a.slope < 0 && b.f * b.slope > 0)
			doubleRoot(a, b, depth, s0, crossings);
	}

	/** f bends towards zero between a and b: look at its extremum. */
	void doubleRoot(const BorderSample& a, const BorderSample& b, int depth, double s0,
					std::vector<Crossing>& crossings)
	{
		const double h = b.s - a.s;
		const double t = a.slope / (a.slope - b.slope);
		// Cubic Hermite interpolation of f at the extremum that the slopes suggest.
		const double estimate = a.f * (1 + 2 * t) * (1 - t) * (1 - t) + b.f * t * t * (3 - 2 * t) +
								h * (a.slope * t * (1 - t) * (1 - t) - b.slope * t * t * (1 - t));
		const double scale = norm(a.r.df) + norm(b.r.df);
		if ((estimate < 0) == (a.f < 0) && std::abs(estimate) > nearMiss * scale) return;
		const BorderSample middle = sampleAt(a.s + std::min(0.95, std::max(0.05, t)) * h, &a);
		if ((middle.f < 0) != (a.f < 0))
		{
			interval(a, middle, maxSplits, s0, crossings);
			interval(middle, b, maxSplits, s0, crossings);
		}
		else if (std::abs(middle.f) < nearMiss * norm(middle.r.df))
		{
			if (isRidgeLike(middle.r, options_)) quality_ = 0;
			// The extremum may lie beside the guess, and the roots between.
			interval(a, middle, depth + 1, s0, crossings);
			interval(middle, b, depth + 1, s0, crossings);
		}
	}

	/** Safeguarded Newton method between samples of opposite sign. */
	void addRoot(BorderSample a, BorderSample b, double s0, std::vector<Crossing>& crossings)
	{
		BorderSample root = std::abs(a.f) < std::abs(b.f) ? a : b;
		for (int i = 0; i < 60 && b.s - a.s > rootTolerance; i++)
		{
			double s = root.s - root.f / root.slope;
			const bool newton = s > a.s && s < b.s;
			if (newton && std::abs(s - root.s) < rootTolerance) break;
			if (!newton || i % 8 == 7) s = 0.5 * (a.s + b.s);
			root = sampleAt(s, &a);
			((root.f < 0) == (a.f < 0) ? a : b) = root;
		}
		const RidgePoint& r = root.r;
		if (!isRidgeLike(r, options_)) return;
		const Vec2 tangent = r.tangent(r.v2);
		if (r.occupancy >= 0.9 * options_.lTol) quality_ = std::min(quality_, std::abs(cross(tangent, direction_)));
		if (r.occupancy >= options_.lTol && isSupported(field_, options_, r, tangent))
			crossings.push_back({r.p, tangent, r.v1, s0 + root.s});
	}

	const TileField& field_;
	const Options& options_;
	Vec2 from_, to_, side_;
	double length_;
	Vec2 direction_;
	double quality_ = 1;
};

/** Sorts crossings along the border; those that were found from several sides are kept once. */
void keepDifferent(std::vector<Crossing>& crossings)
{
	std::stable_sort(crossings.begin(), crossings.end(),
					 [](const Crossing& a, const Crossing& b) { return a.s < b.s; });
	std::vector<Crossing> kept;
	for (const Crossing& c : crossings)
	{
		const auto isSame = [&](const Crossing& k)
		{ return norm(k.p - c.p) < sameCrossing && dot(k.normal, c.normal) > 0.7; };
		if (std::none_of(kept.begin(), kept.end(), isSame)) kept.push_back(c);
	}
	crossings = std::move(kept);
}

/** Lays a border along the given vertices. Returns how transversal its worst crossing is. */
double scanPath(const TileField& field, const Options& options, const std::vector<Vec2>& path,
				std::vector<Crossing>& crossings)
{
	double quality = 1, s0 = 0;
	for (std::size_t i = 1; i < path.size(); i++)
	{
		std::vector<Crossing> found;
		forEachSide(field,
					[&](Vec2 side)
					{
						SegmentScan scan(field, options, path[i - 1], path[i], side);
						scan.run(s0, found);
						quality = std::min(quality, scan.quality());
					});
		if (field.isSided()) keepDifferent(found);
		crossings.insert(crossings.end(), found.begin(), found.end());
		s0 += norm(path[i] - path[i - 1]);
	}
	return quality;
}
}  // namespace

bool isSupported(const TileField& field, const Options& options, const RidgePoint& r, Vec2 tangent)
{
	const double extent = CellGrid(options).halfExtent();
	bool ahead = false, behind = false;
	field.forEachCellNear(r.p, options.dTol + supportWidth,
						  [&](Vec2 q, std::uint32_t bin)
						  {
							  if (!field.sees(bin, r.v1)) return;
							  const Vec2 d = q - r.p;
							  const double along = dot(d, tangent), across = cross(tangent, d);
							  if (std::abs(across) > supportWidth || std::abs(along) > options.dTol + extent) return;
							  ahead = ahead || along + extent >= 0;
							  behind = behind || along - extent <= 0;
						  });
	return ahead && behind;
}

Vec2 placeCorner(const TileField& field, const Options& options)
{
	constexpr Vec2 candidates[] = {{0, 0}, {0.75, 0.375}, {-0.75, -0.375}, {-0.375, 0.75}, {0.375, -0.75}};
	constexpr double enough = 0.25;
	if (field.empty()) return {};
	Vec2 best;
	double bestClearance = -1;
	for (const Vec2& q : candidates)
	{
		double clearance = std::numeric_limits<double>::infinity();
		forEachSide(field,
					[&](Vec2 side)
					{
						const RidgePoint r = evaluateRidge(field, q, side);
						const double slope = norm(r.df);
						if (r.occupancy >= 0.5 * options.lTol && slope > 0)
							clearance = std::min(clearance, std::abs(r.f) / slope);
					});
		if (clearance >= enough) return q;
		if (clearance > bestClearance)
		{
			bestClearance = clearance;
			best = q;
		}
	}
	return best;
}

Edge layEdge(const TileField& field, Vec2 from, Vec2 to, const Options& options)
{
	Edge best;
	best.path = {from, to};
	if (field.empty()) return best;
	double bestQuality = scanPath(field, options, best.path, best.crossings);
	if (bestQuality >= goodAngle) return best;
	const Vec2 along = to - from, across = leftNormal(unit(along));
	// Detours: a tent to either side, a trapezoid to either side.
	for (const double height : {1.75, -1.75, 1.25, -1.25})
	{
		Edge detour;
		if (std::abs(height) > 1.5)
			detour.path = {from, from + 0.5 * along + height * across, to};
		else
			detour.path = {from, from + 0.2 * along + height * across, from + 0.8 * along + height * across, to};
		const double quality = scanPath(field, options, detour.path, detour.crossings);
		if (quality > bestQuality)
		{
			bestQuality = quality;
			best = std::move(detour);
		}
		if (bestQuality >= goodAngle) break;
	}
	return best;
}

}  // namespace ridgemap
