// SPDX-License-Identifier: BSD-3-Clause
#include "join_ends.h"

#include <algorithm>

#include "wall_path.h"

namespace ridgemap
{
namespace
{
constexpr double alwaysAttach =
	1.5;  ///< free ends this close to another line are joined whatever their direction [sigma]
constexpr double leastArc =
	3;  ///< parts of the same line nearer than this along the line are not "another line" [sigma]

Vec2 vec(const Point2& p)
{
	return {p.x, p.y};
}

/** An earlier round has led this end to another line: its last vertex lies on no ridge. */
bool isLed(const Polyline& line, bool back)
{
	return (back ? line.info.back() : line.info.front()).origin == VertexOrigin::junction;
}
}  // namespace

EndJoiner::EndJoiner(const Options& options)
	: sigma_(options.sigma), reach_(options.attachDistance * options.sigma), grid_(4 * options.sigma)
{
}

Lines EndJoiner::join(const Lines& lines)
{
	lines_ = lines;
	grid_.follow(lines_);
	targets_.assign(2 * lines_.size(), Target());
	for (int i = 0; i < int(lines_.size()); i++)
		for (const bool back : {false, true})
			if (!lines_[std::size_t(i)]->closed && !isLed(*lines_[std::size_t(i)], back))
				targets_[std::size_t(2 * i + back)] = target({i, back});

	Lines result;
	std::vector<char> used(lines_.size(), 0);
	// Open groups first from their own beginnings, then what is left: loops of bridged lines.
	for (int pass = 0; pass < 2; pass++)
		for (int i = 0; i < int(lines_.size()); i++)
		{
			if (used[std::size_t(i)]) continue;
			if (lines_[std::size_t(i)]->closed)
			{
				if (pass == 1) result.push_back(lines_[std::size_t(i)]);
				continue;
			}
			for (const bool back : {false, true})
				if (!used[std::size_t(i)] && (pass == 1 || !bridged({i, back})))
					result.push_back(group({i, back}, used));
		}
	memo_.forgetUnused();
	groups_.forgetUnused();
	return result;
}

const Point2& EndJoiner::place(LineEnd e) const
{
	const std::vector<Point2>& p = lines_[std::size_t(e.line)]->points;
	return e.back ? p.back() : p.front();
}

/** Unit direction in which a line leaves at its end, taken over the last 1.5 sigma. */
Vec2 EndJoiner::outward(LineEnd e) const
{
	const std::vector<Point2>& p = lines_[std::size_t(e.line)]->points;
	const Vec2 tip = vec(place(e));
	Vec2 d;
	for (std::size_t k = 1; k < p.size(); k++)
	{
		d = tip - vec(e.back ? p[p.size() - 1 - k] : p[k]);
		if (norm(d) > 1.5 * sigma_) break;
	}
	return unit(d);
}

EndJoiner::Target EndJoiner::target(LineEnd e)
{
	const std::vector<int> near = grid_.near(place(e), reach_);
	MemoKey key;
	key.add(lines_[std::size_t(e.line)]).add(e.back);
	for (const int line : near) key.add(lines_[std::size_t(line)]);
	Target t = memo_.get(std::move(key), [&] { return findTarget(e, near); });
	if (t.end.line >= 0) t.end.line = near[std::size_t(t.end.line)];
	return t;
}

EndJoiner::Target EndJoiner::findTarget(LineEnd e, const std::vector<int>& near) const
{
	Target best;
	best.distance = reach_;
	for (std::size_t i = 0; i < near.size(); i++)
	{
		const double before = best.distance;
		tryLine(e, near[i], best);
		if (best.distance < before && best.end.line >= 0) best.end.line = int(i);
	}
	return best;
}

/** Looks for a nearer place on a line. */
void EndJoiner::tryLine(LineEnd e, int line, Target& best) const
{
	const Vec2 tip = vec(place(e)), direction = outward(e);
	const Polyline& other = *lines_[std::size_t(line)];
	const std::vector<Point2>& p = other.points;
	const double whole = line == e.line ? other.length() : 0;
	double arc = 0;
	for (std::size_t k = 1; k < p.size(); k++)
	{
		const Vec2 a = vec(p[k - 1]), b = vec(p[k]);
		const double length = norm(b - a), before = arc;
		arc += length;
		const SegmentFoot foot = footOnSegment(a, b, tip);
		if (foot.distance >= best.distance) continue;
		if (line == e.line)
		{
			const double at = before + foot.t * length, away = e.back ? whole - at : at;
			if (away < std::max(leastArc * sigma_, 3 * foot.distance)) continue;
		}
		const Vec2 q = a + foot.t * (b - a);
		if (foot.distance > alwaysAttach * sigma_ && dot(q - tip, direction) < 0.5 * foot.distance) continue;
		best = {true, foot.distance, {q.x, q.y}, {}};
		if (other.closed) continue;
		if (k == 1 && foot.t <= 0) best = {true, foot.distance, p.front(), {line, false}};
		if (k + 1 == p.size() && foot.t >= 1) best = {true, foot.distance, p.back(), {line, true}};
	}
}

/** Two free ends that are each other's nearest place. */
bool EndJoiner::bridged(LineEnd e) const
{
	const Target& t = targetOf(e);
	return t.found && t.end.line >= 0 && targetOf(t.end).found && targetOf(t.end).end == e;
}

/** The line made by entering at `first` and crossing all bridges. */
LinePtr EndJoiner::group(LineEnd first, std::vector<char>& used)
{
	std::vector<LineEnd> entries;
	bool closed = false;
	for (LineEnd in = first;;)
	{
		used[std::size_t(in.line)] = 1;
		entries.push_back(in);
		const LineEnd out{in.line, !in.back};
		if (!bridged(out)) break;
		in = targetOf(out).end;
		closed = used[std::size_t(in.line)];
		if (closed) break;
	}
	const LineEnd last{entries.back().line, !entries.back().back};
	const Target &a = targetOf(first), &b = targetOf(last);
	if (entries.size() == 1 && !first.back && !a.found && !b.found) return lines_[std::size_t(first.line)];
	MemoKey key;
	key.add(closed);
	for (const Target* t : {&a, &b}) key.add(t->found).add(t->foot.x).add(t->foot.y);
	for (const LineEnd e : entries) key.add(lines_[std::size_t(e.line)]).add(e.back);
	return groups_.get(std::move(key), [&] { return std::make_shared<const Polyline>(assemble(entries, closed)); });
}

Polyline EndJoiner::assemble(const std::vector<LineEnd>& entries, bool closed) const
{
	Polyline result;
	const LineEnd first = entries.front(), last{entries.back().line, !entries.back().back};
	if (!closed) lead(first, result);
	for (const LineEnd in : entries)
	{
		const Polyline& line = *lines_[std::size_t(in.line)];
		for (std::size_t i = 0; i < line.points.size(); i++)
		{
			const std::size_t k = in.back ? line.points.size() - 1 - i : i;
			if (!result.points.empty() && result.points.back() == line.points[k]) continue;
			result.points.push_back(line.points[k]);
			result.info.push_back(line.info[k]);
		}
	}
	result.startReason = reasonAt(first);
	result.endReason = reasonAt(last);
	if (!closed)
	{
		lead(last, result);
		return result;
	}
	result.points.push_back(result.points.front());
	result.info.push_back(result.info.front());
	result.closed = true;
	result.startReason = result.endReason = StopReason::closedLoop;
	return result;
}

/** Adds the way from a free end to its foot on another line. */
void EndJoiner::lead(LineEnd e, Polyline& result) const
{
	const Target& t = targetOf(e);
	if (!t.found || t.foot == place(e)) return;
	result.points.push_back(t.foot);
	result.info.push_back(madeVertex(VertexOrigin::junction));
}

StopReason EndJoiner::reasonAt(LineEnd e) const
{
	if (targetOf(e).found) return StopReason::hitPolyline;
	const Polyline& line = *lines_[std::size_t(e.line)];
	return ridgemap::reasonAt(line, e.back);
}

}  // namespace ridgemap
