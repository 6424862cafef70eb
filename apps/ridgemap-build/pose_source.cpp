// SPDX-License-Identifier: BSD-3-Clause
#include "pose_source.h"

#include <mrpt/core/Clock.h>

namespace ridgemap::apps
{
namespace
{
class TrackPoses : public PoseSource
{
 public:
	TrackPoses(std::shared_ptr<const PoseTrack> track, const std::string& name) : track_(std::move(track)), name_(name)
	{
	}
	std::optional<mrpt::poses::CPose3D> poseOf(const mrpt::obs::CObservation& observation) const override
	{
		return track_->at(timeOf(observation));
	}
	std::string name() const override { return name_; }

 private:
	std::shared_ptr<const PoseTrack> track_;
	std::string name_;
};

class ActionPoses : public PoseSource
{
 public:
	void see(const mrpt::obs::CActionCollection::Ptr& action) override
	{
		mrpt::poses::CPose3D increment;
		if (action->getFirstMovementEstimationMean(increment)) pose_ = pose_ + increment;
	}
	std::optional<mrpt::poses::CPose3D> poseOf(const mrpt::obs::CObservation&) const override { return pose_; }
	std::string name() const override { return "odometry"; }

 private:
	mrpt::poses::CPose3D pose_;
};

}  // namespace

std::unique_ptr<PoseSource> makeTrackPoses(std::shared_ptr<const PoseTrack> track, const std::string& name)
{
	return std::make_unique<TrackPoses>(std::move(track), name);
}

std::unique_ptr<PoseSource> makeActionPoses()
{
	return std::make_unique<ActionPoses>();
}

double timeOf(const mrpt::obs::CObservation& observation)
{
	return mrpt::Clock::toDouble(observation.timestamp);
}

}  // namespace ridgemap::apps
