// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>

#include "../common/gz_input.h"
#include "frame.h"
#include "pose_source.h"

namespace ridgemap::apps
{
/** Where the poses of a rawlog come from. */
struct PoseChoice
{
	std::shared_ptr<const PoseTrack> track;  ///< from a file; null: not given
	bool odometry = false;                   ///< from the odometry in the log
	/** Otherwise from ICP-SLAM against a ridge map with these options, and with these parameters, if any. */
	MapOptions map;
	const mrpt::config::CConfigFileBase* config = nullptr;
};

/** Reads a rawlog of either kind, object by object: action and sensory frame in turn, or single observations. */
class RawlogReader : public FrameReader
{
 public:
	/** With odometry, the file is read twice: the first time for its odometry. */
	RawlogReader(const std::string& path, const PoseChoice& choice);

	bool next(Frame& frame) override;
	double fraction() const override { return input_.fraction(); }
	std::string poseSource() const override { return poses_->name(); }

 private:
	GzInput input_;
	std::unique_ptr<PoseSource> poses_;
	std::deque<Frame> queue_;  ///< the frames of the object read last
	std::size_t objects_ = 0;

	void take(const mrpt::serialization::CSerializable::Ptr& object);
	void enqueue(const mrpt::obs::CObservation::Ptr& observation);
};

}  // namespace ridgemap::apps
