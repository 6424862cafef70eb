// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <map>
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
	/** With odometry, the file is read twice: the first time for its odometry.
	 * @param keepGoing takes what comes before damage, and leaves out what does not belong in a rawlog and observations
	 * of times before those of the same sensor */
	RawlogReader(const std::string& path, const PoseChoice& choice, bool keepGoing = false);

	bool next(Frame& frame) override;
	double fraction() const override { return input_.fraction(); }
	std::string poseSource() const override { return poses_->name(); }

 private:
	GzInput input_;
	const bool keepGoing_;
	std::unique_ptr<PoseSource> poses_;
	std::deque<Frame> queue_;  ///< the frames of the object read last
	std::size_t objects_ = 0;
	std::map<std::string, double> lastTimes_;  ///< by class and label of the sensor

	void take(const mrpt::serialization::CSerializable::Ptr& object);
	/** Reads the next object; false at the end or, if it keeps going, at damage. */
	bool readNext(mrpt::serialization::CSerializable::Ptr& object);
	/** Counts what is left out, or throws. */
	void skip(const std::string& what);
	/** Whether an observation can be used: it is there, and no older than the one before of its sensor. */
	bool isUsable(const mrpt::obs::CObservation::Ptr& observation);
	void enqueue(const mrpt::obs::CObservation::Ptr& observation);
};

}  // namespace ridgemap::apps
