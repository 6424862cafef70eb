// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3D.h>
#include <ridgemap/map_options.h>

#include <memory>
#include <optional>
#include <string>

#include "pose_track.h"

namespace ridgemap::apps
{
/** Gives the observations of a rawlog their poses. It sees every object of the log in its order, then is asked for the
 * poses of the observations in it. */
class PoseSource
{
 public:
	virtual ~PoseSource() = default;
	virtual void see(const mrpt::obs::CActionCollection::Ptr&) {}
	virtual void see(const mrpt::obs::CSensoryFrame::Ptr&) {}
	/** An observation that is not part of a sensory frame. */
	virtual void see(const mrpt::obs::CObservation::Ptr&) {}
	/** The pose of the robot at an observation seen last; nothing if it is not known. */
	virtual std::optional<mrpt::poses::CPose3D> poseOf(const mrpt::obs::CObservation& observation) const = 0;
	virtual std::string name() const = 0;
};

/** Poses from a track, by the time of each observation. */
std::unique_ptr<PoseSource> makeTrackPoses(std::shared_ptr<const PoseTrack> track, const std::string& name);

/** Sum of the odometry increments of the actions. */
std::unique_ptr<PoseSource> makeActionPoses();

/** MRPT's ICP-SLAM against a ridge map of its own with these options, run on the way. Sections `[ICP]` and
 * `[MappingApplication]` of an icp-slam file change its parameters, where given. */
std::unique_ptr<PoseSource> makeIcpPoses(const MapOptions& map, const mrpt::config::CConfigFileBase* config);

/** Seconds since 1970 of an observation. */
double timeOf(const mrpt::obs::CObservation& observation);

}  // namespace ridgemap::apps
