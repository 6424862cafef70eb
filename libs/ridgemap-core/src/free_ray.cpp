// SPDX-License-Identifier: BSD-3-Clause
#include "free_ray.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace ridgemap
{
namespace
{
std::int64_t rounded(double v)
{
	return std::int64_t(std::floor(v + 0.5));
}

[[noreturn]] void rejectRay(const FreeRay& r)
{
	std::ostringstream s;
	s << "ridge map: the ray from (" << r.sensorX << ", " << r.sensorY << ") to (" << r.x << ", " << r.y
	  << ") is not within +-" << maxCoordinate << " m; give NaN for a sensor whose position is not known";
	throw std::invalid_argument(s.str());
}
}  // namespace

std::optional<LatticeRay> makeRay(const Frame& frame, const FreeRay& ray, double margin)
{
	if (std::isnan(ray.sensorX) || std::isnan(ray.sensorY)) return std::nullopt;
	for (const double v : {ray.sensorX, ray.sensorY, ray.x, ray.y})
		if (!(std::abs(v) <= maxCoordinate)) rejectRay(ray);
	const double scale = double(LatticeRay::quantaPerSigma);
	const Vec2 s = frame.toLattice({ray.sensorX, ray.sensorY}), e = frame.toLattice({ray.x, ray.y});
	const Vec2 d = e - s;
	const double length = norm(d);
	const double counted = std::min(length - margin, maxRayLength);
	if (!(counted > 0)) return std::nullopt;
	const Vec2 last = s + (counted / length) * d;
	LatticeRay result;
	result.from = {rounded(s.x * scale), rounded(s.y * scale)};
	result.to = {rounded(last.x * scale), rounded(last.y * scale)};
	if (result.from.u == result.to.u && result.from.v == result.to.v) return std::nullopt;
	const double square = dot(d, d);
	result.a = std::int32_t(rounded(LatticeRay::directionScale * ((d.x * d.x - d.y * d.y) / square)));
	result.b = std::int32_t(rounded(LatticeRay::directionScale * (2 * d.x * d.y / square)));
	return result;
}

}  // namespace ridgemap
