// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <string>
#include <vector>

namespace ridgemap::apps
{
/** Poses of a robot over time, interpolated linearly (rotations by slerp) between neighbours. */
class PoseTrack
{
 public:
	/** Adds a pose at a time in seconds since 1970, in any order. */
	void add(double time, const mrpt::poses::CPose3D& pose) { poses_.push_back({time, pose}); }

	/** Sorts the poses by time; of several with one time the first counts. Call once after the last add(). */
	void finish();

	bool empty() const { return poses_.empty(); }
	std::size_t size() const { return poses_.size(); }
	double firstTime() const { return poses_.front().time; }
	double lastTime() const { return poses_.back().time; }

	/** The pose at a time; nothing before the first and after the last pose. */
	std::optional<mrpt::poses::CPose3D> at(double time) const;

 private:
	struct TimedPose
	{
		double time;
		mrpt::poses::CPose3D pose;
	};
	std::vector<TimedPose> poses_;
};

/** Reads lines `t x y phi` (seconds, metres, radians) or TUM's `t x y z qx qy qz qw`; empty lines and comments after
 * `#` are skipped. */
PoseTrack readPoseTrack(const std::string& path);

}  // namespace ridgemap::apps
