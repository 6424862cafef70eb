// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CConfigFileMemory.h>
#include <ridgemap/map_options.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ridgemap::apps
{
/** The options of the map as the user wants them: what the file and the command line name, on top of a base. */
class MapSettings
{
 public:
	/** Reads the INI file, unless its name is empty. The sections may stand for any map of MRPT's, such as
	 * `[map_ridgeMap_00_creationOpts]`. */
	MapSettings(const std::string& iniFile, const std::vector<std::pair<std::string, std::string>>& settings);

	/** The base with the user's options set. Throws UserError for unknown keys and wrong values. */
	MapOptions applyTo(MapOptions base) const;

	/** The INI file, for sections other than those of the map; null if none was given. */
	const mrpt::config::CConfigFileBase* config() const { return config_ ? &*config_ : nullptr; }

 private:
	std::string iniFile_;
	std::optional<mrpt::config::CConfigFileMemory> config_;
	std::string sectionPrefix_;
	std::vector<std::pair<std::string, std::string>> settings_;
};

/** The options as a commented INI file, ready for programs of MRPT's. */
std::string iniText(const MapOptions& options);

/** Names of the options in which two maps differ, with both values: `sigma 0.05 and 0.1`. */
std::string differences(const Options& a, const Options& b);

}  // namespace ridgemap::apps
