// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "../common/simulator.h"

namespace ridgemap::apps
{
/** What the user wants. */
struct CommandLine
{
	std::string scene;   ///< name of a built-in scene or path of a file
	std::string prefix;  ///< of the files to write
	bool lidar = false;
	PaperSensor paper;
	LidarSensor scanner;
	double spacing = 0.25;     ///< of the poses [m]
	double speed = 1;          ///< [m/s]
	double odometryNoise = 0;  ///< standard deviation of the odometry, share of every movement
	double poseNoise = 0;      ///< of the poses in the simplemap, standard deviation of x and y [m]
	double headingNoise = 0;   ///< the same of their directions [rad]
	std::uint64_t seed = 1;
};

/** Nothing if all was said by printing help or version. Throws UserError. */
std::optional<CommandLine> parseCommandLine(int argc, char** argv);

}  // namespace ridgemap::apps
