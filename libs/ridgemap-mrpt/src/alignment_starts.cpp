// SPDX-License-Identifier: BSD-3-Clause
// Alignments from starts that may be wrong.
#include <algorithm>
#include <cmath>

#include "point_to_line_solver.h"

namespace ridgemap
{
namespace
{
constexpr double degree = 3.14159265358979323846 / 180;
/** As many points decide between alignments, and between poses that are only looked at. */
constexpr std::size_t pointsToCompare = 120, pointsToSearch = 60;
/** Scale and reach of the score of poses that are only looked at: as far as they are apart [m]. */
constexpr double searchScale = 0.2, searchReach = 0.5;
/** So many of them become starts, with this gate [m]. */
constexpr std::size_t mostSearched = 4;
constexpr double searchGate = 0.5;
/** Poses along the weakest direction are so far apart [m]. */
constexpr double slideStep = 0.05;

/** Every so many-th point that at most `most` remain. */
std::vector<Point2> thinned(const std::vector<Point2>& points, std::size_t most)
{
	const std::size_t step = std::max<std::size_t>(1, (points.size() + most - 1) / most);
	std::vector<Point2> few;
	for (std::size_t i = 0; i < points.size(); i += step) few.push_back(points[i]);
	return few;
}

/** The same solution, found from two starts. */
bool agree(const PlanarPose& a, const PlanarPose& b)
{
	constexpr double distance = 0.02, angle = 0.005;
	return std::hypot(a.x - b.x, a.y - b.y) < distance && std::abs(a.phi - b.phi) < angle;
}

/** With a smaller distance, and the angle by the same share. */
MatchingGate narrowed(MatchingGate gate, double distance)
{
	if (!(gate.distance > distance)) return gate;
	gate.angular *= distance / gate.distance;
	gate.distance = distance;
	return gate;
}

/** The best alignment so far, and what the next ones are made with. */
class Starts
{
 public:
	Starts(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& given,
		   const TMatchingOptions& options)
		: targets_(targets), points_(points), few_(thinned(points, pointsToCompare)), given_(given), options_(options)
	{
	}

	const Alignment& best() const { return best_; }
	/** Whether the best one fits so well that no other is looked for. */
	bool fits() const { return best_.score >= options_.startShare * double(few_.size()); }

	/** The start that others have to beat. */
	void tryFirst(const MatchingGate& gate) { best_ = aligned(given_, gate, fit_); }

	/** Counts if it ranks higher by yawMargin. Returns what was found. */
	PlanarPose tryFrom(const PlanarPose& start, const MatchingGate& gate)
	{
		Fit fit;
		const Alignment next = aligned(start, gate, fit);
		// A tie goes to the start that comes first: odometry is right more often than not.
		if (rank(next) > rank(best_) * (1 + options_.yawMargin)) take(next, fit);
		return next.pose;
	}

	void turn(const MatchingGate& gate);
	void search(const MatchingGate& gate);
	void slide(const MatchingGate& gate);

 private:
	struct Place
	{
		PlanarPose pose;
		double score = 0;
	};

	Alignment aligned(const PlanarPose& start, const MatchingGate& gate, Fit& fit) const
	{
		Alignment a = alignNarrowing(targets_, few_, start, gate, options_);
		fit = Fit(targets_, few_, a.pose, options_.matchSides);
		a.score = fit.score;
		return a;
	}
	void take(const Alignment& next, const Fit& fit)
	{
		best_ = next;
		fit_ = fit;
	}
	/** The score, and the farther from the start given, the less. Points that the map does not explain fit somewhere
	 * else by chance, so the more of them there are, the more odometry says beside the score; few of them say nothing.
	 */
	double rank(const Alignment& a) const
	{
		const double off = std::hypot(a.pose.x - given_.x, a.pose.y - given_.y) / options_.startSpread;
		const double unexplained = 1 - a.score / double(few_.size());
		return a.score * std::pow(1 + off * off, -options_.startPower * unexplained * unexplained);
	}
	std::vector<Place> placesAround() const;
	/** From a place that odometry does not speak for: counts if it fits better by that share. */
	bool tryElsewhere(const PlanarPose& start, const MatchingGate& gate, double margin)
	{
		Fit fit;
		const Alignment next = aligned(start, gate, fit);
		if (!(fit.relativeTo(fit_) > 1 + margin)) return false;
		take(next, fit);
		return true;
	}
	bool slideOneWay(const PlanarPose& from, const Point2& step, const MatchingGate& gate);

	const MatchingTargets& targets_;
	const std::vector<Point2>& points_;
	std::vector<Point2> few_;
	PlanarPose given_;
	const TMatchingOptions& options_;
	Alignment best_;
	Fit fit_;
};

void Starts::turn(const MatchingGate& gate)
{
	for (int turn = 1; turn <= int(options_.yawStarts); turn++)
		for (const int sign : {1, -1})
			tryFrom({given_.x, given_.y, given_.phi + sign * turn * options_.yawStep * degree}, gate);
}

/** Turned and shifted poses with their scores, best first. */
std::vector<Starts::Place> Starts::placesAround() const
{
	const auto fewer = thinned(points_, pointsToSearch);
	const int turns = 2 * int(options_.yawStarts), shifts = int(options_.shiftStarts);
	std::vector<Place> places;
	std::vector<Point2> turned(fewer.size());
	for (int turn = -turns; turn <= turns; turn++)
	{
		const double phi = given_.phi + turn * 0.5 * options_.yawStep * degree;
		const PlanarPose rotation{0, 0, phi};
		std::transform(fewer.begin(), fewer.end(), turned.begin(), [&](const Point2& p) { return rotation * p; });
		for (int i = -shifts; i <= shifts; i++)
			for (int j = -shifts; j <= shifts; j++)
			{
				Place place{{given_.x + i * options_.shiftStep, given_.y + j * options_.shiftStep, phi}};
				for (const Point2& p : turned)
					if (const auto target = targets_.nearest({p.x + place.pose.x, p.y + place.pose.y}, searchReach))
						place.score += 1 / (1 + target->distanceSqr / (searchScale * searchScale));
				places.push_back(place);
			}
	}
	std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.score > b.score; });
	return places;
}

/** From the best of the turned and shifted poses, no two of them neighbours. */
void Starts::search(const MatchingGate& gate)
{
	const double apart = 1.5 * options_.shiftStep, turned = 0.75 * options_.yawStep * degree;
	std::vector<PlanarPose> tried;
	for (const Place& place : placesAround())
	{
		const PlanarPose& p = place.pose;
		if (std::any_of(tried.begin(), tried.end(),
						[&](const PlanarPose& t)
						{ return std::hypot(t.x - p.x, t.y - p.y) < apart && std::abs(t.phi - p.phi) < turned; }))
			continue;
		tried.push_back(p);
		tryElsewhere(p, narrowed(gate, searchGate), options_.yawMargin);
		if (tried.size() == mostSearched) return;
	}
}

/** From the best place in steps from a pose. Returns whether that is better. */
bool Starts::slideOneWay(const PlanarPose& from, const Point2& step, const MatchingGate& gate)
{
	const auto at = [&](int k) { return PlanarPose{from.x + k * step.x, from.y + k * step.y, from.phi}; };
	const Fit here(targets_, few_, from, options_.matchSides);
	const auto score = [&](int k) { return Fit(targets_, few_, at(k), options_.matchSides).relativeTo(here); };
	int top = 0;
	double topScore = 0, before = 1, now = score(1);
	for (int k = 1; k < int(options_.slideReach / slideStep); k++)
	{
		const double next = score(k + 1);
		if (now > before && now >= next && now > topScore)
		{
			top = k;
			topScore = now;
		}
		before = now;
		now = next;
	}
	return top > 0 && tryElsewhere(at(top), gate, options_.slideMargin);
}

/** Along a hallway, doors and corners decide, and each has its own minimum. */
void Starts::slide(const MatchingGate& gate)
{
	constexpr int rounds = 2;
	for (int round = 0; round < rounds; round++)
	{
		const PlanarPose from = best_.pose;
		const Point2 u = weakestDirection(targets_, few_, from, gate, 3 * options_.robustLeast, options_.matchSides);
		const bool forwards = slideOneWay(from, {slideStep * u.x, slideStep * u.y}, gate);
		const bool backwards = slideOneWay(from, {-slideStep * u.x, -slideStep * u.y}, gate);
		if (!forwards && !backwards) return;
	}
}
}  // namespace

Alignment alignFromSeveralStarts(const MatchingTargets& targets, const std::vector<Point2>& points,
								 const PlanarPose& start, const MatchingGate& gate, const TMatchingOptions& options)
{
	constexpr double enough = 1e-6;
	const MatchingGate near = narrowed(gate, options.nearGate);
	Starts starts(targets, points, start, options);
	starts.tryFirst(near);
	const PlanarPose first = starts.best().pose;
	const bool sure = agree(first, starts.tryFrom(start, gate)) && starts.fits();
	if (!sure && gate.distance >= options.yawLeastGate)
	{
		starts.turn(gate);
		if (options.shiftStarts > 0 && !starts.fits()) starts.search(gate);
	}
	if (options.slideReach > 0) starts.slide(near);
	Alignment result = descend(targets, points, starts.best().pose, gate, options.robustLeast, enough, options);
	result.score = starts.best().score;
	return result;
}

}  // namespace ridgemap
