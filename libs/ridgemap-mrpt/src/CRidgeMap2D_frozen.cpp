// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/simplify.h>

#include <stdexcept>

#include "frozen_polylines.h"
#include "map_state.h"

namespace ridgemap
{
CRidgeMap2D CRidgeMap2D::fromPolylines(const std::vector<Polyline>& lines, const MapOptions& options)
{
	CRidgeMap2D map(options);
	map.state_->frozen = std::make_shared<const std::vector<Polyline>>(toFrozen(lines));
	return map;
}

void CRidgeMap2D::freeze(double tolerance)
{
	auto frozen = std::make_shared<const std::vector<Polyline>>(toFrozen(simplified(tolerance)));
	auto state = std::make_shared<MapState>(options());
	state->frozen = std::move(frozen);
	state_ = std::move(state);
}

bool CRidgeMap2D::isFrozen() const
{
	return state_->frozen != nullptr;
}

bool CRidgeMap2D::isEmpty() const
{
	return isFrozen() ? state_->frozen->empty() : core().empty();
}

const std::vector<Polyline>& CRidgeMap2D::ridges() const
{
	return isFrozen() ? *state_->frozen : core().ridges();
}

const std::vector<Polyline>& CRidgeMap2D::walls() const
{
	return isFrozen() ? *state_->frozen : core().walls();
}

Box2 CRidgeMap2D::box() const
{
	if (!isFrozen()) return core().boundingBox();
	Box2 box;
	for (const Polyline& line : *state_->frozen)
		for (const Point2& p : line.points) box.extend(p);
	return box;
}

void CRidgeMap2D::throwIfFrozen(const char* change) const
{
	if (isFrozen())
		throw std::logic_error(
			std::string(change) +
			": this ridge map is frozen, it holds polylines without the measurements they came from; "
			"use the map that it was made of, or clear() to start a new one");
}

}  // namespace ridgemap
