// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/point_to_line_matching.h>

#include <algorithm>
#include <cmath>

#include "point_to_line_solver.h"

namespace ridgemap
{
namespace
{
constexpr double smallestStep = 1e-6;

std::vector<Point2> loneMeasurements(const std::vector<Polyline>& polylines, const std::vector<Point2>& measurements,
									 const TargetSettings& settings)
{
	std::vector<Point2> lone;
	if (settings.loneDistance < 0) return lone;
	const PolylineIndex lines(polylines, settings.spacing);
	for (const auto& p : measurements)
		if (!lines.hasWithin(p, settings.loneDistance)) lone.push_back(p);
	return lone;
}
}  // namespace

MatchingTargets::MatchingTargets(const std::vector<Polyline>& polylines, const std::vector<Point2>& measurements,
								 const TargetSettings& settings)
	: settings_(settings), index_(polylines, settings.spacing, loneMeasurements(polylines, measurements, settings))
{
}

Point2 MatchingTargets::normal(const Foot& target) const
{
	const Point2 u = index_.direction(target.segment);
	return {-u.y, u.x};
}

Point2 PlanarPose::operator*(const Point2& p) const
{
	const double c = std::cos(phi), s = std::sin(phi);
	return {x + c * p.x - s * p.y, y + s * p.x + c * p.y};
}

double MatchingGate::at(const Point2& p) const
{
	const double turned = angular > 0 ? angular * std::hypot(p.x - pivot.x, p.y - pivot.y) : 0;
	return std::min(distance + turned, greatest);
}

Alignment alignToLines(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& start,
					   const MatchingGate& gate, const TMatchingOptions& options)
{
	const double scale = std::max(options.robustLeast, options.robustShare * gate.distance);
	return descend(targets, points, start, gate, scale, smallestStep, options);
}

Alignment alignNarrowing(const MatchingTargets& targets, const std::vector<Point2>& points, const PlanarPose& start,
						 MatchingGate gate, const TMatchingOptions& options)
{
	constexpr double narrower = 0.5, enough = 0.05;
	Alignment result;
	result.pose = start;
	unsigned steps = 0;
	gate.distance = std::min(gate.distance, gate.greatest);
	for (bool last = false; !last; gate.distance *= narrower, gate.angular *= narrower)
	{
		const double scale = std::max(options.robustLeast, options.robustShare * gate.distance);
		last = !(options.robustShare * gate.distance * narrower >= options.robustLeast);
		result = descend(targets, points, result.pose, gate, scale, enough * scale, options);
		steps += result.steps;
	}
	result.steps = steps;
	return result;
}

bool AlignmentMemory::goesOn(const PlanarPose& start, double gate) const
{
	constexpr double rounding = 1e-4;  // MRPT keeps pairs in single precision
	const std::lock_guard<std::mutex> lock(mutex_);
	return gate <= gate_ && std::abs(start.x - end_.x) < rounding && std::abs(start.y - end_.y) < rounding &&
		   std::abs(std::remainder(start.phi - end_.phi, 6.283185307179586)) < rounding;
}

void AlignmentMemory::remember(const PlanarPose& end, double gate)
{
	const std::lock_guard<std::mutex> lock(mutex_);
	end_ = end;
	gate_ = gate;
}

}  // namespace ridgemap
