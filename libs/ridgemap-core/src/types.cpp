// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/types.h>

#include <algorithm>
#include <cmath>

namespace ridgemap
{
void Box2::extend(const Point2& p)
{
	min.x = std::min(min.x, p.x);
	min.y = std::min(min.y, p.y);
	max.x = std::max(max.x, p.x);
	max.y = std::max(max.y, p.y);
}

void Box2::extend(const Box2& b)
{
	if (b.empty()) return;
	extend(b.min);
	extend(b.max);
}

double Polyline::length() const
{
	double sum = 0;
	for (std::size_t i = 1; i < points.size(); i++)
		sum += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
	return sum;
}

const char* toString(StopReason reason)
{
	switch (reason)
	{
		case StopReason::crossing:
			return "crossing";
		case StopReason::closedLoop:
			return "closed loop";
		case StopReason::belowThreshold:
			return "below L_tol";
		case StopReason::noMeasurement:
			return "no measurement within d_tol";
		case StopReason::notARidge:
			return "not a ridge";
		case StopReason::hitPolyline:
			return "hit a polyline";
		case StopReason::unregisteredExit:
			return "unregistered exit";
		case StopReason::noConvergence:
			return "no convergence";
		case StopReason::workLimit:
			return "work limit";
		case StopReason::passedThrough:
			return "rays passed through";
		case StopReason::count_:
			break;
	}
	return "unknown";
}

}  // namespace ridgemap
