// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/observation_to_measurements.h>

#include <stdexcept>
#include <string>

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

/** Adds or takes out measurements and rays of a scan: both or, if there is an error, none. */
void apply(RidgeMap& map, const ObservedScan& scan, bool insert)
{
	insert ? map.insert(scan.measurements) : map.erase(scan.measurements);
	try
	{
		insert ? map.insertFreeRays(scan.freeRays) : map.eraseFreeRays(scan.freeRays);
	}
	catch (...)
	{
		insert ? map.erase(scan.measurements) : map.insert(scan.measurements);
		throw;
	}
}

/** Adds a scan and takes out those that it makes outdated: all or, if there is an error, none. */
void exchange(RidgeMap& map, const ObservedScan& scan, const std::vector<const ObservedScan*>& outdated)
{
	apply(map, scan, true);
	std::size_t out = 0;
	try
	{
		for (; out < outdated.size(); out++) apply(map, *outdated[out], false);
	}
	catch (const std::exception& e)
	{
		while (out > 0) apply(map, *outdated[--out], true);
		apply(map, scan, false);
		throw std::runtime_error("a scan of the sliding window cannot be taken out of the map (" +
								 std::string(e.what()) + "): set keepScans and keepSeconds to 0, or clear the map");
	}
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

void CRidgeMap2D::insertScan(const ObservedScan& scan)
{
	throwIfFrozen("cannot insert a scan");
	const TInsertionOptions& o = insertionOptions;
	if (o.keepScans == 0 && !(o.keepSeconds > 0) && state_->window.empty())
		return change(state_, [&](RidgeMap& map) { apply(map, scan, true); });
	ScanWindow& window = own(state_).window;
	const auto outdated = window.outdatedBy(scan, o.keepScans, o.keepSeconds);
	change(state_, [&](RidgeMap& map) { exchange(map, scan, outdated); });
	window.push(scan, o.keepScans, o.keepSeconds);
}

void CRidgeMap2D::eraseScan(const ObservedScan& scan)
{
	throwIfFrozen("cannot erase a scan");
	change(state_, [&](RidgeMap& map) { apply(map, scan, false); });
	if (!state_->window.empty()) own(state_).window.forget(scan);
}

bool CRidgeMap2D::internal_insertObservation(const mrpt::obs::CObservation& obs,
											 const std::optional<const mrpt::poses::CPose3D>& robotPose)
{
	const auto scan = observedScan(obs, robotPose.value_or(mrpt::poses::CPose3D()), insertionOptions);
	if (scan.empty()) return false;
	insertScan(scan);
	return true;
}

bool CRidgeMap2D::eraseObservation(const mrpt::obs::CObservation& obs,
								   const std::optional<const mrpt::poses::CPose3D>& robotPose)
{
	if (!genericMapParams.enableObservationInsertion) return false;
	const auto scan = observedScan(obs, robotPose.value_or(mrpt::poses::CPose3D()), insertionOptions);
	if (scan.empty()) return false;
	eraseScan(scan);
	return true;
}

bool CRidgeMap2D::reanchor(const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& oldPose,
						   const mrpt::poses::CPose3D& newPose)
{
	if (!genericMapParams.enableObservationInsertion) return false;
	const auto before = observedScan(obs, oldPose, insertionOptions);
	const auto after = observedScan(obs, newPose, insertionOptions);
	if (before.empty() && after.empty()) return false;
	change(state_,
		   [&](RidgeMap& map)
		   {
			   apply(map, before, false);
			   try
			   {
				   apply(map, after, true);
			   }
			   catch (...)
			   {
				   apply(map, before, true);
				   throw;
			   }
		   });
	if (!state_->window.empty()) own(state_).window.replace(before, after);
	return true;
}

}  // namespace ridgemap
