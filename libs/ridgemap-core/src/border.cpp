// SPDX-License-Identifier: BSD-3-Clause
#include "border.h"

#include <algorithm>
#include <array>
#include <limits>

namespace ridgemap
{
namespace
{
constexpr double scanStep = 0.5;   ///< distance of samples along a border [sigma]
constexpr double goodAngle = 0.3;  ///< sine of the angle between ridge and border that is good enough
constexpr double nearMiss =
	0.1;  ///< a ridge that comes this close to a border without crossing it is too close [sigma]
constexpr double rootTolerance = 1e-6;   ///< [sigma]
constexpr double sameCrossing = 0.01;    ///< found from two sides, one crossing may come out this far apart [sigma]
constexpr double leastOccupancy = 0.25;  ///< of the next node, in L_tol, below which no ridge can be near
constexpr double jump = 1e-3;            ///< a crossing that is farther from the ridge than this is none [sigma]
constexpr int maxSplits = 5;
constexpr int patience = 2;  ///< steps after which a search for a crossing is given up where no ridge can be

/** Normals from which ridges are looked for in a sided field: every ridge has one of them within 45 degrees. */
constexpr std::array<Vec2, 4> sides = {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}};
constexpr double cosineOfSide = 0.9;  ///< a normal found from one side this close to another belongs to that, too

/** What the density says at one point for surfaces of all normals. */
struct AllSides
{
	std::size_t count = 0;                            ///< 0 where no ridge can be, 1 in a plain field
	std::array<RidgePoint, sides.size()> r;           ///< by side
	std::array<std::size_t, sides.size()> firstWith;  ///< the first side from which the same came out

	void look(const TileField& field, const Options& options, Vec2 p)
	{
		count = 0;
		if (field.nearestNode(p) < leastOccupancy * options.lTol) return;
		if (!field.isSided())
		{
			r[count] = evaluateRidge(field, p, {});
			firstWith[count++] = 0;
			return;
		}
		FieldPoint point(field, p);
		for (; count < sides.size(); count++)
		{
			const auto isKnown = [&](const RidgePoint& o)
			{ return o.occupancy > 0 && dot(o.v1, sides[count]) > cosineOfSide; };
			const std::size_t known = std::size_t(std::find_if(r.begin(), r.begin() + count, isKnown) - r.begin());
			r[count] = known < count ? r[known] : evaluateRidge(point, sides[count]);
			firstWith[count] = known < count ? firstWith[known] : count;
		}
	}
};

/** A sample on the border, with f and its derivative along the border. */
struct BorderSample
{
	double s = 0;  ///< arc length from the start of the segment
	RidgePoint r;
	double f = 0;
	double slope = 0;
};

/** Scan of one straight segment of a border for ridges. */
class SegmentScan
{
 public:
	SegmentScan(const TileField& field, const Options& options, Vec2 from, Vec2 to)
		: field_(field), options_(options), from_(from), to_(to), length_(norm(to - from)), direction_(unit(to - from))
	{
	}

	/** Finds the crossings; `s0` is the arc length of the border where the segment starts. */
	void run(double s0, std::vector<Crossing>& crossings)
	{
		const int n = std::max(1, int(std::ceil(length_ / scanStep)));
		AllSides samples[2];
		samples[0].look(field_, options_, at(0));
		for (int i = 1; i <= n; i++)
		{
			const double s = length_ * i / n;
			const AllSides& previous = samples[(i + 1) % 2];
			AllSides& next = samples[i % 2];
			next.look(field_, options_, at(s));
			for (std::size_t k = 0; k < std::min(previous.count, next.count); k++)
			{
				const std::size_t first = next.firstWith[k];
				if (first != k && previous.firstWith[k] == first) continue;  // the same interval
				if (isWorth(previous.r[k]) && isWorth(next.r[k]))
					interval(sample(length_ * (i - 1) / n, previous.r[k], nullptr), sample(s, next.r[k], nullptr), 0,
							 s0, crossings);
			}
		}
	}

	/** Least sine of an angle between ridge and border seen so far; 0 after a near miss. */
	double quality() const { return quality_; }

 private:
	bool isWorth(const RidgePoint& r) const { return r.occupancy >= 0.5 * options_.lTol; }
	/** Exact at the vertices, which borders share. */
	Vec2 at(double s) const { return s < length_ ? from_ + s * direction_ : to_; }

	BorderSample sample(double s, const RidgePoint& r, const BorderSample* like) const
	{
		BorderSample b;
		b.s = s;
		b.r = r;
		orient(b, like);
		return b;
	}
	BorderSample sampleAt(double s, const BorderSample& like) const
	{
		return sample(s, evaluateRidge(field_, at(s), like.r.v1), &like);
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
			const BorderSample middle = sampleAt(0.5 * (a.s + b.s), a);
			if (depth >= patience && isHopeless(a, middle, b)) return;
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
		const BorderSample middle = sampleAt(a.s + std::min(0.95, std::max(0.05, t)) * h, a);
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
			root = sampleAt(s, a);
			((root.f < 0) == (a.f < 0) ? a : b) = root;
			if (i >= patience && isHopeless(a, root, b)) return;
		}
		const RidgePoint& r = root.r;
		// In a sided field, f may also change its sign with a jump, where another normal takes over.
		if (!isRidgeLike(r, options_) || std::abs(r.f) > jump * norm(r.df)) return;
		const Vec2 tangent = r.tangent(r.v2);
		if (r.occupancy >= 0.9 * options_.lTol) quality_ = std::min(quality_, std::abs(cross(tangent, direction_)));
		if (r.occupancy >= options_.lTol && isSupported(field_, options_, r, tangent))
			crossings.push_back({r.p, tangent, r.v1, s0 + root.s});
	}

	/** None of three places close together is anything like a ridge: most changes of the sign of f lie beside ridges,
	 * where v1 turns, and would take many steps to find and to discard. */
	bool isHopeless(const BorderSample& a, const BorderSample& b, const BorderSample& c) const
	{
		return !isRidgeLike(a.r, options_, 2) && !isRidgeLike(b.r, options_, 2) && !isRidgeLike(c.r, options_, 2);
	}

	const TileField& field_;
	const Options& options_;
	Vec2 from_, to_;
	double length_;
	Vec2 direction_;
	double quality_ = 1;
};

/** Sorts the crossings from number `first` on along the border; those that were found from several sides are kept once.
 */
void keepDifferent(std::vector<Crossing>& crossings, std::size_t first)
{
	if (crossings.size() < first + 2) return;
	const auto begin = crossings.begin() + std::ptrdiff_t(first);
	std::stable_sort(begin, crossings.end(), [](const Crossing& a, const Crossing& b) { return a.s < b.s; });
	auto end = begin;  // of those that are kept
	for (auto it = begin; it != crossings.end(); ++it)
	{
		const Crossing c = *it;
		const auto isSame = [&](const Crossing& k)
		{
			const double distance = norm(k.p - c.p), cosine = dot(k.normal, c.normal);
			return (distance < sameCrossing && cosine > 0.7) || (distance < 4 * sameCrossing && cosine > 0.999);
		};
		if (std::none_of(begin, end, isSame)) *end++ = c;
	}
	crossings.erase(end, crossings.end());
}

/** Lays a border along the given vertices. Returns how transversal its worst crossing is. */
double scanPath(const TileField& field, const Options& options, const std::vector<Vec2>& path,
				std::vector<Crossing>& crossings)
{
	double quality = 1, s0 = 0;
	for (std::size_t i = 1; i < path.size(); i++)
	{
		const std::size_t known = crossings.size();
		SegmentScan scan(field, options, path[i - 1], path[i]);
		scan.run(s0, crossings);
		quality = std::min(quality, scan.quality());
		if (field.isSided()) keepDifferent(crossings, known);
		s0 += norm(path[i] - path[i - 1]);
	}
	return quality;
}
}  // namespace

bool isSupported(const TileField& field, const Options& options, const RidgePoint& r, Vec2 tangent)
{
	const double extent = CellGrid(options).halfExtent();
	bool ahead = false, behind = false;
	const auto completes = [&](Vec2 q, std::uint32_t bin)
	{
		const Vec2 d = q - r.p;
		const double along = dot(d, tangent), across = cross(tangent, d);
		if (std::abs(across) > supportWidth || std::abs(along) > options.dTol + extent || !field.sees(bin, r.v1))
			return false;
		ahead = ahead || along + extent >= 0;
		behind = behind || along - extent <= 0;
		return ahead && behind;
	};
	return field.anyCellNear(r.p, options.dTol + supportWidth, completes);
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
		AllSides sample;
		sample.look(field, options, q);
		for (std::size_t k = 0; k < sample.count; k++)
		{
			const RidgePoint& r = sample.r[k];
			const double slope = norm(r.df);
			if (r.occupancy >= 0.5 * options.lTol && slope > 0) clearance = std::min(clearance, std::abs(r.f) / slope);
		}
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
