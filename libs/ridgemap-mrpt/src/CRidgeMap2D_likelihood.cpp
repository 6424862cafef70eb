// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>
#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/observation_to_measurements.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "map_state.h"

namespace ridgemap
{
namespace
{
/** Density of the end of one beam; its logarithm is finite whatever the options. */
class BeamModel
{
 public:
	BeamModel(const TLikelihoodOptions& o, double lTol)
		: random_(o.zRand / o.zMax),
		  hit_(o.zHit),
		  perVariance_(-0.5 / (o.sigmaHit * o.sigmaHit)),
		  farthestSqr_(o.maxDistance * o.maxDistance),
		  lTol_(lTol)
	{
	}

	/** By its distance from the nearest polyline. */
	double byDistance(double distanceSqr) const
	{
		return mixture(std::exp(perVariance_ * std::min(distanceSqr, farthestSqr_)));
	}
	/** By the continuous occupancy there [kernels]. */
	double byOccupancy(double occupancy) const { return mixture(occupancy / (occupancy + lTol_)); }
	/** Of a beam without return, by the share of rays that pass on its way. */
	double byPassingShare(double share) const { return mixture(share); }
	/** Far from all surfaces. */
	double far(bool occupancy) const { return occupancy ? byOccupancy(0) : byDistance(farthestSqr_); }

 private:
	double mixture(double hit) const
	{
		constexpr double least = 1e-150;
		const double density = random_ + hit_ * hit;
		return density >= least ? std::min(density, 1 / least) : least;
	}

	double random_, hit_, perVariance_, farthestSqr_, lTol_;
};

/** Sum of logarithms, as the logarithm of a product as long as that stays in range: logarithms take time. */
class LogSum
{
 public:
	/** @param factor between 1e-150 and 1e150. */
	void add(double factor)
	{
		constexpr double least = 1e-150;
		product_ *= factor;
		if (product_ > least && product_ < 1 / least) return;
		sum_ += std::log(product_);
		product_ = 1;
	}
	double value() const { return sum_ + std::log(product_); }

 private:
	double sum_ = 0, product_ = 1;
};

/** Unit vectors of every `decimation`-th ray of a scan in the frame of the sensor, one after the other; spacing
 * aperture/(N-1) as in MRPT's points maps. Each is the one before, turned: sines would take longer than the search. */
class Rays
{
 public:
	Rays(const mrpt::obs::CObservation2DRangeScan& scan, std::size_t decimation)
	{
		const std::size_t n = scan.getScanSize();
		const double left = scan.rightToLeft ? 1 : -1;
		const double first = n > 1 ? -0.5 * left * double(scan.aperture) : 0;
		const double step = n > 1 ? left * double(scan.aperture) / double(n - 1) * double(decimation) : 0;
		ray_ = {std::cos(first), std::sin(first)};
		turn_ = {std::cos(step), std::sin(step)};
	}

	const Point2& operator*() const { return ray_; }
	void operator++() { ray_ = {ray_.x * turn_.x - ray_.y * turn_.y, ray_.x * turn_.y + ray_.y * turn_.x}; }

 private:
	Point2 ray_, turn_;
};
/** The ends of the beams that count, map frame. */
void beamEnds(const mrpt::obs::CObservation2DRangeScan& scan, const mrpt::poses::CPose3D& takenFrom,
			  const TInsertionOptions& insertion, std::size_t step, std::vector<Point2>& ends)
{
	const mrpt::poses::CPose3D sensor = takenFrom + scan.sensorPose;
	const auto& rotation = sensor.getRotationMatrix();
	const double xx = rotation(0, 0), xy = rotation(0, 1), yx = rotation(1, 0), yy = rotation(1, 1);
	ends.clear();
	Rays ray(scan, step);
	for (std::size_t i = 0; i < scan.getScanSize(); i += step, ++ray)
	{
		const double range = scan.getScanRange(i);
		if (!scan.getScanRangeValidity(i) || !(range >= insertion.minRange && range <= insertion.maxRange)) continue;
		const Point2& u = *ray;
		ends.push_back({sensor.x() + range * (xx * u.x + xy * u.y), sensor.y() + range * (yx * u.x + yy * u.y)});
	}
}

/** Where the core can be asked: it takes coordinates up to 1e6 m. */
bool isInReach(const Point2& p)
{
	constexpr double farthest = 1e6;
	return std::abs(p.x) <= farthest && std::abs(p.y) <= farthest;
}

/** Share of rays that pass on the way of a ray: the least of all places there of which anything is known, and 1/2 for
 * the part of the way of which nothing is. O(length / sigma). */
double passingShare(const RidgeMap& map, const FreeRay& ray)
{
	const Options& options = map.options();
	const double dx = ray.x - ray.sensorX, dy = ray.y - ray.sensorY, step = 2 * options.sigma;
	const double length = std::hypot(dx, dy), end = std::min(length, maxRayLength * options.sigma);
	double least = 1, known = 0, all = 0;
	for (double s = 0.5 * step; s < end; s += step, all++)
	{
		const SpaceSample sample = map.space({ray.sensorX + s / length * dx, ray.sensorY + s / length * dy});
		const bool surface = sample.hits >= options.lTol;
		if (surface) least = std::min(least, sample.across / (sample.across + sample.hits));
		known += surface || sample.state == SpaceState::free ? 1 : 0;
	}
	return all > 0 ? (known * least + 0.5 * (all - known)) / all : 0.5;
}

/** Sum of the logarithms for the beams without return, one in `step`. */
double freeBeams(const CRidgeMap2D& map, const BeamModel& model, const mrpt::obs::CObservation2DRangeScan& scan,
				 const mrpt::poses::CPose3D& takenFrom, std::size_t step)
{
	TInsertionOptions insertion = map.insertionOptions;
	insertion.freeRayRange = map.likelihoodOptions.freeBeamRange;
	const std::vector<FreeRay> rays = observationToFreeRays(scan, takenFrom, insertion);
	LogSum sum;
	for (std::size_t i = 0; i < rays.size(); i += step)
		sum.add(model.byPassingShare(passingShare(map.core(), rays[i])));
	return sum.value();
}

/** The table of a map's likelihoods by place; null if it is not wanted or the map is too wide. */
std::shared_ptr<LikelihoodTable> tableFor(const CRidgeMap2D& map, const BeamModel& model, QueryCache& cache)
{
	const TLikelihoodOptions& o = map.likelihoodOptions;
	const double pitch = o.pitch * map.options().sigma;
	if (!(pitch > 0)) return nullptr;
	const LikelihoodTable::Settings settings{o.zHit,        o.zRand,          o.zMax, o.sigmaHit,
											 o.maxDistance, double(o.target), pitch,  double(o.useOccupancy)};
	const auto build = [&]
	{
		Box2 box = o.useOccupancy ? map.box() : Box2();
		for (const auto& line : o.target == LikelihoodTarget::walls ? map.walls() : map.ridges())
			for (const Point2& p : line.points) box.extend(p);
		const double margin = o.useOccupancy ? map.options().cutoff * map.options().sigma : o.maxDistance;
		box.min = {box.min.x - margin, box.min.y - margin};
		box.max = {box.max.x + margin, box.max.y + margin};
		return std::make_shared<LikelihoodTable>(settings, box, pitch, std::log(model.far(o.useOccupancy)));
	};
	const auto table = cache.likelihoods(settings, build);
	return table->usable() ? table : nullptr;
}
}  // namespace

bool CRidgeMap2D::internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& obs) const
{
	return dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&obs) != nullptr;
}

double CRidgeMap2D::internal_computeObservationLikelihood(const mrpt::obs::CObservation& obs,
														  const mrpt::poses::CPose3D& takenFrom) const
{
	const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&obs);
	if (!scan) return 0;
	const TLikelihoodOptions& o = likelihoodOptions;
	const BeamModel model(o, options().lTol);
	const std::size_t step = std::max(1u, o.decimation);
	const double free = o.freeBeamRange > 0 ? freeBeams(*this, model, *scan, takenFrom, step) : 0;
	thread_local std::vector<Point2> ends;
	beamEnds(*scan, takenFrom, insertionOptions, step, ends);
	const auto index = o.target == LikelihoodTarget::walls ? wallIndex() : ridgeIndex();
	if (const auto table = tableFor(*this, model, state_->cache))
	{
		const auto value = [&](const Point2& p)
		{
			return std::log(o.useOccupancy ? model.byOccupancy(core().occupancy(p).value)
										   : model.byDistance(std::pow(index->scatteredDistance(p, o.maxDistance), 2)));
		};
		double sum = free;
		const auto isFar = [&](const Point2& p, double reach)
		{ return !o.useOccupancy && !index->hasWithin(p, o.maxDistance + reach); };
		for (const Point2& end : ends) sum += table->at(end, value, isFar);
		return sum;
	}
	LogSum sum;
	if (o.useOccupancy)
	{
		for (const Point2& end : ends)
			sum.add(isInReach(end) ? model.byOccupancy(core().occupancy(end).value) : model.far(true));
		return free + sum.value();
	}
	thread_local std::vector<double> distancesSqr;
	index->distancesSqr(ends, o.maxDistance, distancesSqr);
	for (const double d : distancesSqr) sum.add(model.byDistance(d));
	return free + sum.value();
}

}  // namespace ridgemap
