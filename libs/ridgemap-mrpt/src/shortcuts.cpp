// SPDX-License-Identifier: BSD-3-Clause
#include "shortcuts.h"

#include <algorithm>
#include <cmath>

namespace ridgemap
{
namespace
{
Point2 operator-(const Point2& a, const Point2& b)
{
	return {a.x - b.x, a.y - b.y};
}

double cross(const Point2& a, const Point2& b)
{
	return a.x * b.y - a.y * b.x;
}

/** Directions of the rays from a point that pass within the tolerance of all points seen so far. */
class Wedge
{
 public:
	explicit Wedge(double tolerance) : tolerance_(tolerance) {}

	bool holds(const Point2& direction) const
	{
		if (empty_) return false;
		return !bounded_ || (cross(right_, direction) >= 0 && cross(direction, left_) >= 0);
	}

	bool empty() const { return empty_; }

	/** Only the rays within the tolerance of the point at v remain. */
	void narrow(const Point2& v)
	{
		const double reach = v.x * v.x + v.y * v.y - tolerance_ * tolerance_;
		if (empty_ || reach <= 0) return;
		const double h = std::sqrt(reach);
		Wedge other(tolerance_);
		other.bounded_ = true;
		other.left_ = {h * v.x - tolerance_ * v.y, h * v.y + tolerance_ * v.x};
		other.right_ = {h * v.x + tolerance_ * v.y, h * v.y - tolerance_ * v.x};
		*this = bounded_ ? common(*this, other) : other;
	}

 private:
	double tolerance_;
	bool bounded_ = false, empty_ = false;
	Point2 left_, right_;  ///< bounds, less than half a turn apart

	static Wedge common(const Wedge& a, const Wedge& b)
	{
		Wedge w = a;
		w.empty_ = !(a.holds(b.right_) || b.holds(a.right_)) || !(a.holds(b.left_) || b.holds(a.left_));
		w.right_ = a.holds(b.right_) ? b.right_ : a.right_;
		w.left_ = a.holds(b.left_) ? b.left_ : a.left_;
		return w;
	}
};

/** The vertices j after i whose ray from i passes within the tolerance of all vertices between. A segment is within the
 * tolerance of a point where the rays from both of its ends are (Chan and Chin, 1996). */
template <class At>
std::vector<std::size_t> raysFrom(std::size_t i, std::size_t end, const At& at, double tolerance)
{
	std::vector<std::size_t> reached;
	Wedge wedge(tolerance);
	for (std::size_t j = i + 1; j < end && !wedge.empty(); j++)
	{
		const Point2 v = at(j) - at(i);
		if (j == i + 1 || ((v.x != 0 || v.y != 0) && wedge.holds(v))) reached.push_back(j);
		wedge.narrow(v);
	}
	return reached;
}
}  // namespace

std::vector<std::vector<std::size_t>> shortcuts(const std::vector<Point2>& chain, double tolerance, std::size_t reach)
{
	const std::size_t n = chain.size();
	// What rounding adds stays below the tolerance.
	const double t = tolerance * (1 - 1e-9);
	const auto endOf = [&](std::size_t i) { return std::min(n, i + 1 + reach); };
	const auto forward = [&](std::size_t i) { return chain[i]; };
	const auto backward = [&](std::size_t i) { return chain[n - 1 - i]; };
	std::vector<std::vector<std::size_t>> fromTheEnd(n);  // i ascending, for each j
	for (std::size_t r = n; r-- > 0;)
		for (const std::size_t b : raysFrom(r, endOf(r), backward, t)) fromTheEnd[n - 1 - b].push_back(n - 1 - r);
	std::vector<std::vector<std::size_t>> all(n);
	for (std::size_t i = 0; i < n; i++)
	{
		const auto ahead = raysFrom(i, endOf(i), forward, t);
		std::set_intersection(ahead.begin(), ahead.end(), fromTheEnd[i].begin(), fromTheEnd[i].end(),
							  std::back_inserter(all[i]));
	}
	return all;
}

DeviationSums::DeviationSums(const std::vector<Point2>& chain)
{
	before_.emplace_back();
	for (const Point2& p : chain)
	{
		const Point2 q = p - chain.front();
		chain_.push_back(q);
		Sums s = before_.back();
		s.x += q.x;
		s.y += q.y;
		s.xx += q.x * q.x;
		s.xy += q.x * q.y;
		s.yy += q.y * q.y;
		before_.push_back(s);
	}
}

double DeviationSums::between(std::size_t i, std::size_t j) const
{
	const Point2 a = chain_[i], d = chain_[j] - a;
	const double n = double(j - i - 1), lengthSqr = d.x * d.x + d.y * d.y;
	if (n <= 0 || lengthSqr == 0) return 0;
	const Sums &l = before_[i + 1], &h = before_[j];
	const double x = h.x - l.x, y = h.y - l.y;
	const double xx = h.xx - l.xx - 2 * a.x * x + n * a.x * a.x;
	const double xy = h.xy - l.xy - a.x * y - a.y * x + n * a.x * a.y;
	const double yy = h.yy - l.yy - 2 * a.y * y + n * a.y * a.y;
	return std::max(0.0, (d.y * d.y * xx - 2 * d.x * d.y * xy + d.x * d.x * yy) / lengthSqr);
}

}  // namespace ridgemap
