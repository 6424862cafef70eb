// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>
#include <ridgemap/CRidgeMap2D.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ridgemap
{
namespace
{
/** Density of the end of one beam by its distance from the nearest polyline; its logarithm is finite whatever the
 * options. */
class BeamModel
{
 public:
	explicit BeamModel(const TLikelihoodOptions& o)
		: random_(o.zRand / o.zMax), hit_(o.zHit), perVariance_(-0.5 / (o.sigmaHit * o.sigmaHit))
	{
	}

	double operator()(double distanceSqr) const
	{
		constexpr double least = 1e-150;
		return std::clamp(random_ + hit_ * std::exp(perVariance_ * distanceSqr), least, 1 / least);
	}

 private:
	double random_, hit_, perVariance_;
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
	const auto index = o.target == LikelihoodTarget::walls ? wallIndex() : ridgeIndex();
	const mrpt::poses::CPose3D sensor = takenFrom + scan->sensorPose;
	const auto& rotation = sensor.getRotationMatrix();
	const BeamModel model(o);
	const double farthestSqr = o.maxDistance * o.maxDistance, farBeam = model(farthestSqr);
	const std::size_t step = std::max(1u, o.decimation);
	thread_local std::vector<Point2> ends;
	thread_local std::vector<double> distancesSqr;
	ends.clear();
	Rays ray(*scan, step);
	for (std::size_t i = 0; i < scan->getScanSize(); i += step, ++ray)
	{
		const double range = scan->getScanRange(i);
		if (!scan->getScanRangeValidity(i) ||
			!(range >= insertionOptions.minRange && range <= insertionOptions.maxRange))
			continue;
		const Point2& u = *ray;
		ends.push_back({sensor.x() + range * (rotation(0, 0) * u.x + rotation(0, 1) * u.y),
						sensor.y() + range * (rotation(1, 0) * u.x + rotation(1, 1) * u.y)});
	}
	index->distancesSqr(ends, o.maxDistance, distancesSqr);
	LogSum sum;
	for (const double d : distancesSqr) sum.add(d < farthestSqr ? model(d) : farBeam);
	return sum.value();
}

}  // namespace ridgemap
