// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/observation_to_measurements.h>

#include "map_state.h"

namespace ridgemap
{
namespace
{
/** Changes the map alone, not its copies, and drops what queries have built. */
template <class Change>
void change(std::shared_ptr<MapState>& state, Change&& apply)
{
	MapState& mine = own(state);
	apply(mine.core);
	mine.cache.reset();
}
}  // namespace

void CRidgeMap2D::insertMeasurements(const std::vector<Measurement>& measurements)
{
	throwIfFrozen("cannot insert measurements");
	change(state_, [&](RidgeMap& map) { map.insert(measurements); });
}

void CRidgeMap2D::eraseMeasurements(const std::vector<Measurement>& measurements)
{
	throwIfFrozen("cannot erase measurements");
	change(state_, [&](RidgeMap& map) { map.erase(measurements); });
}

void CRidgeMap2D::insertFreeRays(const std::vector<FreeRay>& rays)
{
	throwIfFrozen("cannot insert rays");
	change(state_, [&](RidgeMap& map) { map.insertFreeRays(rays); });
}

void CRidgeMap2D::eraseFreeRays(const std::vector<FreeRay>& rays)
{
	throwIfFrozen("cannot erase rays");
	change(state_, [&](RidgeMap& map) { map.eraseFreeRays(rays); });
}

void CRidgeMap2D::merge(const CRidgeMap2D& other)
{
	throwIfFrozen("cannot merge another map");
	other.throwIfFrozen("cannot merge this map into another");
	change(state_, [&](RidgeMap& map) { map.merge(other.core()); });
}

void CRidgeMap2D::subtract(const CRidgeMap2D& other)
{
	throwIfFrozen("cannot subtract another map");
	other.throwIfFrozen("cannot subtract this map from another");
	change(state_, [&](RidgeMap& map) { map.subtract(other.core()); });
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

bool CRidgeMap2D::reanchor(const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& oldPose,
						   const mrpt::poses::CPose3D& newPose)
{
	if (!genericMapParams.enableObservationInsertion) return false;
	const auto before = observationToMeasurements(obs, oldPose, insertionOptions);
	const auto after = observationToMeasurements(obs, newPose, insertionOptions);
	if (before.empty() && after.empty()) return false;
	change(state_,
		   [&](RidgeMap& map)
		   {
			   map.erase(before);
			   try
			   {
				   map.insert(after);
			   }
			   catch (...)
			   {
				   map.insert(before);
				   throw;
			   }
		   });
	return true;
}

}  // namespace ridgemap
