// SPDX-License-Identifier: BSD-3-Clause
#include "free_ray.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace ridgemap
{
namespace
{
/** floor(v + 0.5), without the call that floor() needs on processors before SSE 4.1. */
std::int64_t rounded(double v)
{
	const std::int64_t i = std::int64_t(v + 0.5);
	return i - (double(i) > v + 0.5);
}

[[noreturn]] void rejectRay(const FreeRay& r)
{
	std::ostringstream s;
	s << "ridge map: the ray from (" << r.sensorX << ", " << r.sensorY << ") to (" << r.x << ", " << r.y
	  << ") is not within +-" << maxCoordinate << " m; give NaN for a sensor whose position is not known";
	throw std::invalid_argument(s.str());
}
}  // namespace

RayWalk::RayWalk(const LatticeRay& ray)
{
	LatticePoint from = ray.from, to = ray.to;
	steep_ = std::abs(to.u - from.u) < std::abs(to.v - from.v);
	if (steep_)
	{
		std::swap(from.u, from.v);
		std::swap(to.u, to.v);
	}
	if (to.u < from.u) std::swap(from, to);
	u0_ = from.u;
	u1_ = to.u;
	row0_ = from.v >> cellBits;
	v0_ = (from.v & (LatticeRay::quantaPerCell - 1)) << fractionBits;
	slope_ = floorDiv((to.v - from.v) * (std::int64_t(1) << fractionBits), to.u - from.u);
}

std::int64_t RayWalk::columnLeavingFor(std::int64_t row) const
{
	// The least way along the longer axis after which the ray is in that row.
	const std::int64_t border = ((slope_ < 0 ? row + 1 : row) - row0_) * (std::int64_t(1) << rowBits) - v0_;
	const std::int64_t way = slope_ < 0 ? -border / -slope_ + 1 : (border + slope_ - 1) / slope_;
	return ((u0_ + way + LatticeRay::quantaPerCell - 1) >> cellBits) - 1;
}

std::optional<LatticeRay> RayMaker::make(const FreeRay& ray)
{
	const auto outside = [](double v) { return !(std::abs(v) <= maxCoordinate); };
	constexpr double scale = double(LatticeRay::quantaPerSigma);
	if (!sensor_ || !(ray.sensorX == sensorX_ && ray.sensorY == sensorY_))
	{
		if (std::isnan(ray.sensorX) || std::isnan(ray.sensorY)) return std::nullopt;
		if (outside(ray.sensorX) || outside(ray.sensorY)) rejectRay(ray);
		sensorX_ = ray.sensorX;
		sensorY_ = ray.sensorY;
		sensor_ = frame_.toLattice({sensorX_, sensorY_});
		from_ = {rounded(sensor_->x * scale), rounded(sensor_->y * scale)};
	}
	if (outside(ray.x) || outside(ray.y)) rejectRay(ray);
	const Vec2 d = frame_.toLattice({ray.x, ray.y}) - *sensor_;
	const double length = norm(d);
	const double counted = std::min(length - margin_, maxRayLength);
	if (!(counted > 0)) return std::nullopt;
	const Vec2 last = *sensor_ + (counted / length) * d;
	LatticeRay result;
	result.from = from_;
	result.to = {rounded(last.x * scale), rounded(last.y * scale)};
	if (result.from.u == result.to.u && result.from.v == result.to.v) return std::nullopt;
	const double square = dot(d, d);
	result.a = std::int32_t(rounded(LatticeRay::directionScale * ((d.x * d.x - d.y * d.y) / square)));
	result.b = std::int32_t(rounded(LatticeRay::directionScale * (2 * d.x * d.y / square)));
	return result;
}

}  // namespace ridgemap
