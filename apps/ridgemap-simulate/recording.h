// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <string>
#include <vector>

#include "command_line.h"

namespace ridgemap::apps
{
/** A simulated drive as a robot would have recorded it, and what it cannot know. */
struct Recording
{
	struct Cycle
	{
		Pose pose;
		mrpt::obs::CObservation::Ptr observation;
		std::vector<Measurement> measurements;  ///< map frame
	};
	std::vector<Cycle> cycles;
	std::vector<Segment> truth;
};

Recording simulate(const CommandLine& c, const Scene& scene);

/** Writes all files; each appears complete or not at all. Throws std::exception naming the file. Returns their names.
 */
std::vector<std::string> writeRecording(const CommandLine& c, const Recording& recording);

}  // namespace ridgemap::apps
