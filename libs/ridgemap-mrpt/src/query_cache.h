// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CSimplePointsMap.h>
#include <ridgemap/polyline_index.h>

#include <memory>
#include <mutex>

namespace ridgemap
{
/** What const queries of a map have built, guarded by a mutex. */
class QueryCache
{
 public:
	/** To be called by every function that changes the map. */
	void reset()
	{
		const std::lock_guard<std::mutex> lock(mutex_);
		walls_.reset();
		ridges_.reset();
		points_.reset();
	}

	template <class Build>
	std::shared_ptr<const PolylineIndex> walls(Build&& build)
	{
		return get(walls_, build);
	}

	template <class Build>
	std::shared_ptr<const PolylineIndex> ridges(Build&& build)
	{
		return get(ridges_, build);
	}

	template <class Build>
	std::shared_ptr<const mrpt::maps::CSimplePointsMap> points(Build&& build)
	{
		return get(points_, build);
	}

 private:
	template <class T, class Build>
	std::shared_ptr<const T> get(std::shared_ptr<const T>& slot, Build&& build)
	{
		const std::lock_guard<std::mutex> lock(mutex_);
		if (!slot) slot = build();
		return slot;
	}

	std::mutex mutex_;
	std::shared_ptr<const PolylineIndex> walls_, ridges_;
	std::shared_ptr<const mrpt::maps::CSimplePointsMap> points_;
};

}  // namespace ridgemap
