// SPDX-License-Identifier: BSD-3-Clause
#include "polylines.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

namespace ridgemap::test
{
SegmentIndex::SegmentIndex(const std::vector<Polyline>& lines, double cell) : cell_(cell)
{
	for (std::size_t i = 0; i < lines.size(); i++)
	{
		const std::vector<Point2>& p = lines[i].points;
		double arc = 0;
		for (std::size_t k = 1; k < p.size(); k++)
		{
			const bool open = !lines[i].closed;
			segments_.push_back({p[k - 1], p[k], i, arc, open && k == 1, open && k + 1 == p.size()});
			arc += std::hypot(p[k].x - p[k - 1].x, p[k].y - p[k - 1].y);
			forCells(p[k - 1], p[k], 0, [&](std::int64_t key) { cells_[key].push_back(segments_.size() - 1); });
		}
	}
}

double totalLength(const std::vector<Polyline>& lines)
{
	double sum = 0;
	for (const Polyline& line : lines) sum += line.length();
	return sum;
}

Accuracy measureAccuracy(const Oracle& oracle, const std::vector<Polyline>& ridges, const Options& options)
{
	Accuracy result;
	const double eps = options.effectiveEps() / options.sigma;
	forSamples(SegmentIndex(ridges, 4 * options.sigma), 0.1 * options.sigma,
			   [&](Point2 p, const SegmentIndex::Segment&, double)
			   {
				   const auto distance = oracle.distanceToRidge(oracle.toUnit(p), 1);
				   const double error = distance ? *distance / eps : 1 / eps;
				   result.samples++;
				   if (error > 1) result.beyondEps++;
				   if (error <= result.worst) return;
				   result.worst = error;
				   result.worstPlace = p;
			   });
	return result;
}

Coverage& Coverage::operator+=(const Coverage& o)
{
	projected += o.projected;
	withinEps += o.withinEps;
	withinSigma += o.withinSigma;
	return *this;
}

Coverage measureCoverage(const Oracle& oracle, const std::vector<Measurement>& measurements,
						 const std::vector<Polyline>& ridges, const Options& options)
{
	Coverage result;
	const SegmentIndex index(ridges, 4 * options.sigma);
	for (const Measurement& m : measurements)
	{
		const auto foot = oracle.project(oracle.toUnit({m.x, m.y}));
		if (!foot || foot->value < options.lTol) continue;
		const double distance = index.nearest(oracle.toMap(foot->p), 2 * options.sigma);
		result.projected++;
		result.withinEps += distance <= options.effectiveEps();
		result.withinSigma += distance <= options.sigma;
	}
	return result;
}

double duplicatedLength(const std::vector<Polyline>& lines, const Options& options)
{
	const double eps = options.effectiveEps(), step = 0.1 * options.sigma, parallel = std::cos(0.35);
	const double sameLine = std::max(6 * eps, 0.5 * options.sigma);
	const SegmentIndex index(lines, 4 * options.sigma);
	const auto direction = [](const SegmentIndex::Segment& s) { return unit({s.b.x - s.a.x, s.b.y - s.a.y}); };
	double sum = 0;
	forSamples(index, step,
			   [&](Point2 p, const SegmentIndex::Segment& own, double arc)
			   {
				   const double length = std::hypot(own.b.x - own.a.x, own.b.y - own.a.y);
				   const double share = length / std::max(1.0, std::ceil(length / step));
				   const double total = lines[own.line].closed ? lines[own.line].length() : 1e300;
				   const double other =
					   index.nearest(p, eps,
									 [&](const SegmentIndex::Segment& s, const SegmentFoot& foot)
									 {
										 if (std::abs(dot(direction(own), direction(s))) < parallel) return false;
										 if ((foot.t <= 0 && s.first) || (foot.t >= 1 && s.last)) return false;
										 const double apart =
											 std::abs(s.arc + foot.t * std::hypot(s.b.x - s.a.x, s.b.y - s.a.y) - arc);
										 return s.line != own.line || std::min(apart, total - apart) > sameLine;
									 });
				   if (other < eps) sum += share;
			   });
	return sum;
}

std::size_t danglingEnds(const std::vector<Polyline>& lines, double reach)
{
	const SegmentIndex index(lines, 2 * reach);
	std::size_t count = 0;
	for (std::size_t i = 0; i < lines.size(); i++)
		for (const bool atBack : {false, true})
		{
			if (lines[i].closed) continue;
			const double arc = atBack ? lines[i].length() : 0;
			const auto isOther = [&](const SegmentIndex::Segment& s, const SegmentFoot&) { return s.line != i; };
			const auto isElsewhere = [&](const SegmentIndex::Segment& s, const SegmentFoot& foot)
			{
				const double at = s.arc + foot.t * std::hypot(s.b.x - s.a.x, s.b.y - s.a.y);
				return s.line != i || std::abs(at - arc) > 2 * reach;
			};
			const Point2 end = atBack ? lines[i].points.back() : lines[i].points.front();
			const bool touches = index.nearest(end, reach, isElsewhere) <= 1e-9 * reach;
			count += !touches && index.nearest(end, reach, isOther) < reach;
		}
	return count;
}

namespace
{
bool sameBits(const Point2& a, const Point2& b)
{
	return std::memcmp(&a, &b, sizeof a) == 0;
}

bool sameRecord(const CellRecord& a, const CellRecord& b)
{
	return a.cx == b.cx && a.cy == b.cy && a.bin == b.bin && a.n == b.n && a.sx == b.sx && a.sy == b.sy &&
		   a.sxx == b.sxx && a.sxy == b.sxy && a.syy == b.syy;
}
}  // namespace

std::string firstDifference(const std::vector<Polyline>& a, const std::vector<Polyline>& b)
{
	std::ostringstream s;
	s.precision(17);
	for (std::size_t i = 0; i < std::min(a.size(), b.size()); i++)
	{
		const Polyline &p = a[i], &q = b[i];
		for (std::size_t k = 0; k < std::min(p.points.size(), q.points.size()); k++)
			if (!sameBits(p.points[k], q.points[k]))
			{
				s << "point " << k << " of polyline " << i << ": (" << p.points[k].x << ", " << p.points[k].y
				  << ") and (" << q.points[k].x << ", " << q.points[k].y << ")";
				return s.str();
			}
		if (!(p.info == q.info)) return "what is known of the vertices of polyline " + std::to_string(i);
		if (p.points.size() != q.points.size() || p.closed != q.closed || p.startReason != q.startReason ||
			p.endReason != q.endReason)
		{
			s << "polyline " << i << ": " << p.points.size() << " and " << q.points.size() << " points, ends '"
			  << toString(p.startReason) << "', '" << toString(p.endReason) << "' and '" << toString(q.startReason)
			  << "', '" << toString(q.endReason) << "'";
			return s.str();
		}
	}
	if (a.size() != b.size()) s << a.size() << " and " << b.size() << " polylines";
	return s.str();
}

std::string firstDifference(const std::vector<CellRecord>& a, const std::vector<CellRecord>& b)
{
	std::ostringstream s;
	for (std::size_t i = 0; i < std::min(a.size(), b.size()); i++)
		if (!sameRecord(a[i], b[i]))
		{
			s << "cell " << i << ": (" << a[i].cx << ", " << a[i].cy << ") n " << a[i].n << " and (" << b[i].cx << ", "
			  << b[i].cy << ") n " << b[i].n;
			return s.str();
		}
	if (a.size() != b.size()) s << a.size() << " and " << b.size() << " cells";
	return s.str();
}

}  // namespace ridgemap::test
