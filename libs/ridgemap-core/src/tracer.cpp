// SPDX-License-Identifier: BSD-3-Clause
#include "tracer.h"

#include <ridgemap/standard_error.h>

#include <algorithm>
#include <initializer_list>
#include <limits>

#include "border.h"
#include "exp_series.h"

namespace ridgemap
{
namespace
{
constexpr double shortSegment = 0.5;   ///< shorter segments mark a strong bend: trust the tangents less there [sigma]
constexpr double longSegment = 1;      ///< longer segments can hide an S [sigma]
constexpr double acceptedShare = 0.7;  ///< share of eps that the estimated error of a segment may use
constexpr int maxNodes = 4000;
constexpr int maxRelaxations = 12;
constexpr int newtonOnly = 4;  ///< relaxations before the secant takes part

/** Deviation of the cubic Hermite curve from its chord of length h, for end slopes m0 and m1. */
double hermite(double h, double m0, double m1, double t)
{
	return h * (m0 * t * (1 - t) * (1 - t) - m1 * t * t * (1 - t));
}
}  // namespace

/** Where a walk stands. */
struct RidgeTracer::State
{
	RidgePoint point;
	Vec2 tangent;          ///< unit, in the direction of the walk
	double curvature = 0;  ///< of the last segment, positive to the left [1/sigma]
	double walked = 0;     ///< arc length so far [sigma]
	RidgePoint start;
	Vec2 startTangent;
};

RidgeTracer::RidgeTracer(const TileField& field, TileBorder& border, const Options& options,
						 const std::vector<Piece>& pieces)
	: field_(field), border_(border), options_(options), pieces_(pieces), eps_(options.effectiveEps() / options.sigma)
{
	tolerance_ = std::max(1e-5, std::min(1e-3, 0.05 * eps_));
	leastStep_ = std::min(0.02, eps_);
}

RidgeNode RidgeTracer::node(const RidgePoint& r) const
{
	RidgeNode n{r.p, r.v1, {}};
	n.info.occupancy = float(r.occupancy);
	n.info.curvature = float(-r.lambda1 / r.occupancy);
	n.info.standardError = float(ridgeUncertainty(n.info, options_.sigma).standardError);
	return n;
}

RidgeTracer::Walk RidgeTracer::walk(const RidgePoint& start, Vec2 direction) const
{
	Walk walk;
	walk.nodes = {node(start)};
	State state;
	state.point = state.start = start;
	state.tangent = state.startTangent = start.tangent(direction);
	double h = std::min(options_.maxStep, 1.0);
	double ahead = std::numeric_limits<double>::infinity();  // where the ridge is known to end
	StopReason reason = StopReason::workLimit;
	while (walk.nodes.size() < maxNodes)
	{
		const Proposal step = propose(state, h);
		if (!step.next.converged || step.exits)
		{
			reason = step.exits ? StopReason::unregisteredExit : step.next.reason;
			if (reason == StopReason::belowThreshold) ahead = h;
			h *= 0.5;
			if (h >= leastStep_) continue;
			if (step.exits) reason = exitReason(state, step.exit);
			break;
		}
		const RidgePoint& next = step.next.point;
		const Vec2 tangent = next.tangent(next.p - state.point.p);
		const Verdict verdict = verify(state.point, state.tangent, next, tangent);
		if (!verdict.accepted && h > leastStep_ && options_.stepRule == StepRule::error)
		{
			h = std::max(leastStep_, h * std::max(0.25, std::min(0.7, std::sqrt(0.5 * eps_ / verdict.error))));
			continue;
		}
		if (!verdict.accepted && !std::isfinite(verdict.error))
		{
			reason = StopReason::notARidge;
			h *= 0.5;
			if (h < leastStep_) break;
			continue;
		}
		if (!step.port && onPolyline(next.p, tangent, next.v1))
		{
			reason = StopReason::hitPolyline;
			break;
		}
		if (closesLoop(state, next))
		{
			walk.nodes.push_back(node(state.start));
			walk.closed = true;
			reason = StopReason::closedLoop;
			break;
		}
		if (options_.stepRule == StepRule::paper && step.next.distance > 0.75)
			insertMiddleNode(state.point, next, walk.nodes);
		walk.nodes.push_back(node(next));
		if (step.port)
		{
			walk.end.side = step.port->side;
			walk.end.crossing = step.port->index;
			reason = StopReason::crossing;
			break;
		}
		const double length = norm(next.p - state.point.p);
		state.curvature = length > 0 ? cross(state.tangent, tangent) / length : 0;
		state.point = next;
		state.tangent = tangent;
		state.walked += length;
		reason = StopReason::workLimit;
		if (!measurementNear(next, tangent))
		{
			reason = StopReason::noMeasurement;
			break;
		}
		ahead -= length;
		if (ahead < leastStep_)
		{
			reason = StopReason::belowThreshold;
			break;
		}
		h = std::min({nextStep(h, step.next, verdict), options_.maxStep, std::max(leastStep_, 0.6 * ahead)});
	}
	walk.end.reason = reason;
	return walk;
}

RidgeTracer::Proposal RidgeTracer::propose(const State& state, double h) const
{
	Proposal proposal;
	Vec2 x;
	if (options_.stepRule == StepRule::paper)
		x = state.point.p + (dot(state.point.v2, state.tangent) < 0 ? -h : h) * state.point.v2;  // section V-B1
	else
	{
		const double bend = std::max(-0.5, std::min(0.5, 0.5 * h * state.curvature));
		x = state.point.p + h * (state.tangent + bend * leftNormal(state.tangent));
	}
	if (!border_.contains(x))
	{
		finishAtBorder(state, h, x, proposal);
		return proposal;
	}
	proposal.next = relax(x, leftNormal(unit(x - state.point.p)), state.point.v1, std::max(0.5, 0.75 * h));
	if (proposal.next.converged && !border_.contains(proposal.next.point.p))
		finishAtBorder(state, h, proposal.next.point.p, proposal);
	return proposal;
}

/** The step leaves the tile: end it at the crossing that is there, if there is one. */
void RidgeTracer::finishAtBorder(const State& state, double h, Vec2 outside, Proposal& proposal) const
{
	proposal.exits = true;
	const auto exit = border_.exit(state.point.p, outside);
	if (!exit) return;
	proposal.exit = exit->p;
	TileBorder::Port* port = border_.match(*exit, state.tangent, sideOf(state.point), 0.3 + 0.3 * h);
	if (!port) return;
	proposal.exits = false;
	proposal.port = port;
	proposal.next.point = evaluate(port->crossing.p, port->crossing.normal);
	proposal.next.converged = true;
}

/** Why a ridge that leaves the tile at p has no crossing there. */
StopReason RidgeTracer::exitReason(const State& state, Vec2 p) const
{
	for (const double beyond : {0.0, leastStep_})  // it may also end right behind
	{
		const Relaxed there =
			relax(p + beyond * state.tangent, leftNormal(state.tangent), state.point.v1, shortSegment);
		if (!there.converged) return there.reason;
		if (!isSupported(field_, options_, there.point, state.tangent)) return StopReason::noMeasurement;
	}
	return StopReason::unregisteredExit;
}

RidgeTracer::Relaxed RidgeTracer::relax(Vec2 x, Vec2 normal, Vec2 v1, double reach) const
{
	Relaxed result;
	double moved = 0, movedBefore = 0, fBefore = 0;
	for (int i = 0; i < maxRelaxations; i++)
	{
		const Vec2 p = x + moved * normal;
		if (!field_.inDomain(p)) return result;
		const RidgePoint r = evaluate(p, v1);
		const double orientation = dot(r.v1, normal);
		// Only a way through places that determine a ridge can be expected to lead to one.
		if (!isRidgeLike(r, options_) || std::abs(dot(r.v1, v1)) <= 0.5) result.reason = StopReason::notARidge;
		if (r.occupancy < 0.3 * options_.lTol)
		{
			result.reason = StopReason::belowThreshold;
			return result;
		}
		if (r.lambda1 >= 0 || std::abs(orientation) < 0.3)
		{
			result.reason = StopReason::notARidge;
			return result;
		}
		// f and its derivative along the normal; where the exact derivative points the wrong way or leads far away,
		// lambda1 leads uphill.
		double slope = dot(r.df, normal);
		const double uphill = r.lambda1 * orientation, share = slope / uphill;
		if (share < 0.05 && !(share > 0 && std::abs(r.f) < 0.05 * std::abs(slope))) slope = uphill;
		// Where the derivative changes quickly, as between two sides, Newton's method may go round in circles.
		const double secant = (r.f - fBefore) / (moved - movedBefore);
		if (i >= newtonOnly && secant * uphill > 0) slope = secant;
		const double step = std::max(-0.5, std::min(0.5, -r.f / slope));
		if (std::abs(r.f) < tolerance_ * std::min(norm(r.df), std::abs(slope)))
		{
			result.point = r;
			result.distance = std::abs(moved);
			result.reason = r.occupancy < options_.lTol ? StopReason::belowThreshold : StopReason::notARidge;
			result.converged =
				r.occupancy >= options_.lTol && isRidgeLike(r, options_) && std::abs(dot(r.v1, v1)) > 0.5;
			return result;
		}
		movedBefore = moved;
		fBefore = r.f;
		moved += step;
		if (std::abs(moved) > reach)
		{
			// No ridge goes on here, as beside an umbilic point that turns it away.
			result.reason = StopReason::notARidge;
			return result;
		}
	}
	return result;
}

/** Estimates the distance between the segment a-b and the ridge: from the end tangents (cubic Hermite), then from f at
 * the middle, and densely where the two disagree or the ridge bends strongly. An S hides from the middle: a long
 * segment that is not nearly straight is looked at on both sides of it, too. An infinite error means that the ridge
 * does not follow. */
RidgeTracer::Verdict RidgeTracer::verify(const RidgePoint& a, Vec2 tangentA, const RidgePoint& b, Vec2 tangentB) const
{
	const Vec2 chord = b.p - a.p;
	const double h = norm(chord);
	if (h < leastStep_) return {true, 0};
	const Vec2 along = (1 / h) * chord, normal = leftNormal(along);
	const double ca = dot(tangentA, along), cb = dot(tangentB, along);
	const double none = std::numeric_limits<double>::infinity();
	if (ca < 0.3 || cb < 0.3) return {false, none};
	const double limit = acceptedShare * eps_;
	const double m0 = dot(tangentA, normal) / ca, m1 = dot(tangentB, normal) / cb;
	const auto guess = [&](double t) { return hermite(h, m0, m1, t); };
	double error = std::max({std::abs(guess(0.25)), std::abs(guess(0.5)), std::abs(guess(0.75))});
	if (error > limit) return {false, error};
	const auto offset = [&](double t)
	{
		const RidgePoint r = evaluate(a.p + t * chord, a.v1);
		if (!isRidgeLike(r, options_) || std::abs(dot(r.v1, normal)) < 0.6) return none;
		return r.newtonStep(normal);
	};
	const double middle = offset(0.5);
	error = std::max(error, std::abs(middle));
	const double surprise = std::abs(middle - guess(0.5));
	const auto lookAt = [&](std::initializer_list<double> places)
	{
		for (const double t : places)
			if (error <= limit) error = std::max(error, std::abs(offset(t)));
	};
	const bool plain = h < shortSegment ? surprise <= 0.02 * eps_ && error <= 0.25 * limit : surprise <= 0.2 * eps_;
	if (error <= limit && !plain)
		lookAt({0.25, 0.75, 0.1, 0.9, 0.375, 0.625});
	else if (error <= limit && h > longSegment && error > 0.5 * limit)
		lookAt({0.25, 0.75});
	else
		error = std::max(error, std::abs(middle) + 0.5 * surprise);
	return {error <= limit, error};
}

void RidgeTracer::insertMiddleNode(const RidgePoint& a, const RidgePoint& b, std::vector<RidgeNode>& nodes) const
{
	const Relaxed middle = relax(0.5 * (a.p + b.p), leftNormal(unit(b.p - a.p)), a.v1, 1);
	if (middle.converged && border_.contains(middle.point.p)) nodes.push_back(node(middle.point));
}

double RidgeTracer::nextStep(double h, const Relaxed& relaxed, const Verdict& verdict) const
{
	if (options_.stepRule == StepRule::paper)  // section V-B3
		return relaxed.distance > 0.75 ? 0.5 * h : relaxed.distance < 0.25 ? 2 * h : h;
	const double aim = 0.6 * acceptedShare * eps_;
	const double factor = std::sqrt(aim / std::max(verdict.error, 0.05 * aim));
	return std::max(leastStep_, h * std::max(0.5, std::min(2.0, factor)));
}

bool RidgeTracer::closesLoop(const State& state, const RidgePoint& next) const
{
	if (state.walked < 2 || state.walked < 2 * norm(next.p - state.point.p)) return false;
	const SegmentFoot foot = footOnSegment(state.point.p, next.p, state.start.p);
	return foot.distance < eps_ && foot.t > 0 && dot(state.startTangent, state.tangent) > 0.7 &&
		   foot.t * norm(next.p - state.point.p) > 1e-6;
}

bool RidgeTracer::onPolyline(Vec2 p, Vec2 direction, Vec2 normal) const
{
	const auto otherSide = [&](const RidgeNode& n) { return field_.isSided() && dot(n.normal, normal) < 0; };
	for (const Piece& piece : pieces_)
		for (std::size_t i = 1; i < piece.nodes.size(); i++)
		{
			const Vec2 a = piece.nodes[i - 1].p, b = piece.nodes[i].p;
			if (otherSide(piece.nodes[i])) continue;
			if (footOnSegment(a, b, p).distance < 1.5 * eps_ && std::abs(dot(unit(b - a), direction)) > 0.8)
				return true;
		}
	return false;
}

bool RidgeTracer::measurementNear(const RidgePoint& r, Vec2 tangent) const
{
	// L >= L_tol needs a kernel within d_tol unless very many lie farther away.
	if (field_.weightNear(r.p, options_.cutoff) * expMinusSeries(0.5 * options_.dTol * options_.dTol) < options_.lTol)
		return true;
	const double reach = options_.dTol + CellGrid(options_).halfExtent();
	const auto isNear = [&](Vec2 q, std::uint32_t bin)
	{
		const Vec2 d = q - r.p;
		return std::abs(dot(d, tangent)) <= reach && std::abs(cross(tangent, d)) <= supportWidth &&
			   field_.sees(bin, r.v1);
	};
	return field_.anyCellNear(r.p, options_.dTol + supportWidth, isNear);
}

void RidgeTracer::trimToMeasurements(Walk& walk) const
{
	// The last stretch, as arc length back from the end.
	const double window = options_.dTol + 1;
	std::size_t first = walk.nodes.size() - 1;
	double length = 0;
	while (first > 0 && length < window)
	{
		length += norm(walk.nodes[first].p - walk.nodes[first - 1].p);
		first--;
	}
	double back = length;
	const double extent = CellGrid(options_).halfExtent();
	const Vec2 tip = walk.nodes.back().p;
	const Vec2 side = walk.nodes.back().normal;
	const auto visit = [&](Vec2 q, std::uint32_t bin)
	{
		// The way back along the ridge to the foot of q is no shorter than the straight one.
		const double reach = back + extent + supportWidth;
		if (back <= 0 || dot(q - tip, q - tip) > reach * reach || !field_.sees(bin, side)) return;
		double behind = 0, bestBehind = length, best = supportWidth;
		for (std::size_t i = walk.nodes.size() - 1; i > first && behind < back + extent; i--)
		{
			const SegmentFoot foot = footOnSegment(walk.nodes[i].p, walk.nodes[i - 1].p, q);
			const double segment = norm(walk.nodes[i].p - walk.nodes[i - 1].p);
			if (foot.distance < best)
			{
				best = foot.distance;
				bestBehind = behind + foot.t * segment;
			}
			behind += segment;
		}
		back = std::min(back, std::max(0.0, bestBehind - extent));
	};
	field_.forEachCellNear(tip, length + supportWidth, visit);
	if (back <= 0) return;
	if (walk.end.reason == StopReason::unregisteredExit) walk.end.reason = StopReason::noMeasurement;
	while (walk.nodes.size() > 1)
	{
		const RidgeNode b = walk.nodes.back();
		walk.nodes.pop_back();
		const Vec2 a = walk.nodes.back().p;
		const double segment = norm(b.p - a);
		if (segment <= back)
		{
			back -= segment;
			continue;
		}
		const Vec2 cut = b.p + (back / segment) * (a - b.p);
		Vec2 normal = leftNormal((1 / segment) * (b.p - a));
		if (dot(normal, b.normal) < 0) normal = -normal;
		const Relaxed end = relax(cut, normal, normal, eps_);
		const bool usable = end.converged && border_.contains(end.point.p);
		walk.nodes.push_back(usable ? node(end.point) : RidgeNode{cut, b.normal, b.info});
		return;
	}
}

}  // namespace ridgemap
