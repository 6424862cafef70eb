// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>
#include <ridgemap/CRidgeMap2D.h>

#include <algorithm>
#include <cmath>

namespace ridgemap
{
namespace
{
/** Log-likelihood of one beam that ends at distance d from the nearest polyline; finite whatever the options. */
double beamLogLikelihood(double d, const TLikelihoodOptions& o)
{
	const double z = d / o.sigmaHit;
	const double p = o.zRand / o.zMax + o.zHit * std::exp(-0.5 * z * z);
	constexpr double least = 1e-300;
	return std::log(p > least ? std::min(p, 1 / least) : least);
}

/** Unit vector of ray i in the frame of the sensor; spacing aperture/(N-1) as in MRPT's points maps. */
Point2 rayDirection(const mrpt::obs::CObservation2DRangeScan& scan, std::size_t i)
{
	const std::size_t n = scan.getScanSize();
	const double step = n > 1 ? double(scan.aperture) / double(n - 1) : 0;
	const double angle = (n > 1 ? -0.5 * double(scan.aperture) : 0) + step * double(i);
	return {std::cos(angle), scan.rightToLeft ? std::sin(angle) : -std::sin(angle)};
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
	const auto index = o.target == LikelihoodTarget::walls ? wallIndex() : ridgeIndex();
	const mrpt::poses::CPose3D sensor = takenFrom + scan->sensorPose;
	const auto& rotation = sensor.getRotationMatrix();
	const double farBeam = beamLogLikelihood(o.maxDistance, o);
	double sum = 0;
	for (std::size_t i = 0; i < scan->getScanSize(); i += std::max(1u, o.decimation))
	{
		const double range = scan->getScanRange(i);
		if (!scan->getScanRangeValidity(i) ||
			!(range >= insertionOptions.minRange && range <= insertionOptions.maxRange))
			continue;
		const Point2 u = rayDirection(*scan, i);
		const Point2 end{sensor.x() + range * (rotation(0, 0) * u.x + rotation(0, 1) * u.y),
						 sensor.y() + range * (rotation(1, 0) * u.x + rotation(1, 1) * u.y)};
		const double d = index->distance(end, o.maxDistance);
		sum += d < o.maxDistance ? beamLogLikelihood(d, o) : farBeam;
	}
	return sum;
}

}  // namespace ridgemap
