// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>
#include <ridgemap/types.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ridgemap::apps
{
/** What a reader hands on: one observation with the pose of the robot, or points of the map frame. */
struct Frame
{
	mrpt::obs::CObservation::Ptr observation;  ///< null for points
	std::optional<mrpt::poses::CPose3D>
		pose;                         ///< of the robot; empty if it is not known at the time of the observation
	std::vector<Measurement> points;  ///< measurements that are in the map frame already
};

/** A stream of frames in the order of the file. Errors are exceptions that name the file. */
class FrameReader
{
 public:
	virtual ~FrameReader() = default;
	/** Reads the next frame; false at the end. */
	virtual bool next(Frame& frame) = 0;
	/** Part of the input that was read, 0 .. 1. */
	virtual double fraction() const = 0;
	/** Where the poses come from, for the report. */
	virtual std::string poseSource() const = 0;
	/** What was left out because the reader was told to keep going, and how much of it. */
	const std::map<std::string, std::size_t>& skipped() const { return skipped_; }

 protected:
	std::map<std::string, std::size_t> skipped_;
};

}  // namespace ridgemap::apps
