// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/format.h>
#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/simplify.h>

#include <cmath>
#include <limits>
#include <utility>

#include "map_state.h"

namespace ridgemap
{
CRidgeMap2D::CRidgeMap2D() : CRidgeMap2D(Options()) {}

CRidgeMap2D::CRidgeMap2D(const Options& options) : state_(std::make_shared<MapState>(options)) {}

CRidgeMap2D::CRidgeMap2D(const MapOptions& options) : CRidgeMap2D(options.creation)
{
	setMapOptions(options);
}

CRidgeMap2D::~CRidgeMap2D() = default;

CRidgeMap2D::CRidgeMap2D(const CRidgeMap2D& o)
	: mrpt::maps::CMetricMap(),
	  insertionOptions(o.insertionOptions),
	  likelihoodOptions(o.likelihoodOptions),
	  renderOptions(o.renderOptions),
	  matchingOptions(o.matchingOptions),
	  state_(o.state_)
{
	genericMapParams = o.genericMapParams;
}

CRidgeMap2D& CRidgeMap2D::operator=(const CRidgeMap2D& o)
{
	CRidgeMap2D copy(o);
	swap(copy);
	return *this;
}

CRidgeMap2D::CRidgeMap2D(CRidgeMap2D&& o) : CRidgeMap2D(o.mapOptions())
{
	genericMapParams = o.genericMapParams;
	swap(o);
}

CRidgeMap2D& CRidgeMap2D::operator=(CRidgeMap2D&& o)
{
	if (this == &o) return *this;
	CRidgeMap2D taken(std::move(o));
	swap(taken);
	return *this;
}

void CRidgeMap2D::swap(CRidgeMap2D& o)
{
	std::swap(genericMapParams, o.genericMapParams);
	std::swap(insertionOptions, o.insertionOptions);
	std::swap(likelihoodOptions, o.likelihoodOptions);
	std::swap(renderOptions, o.renderOptions);
	std::swap(matchingOptions, o.matchingOptions);
	std::swap(state_, o.state_);
}

void CRidgeMap2D::internal_clear()
{
	MapState& state = own(state_);
	state.core.clear();
	state.frozen.reset();
	state.window.clear();
	state.cache.reset();
}

const RidgeMap& CRidgeMap2D::core() const
{
	return state_->core;
}

std::string CRidgeMap2D::asString() const
{
	if (isFrozen())
		return mrpt::format("Frozen ridge map of %zu polylines, sigma %g m", walls().size(), options().sigma);
	const MapStatistics s = core().statistics();
	return mrpt::format("Ridge map of %llu measurements in %zu lattice cells, sigma %g m",
						static_cast<unsigned long long>(s.measurements), s.cells, options().sigma);
}

UpdateResult CRidgeMap2D::update(unsigned threads)
{
	return own(state_).core.update(threads);
}

void CRidgeMap2D::setThreads(unsigned threads)
{
	own(state_).core.setThreads(threads);
}

std::shared_ptr<const PolylineIndex> CRidgeMap2D::wallIndex() const
{
	return state_->cache.walls([this] { return std::make_shared<const PolylineIndex>(walls(), options().sigma); });
}

std::shared_ptr<const PolylineIndex> CRidgeMap2D::ridgeIndex() const
{
	return state_->cache.ridges([this] { return std::make_shared<const PolylineIndex>(ridges(), options().sigma); });
}

std::vector<Polyline> CRidgeMap2D::simplified(double tolerance) const
{
	return ridgemap::simplified(walls(), tolerance);
}

std::optional<NearestPoint> CRidgeMap2D::nearestWallPoint(const Point2& query, double maxDistance) const
{
	return wallIndex()->nearest(query, maxDistance);
}

std::optional<NearestPoint> CRidgeMap2D::nearestRidgePoint(const Point2& query, double maxDistance) const
{
	return ridgeIndex()->nearest(query, maxDistance);
}

std::shared_ptr<const MatchingTargets> CRidgeMap2D::matchingTargets() const
{
	const TMatchingOptions& o = matchingOptions;
	const double sigma = options().sigma;
	const TargetSettings settings{o.matchTarget, o.pointSpacing * sigma, o.fallback ? o.fallbackDistance * sigma : -1};
	return state_->cache.targets(settings,
								 [&]
								 {
									 const auto& polylines =
										 o.matchTarget == LikelihoodTarget::walls ? walls() : ridges();
									 const auto lone = o.fallback ? core().cellCentroids() : std::vector<Point2>();
									 return std::make_shared<const MatchingTargets>(polylines, lone, settings);
								 });
}

const mrpt::maps::CSimplePointsMap* CRidgeMap2D::getAsSimplePointsMap() const
{
	const auto targets = matchingTargets();
	return state_->cache
		.points(targets,
				[&]
				{
					auto map = std::make_shared<mrpt::maps::CSimplePointsMap>();
					map->reserve(targets->points().size());
					for (const Point2& p : targets->points()) map->insertPointFast(float(p.x), float(p.y), 0);
					map->mark_as_modified();
					return map;
				})
		.get();
}

mrpt::math::TBoundingBoxf CRidgeMap2D::boundingBox() const
{
	const Box2 exact = box();
	if (exact.empty()) return {{0, 0, 0}, {0, 0, 0}};
	// Rounded outwards, for single precision must not cut off a measurement.
	constexpr float infinite = std::numeric_limits<float>::infinity();
	const auto low = [](double v) { return float(v) > v ? std::nextafter(float(v), -infinite) : float(v); };
	const auto high = [](double v) { return float(v) < v ? std::nextafter(float(v), infinite) : float(v); };
	return {{low(exact.min.x), low(exact.min.y), 0}, {high(exact.max.x), high(exact.max.y), 0}};
}

}  // namespace ridgemap
