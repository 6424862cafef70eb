// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ridgemap::apps
{
/** What the user asked ridgemap-build for. */
struct CommandLine
{
	std::vector<std::string> inputs;
	std::string prefix;                                         ///< of the files to write
	std::string config;                                         ///< INI file with map options; empty: none
	std::vector<std::pair<std::string, std::string>> settings;  ///< map options, in the order to apply them
	std::string poses;                                          ///< file with poses; empty: none
	bool odometry = false;
	std::optional<std::uint64_t> shuffleSeed;
	std::size_t batch = 0;   ///< measurements per insertion; 0: scan by scan
	bool everyScan = false;  ///< polylines are made after every insertion, not once at the end
	unsigned threads = 1;
	std::set<std::string> formats;
	bool showRemoved = false;  ///< show in the pictures what rays passed through
	bool showFree = false;     ///< shade in the pictures what is free
	unsigned keepScans = 0;    ///< scans to keep; 0: all
	double keepSeconds = 0;    ///< age of scans to keep [s]; 0: any
	bool errors = false;       ///< colour the walls in the pictures by their standard errors
	bool keepGoing = false;    ///< leave out what cannot be used of an input
	bool resume = false;       ///< continue an interrupted run
	bool quiet = false;
	bool dumpConfig = false;
};

/** All names that --formats knows; those of the files that are written by default come first. */
const std::vector<std::string>& allFormats();

/** Throws UserError for wrong usage; nothing if the user asked for help or the version, which is then on stdout. */
std::optional<CommandLine> parseCommandLine(int argc, char** argv);

}  // namespace ridgemap::apps
