// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/observation_to_measurements.h>

#include "query_cache.h"

namespace ridgemap
{
void CRidgeMap2D::insertMeasurements(const std::vector<Measurement>& measurements)
{
	core_.insert(measurements);
	cache_->reset();
}

void CRidgeMap2D::eraseMeasurements(const std::vector<Measurement>& measurements)
{
	core_.erase(measurements);
	cache_->reset();
}

void CRidgeMap2D::merge(const CRidgeMap2D& other)
{
	core_.merge(other.core_);
	cache_->reset();
}

void CRidgeMap2D::subtract(const CRidgeMap2D& other)
{
	core_.subtract(other.core_);
	cache_->reset();
}

bool CRidgeMap2D::internal_insertObservation(const mrpt::obs::CObservation& obs,
											 const std::optional<const mrpt::poses::CPose3D>& robotPose)
{
	const auto measurements =
		observationToMeasurements(obs, robotPose.value_or(mrpt::poses::CPose3D()), insertionOptions);
	if (measurements.empty()) return false;
	insertMeasurements(measurements);
	return true;
}

bool CRidgeMap2D::eraseObservation(const mrpt::obs::CObservation& obs,
								   const std::optional<const mrpt::poses::CPose3D>& robotPose)
{
	if (!genericMapParams.enableObservationInsertion) return false;
	const auto measurements =
		observationToMeasurements(obs, robotPose.value_or(mrpt::poses::CPose3D()), insertionOptions);
	if (measurements.empty()) return false;
	eraseMeasurements(measurements);
	return true;
}

}  // namespace ridgemap
