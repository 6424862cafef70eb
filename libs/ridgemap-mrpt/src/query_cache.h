// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CSimplePointsMap.h>
#include <ridgemap/point_to_line_matching.h>
#include <ridgemap/polyline_index.h>

#include <memory>
#include <mutex>

#include "likelihood_table.h"

namespace ridgemap
{
/** What const queries of a map have built, guarded by mutexes. */
class QueryCache
{
 public:
	/** To be called by every function that changes the map. */
	void reset()
	{
		const std::scoped_lock lock(mutex_, targetMutex_);
		walls_.reset();
		ridges_.reset();
		targets_.reset();
		likelihoods_.reset();
		points_.reset();
		pointsOf_.reset();
	}

	template <class Build>
	std::shared_ptr<const PolylineIndex> walls(Build&& build)
	{
		const std::lock_guard<std::mutex> lock(mutex_);
		if (!walls_) walls_ = build();
		return walls_;
	}

	template <class Build>
	std::shared_ptr<const PolylineIndex> ridges(Build&& build)
	{
		const std::lock_guard<std::mutex> lock(mutex_);
		if (!ridges_) ridges_ = build();
		return ridges_;
	}

	/** Maps with other settings may share this cache: the targets are those of the last one that asked. */
	template <class Build>
	std::shared_ptr<const MatchingTargets> targets(const TargetSettings& settings, Build&& build)
	{
		const std::lock_guard<std::mutex> lock(targetMutex_);
		if (!targets_ || !(targets_->settings() == settings)) targets_ = build();
		return targets_;
	}

	/** As targets(). */
	template <class Build>
	std::shared_ptr<LikelihoodTable> likelihoods(const LikelihoodTable::Settings& settings, Build&& build)
	{
		const std::lock_guard<std::mutex> lock(targetMutex_);
		if (!likelihoods_ || likelihoods_->settings() != settings) likelihoods_ = build();
		return likelihoods_;
	}

	/** The targets as a map of points. */
	template <class Build>
	std::shared_ptr<const mrpt::maps::CSimplePointsMap> points(const std::shared_ptr<const MatchingTargets>& targets,
															   Build&& build)
	{
		const std::lock_guard<std::mutex> lock(mutex_);
		if (!points_ || pointsOf_ != targets) points_ = build();
		pointsOf_ = targets;
		return points_;
	}

 private:
	std::mutex mutex_, targetMutex_;
	std::shared_ptr<const PolylineIndex> walls_, ridges_;
	std::shared_ptr<const MatchingTargets> targets_, pointsOf_;
	std::shared_ptr<const mrpt::maps::CSimplePointsMap> points_;
	std::shared_ptr<LikelihoodTable> likelihoods_;
};

}  // namespace ridgemap
