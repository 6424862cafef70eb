// SPDX-License-Identifier: BSD-3-Clause
#include "map_settings.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "../common/gz_input.h"
#include "../common/user_error.h"

namespace ridgemap::apps
{
namespace
{
std::string lower(std::string s)
{
	std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return char(std::tolower(c)); });
	return s;
}

/** `map_ridgeMap_00` of `map_ridgeMap_00_creationOpts`; empty for the sections of other maps. */
std::string prefixOf(const std::string& section)
{
	const auto at = section.rfind('_');
	if (at == std::string::npos) return "";
	const std::string kind = lower(section.substr(at + 1)), prefix = section.substr(0, at);
	const bool known = kind == "creationopts" || kind == "insertopts" || kind == "likelihoodopts" ||
					   kind == "renderopts" || kind == "matchingopts";
	const bool ours =
		lower(prefix).find("ridgemap") != std::string::npos || lower(prefix).find("ridgepoints") != std::string::npos;
	return known && ours ? prefix : "";
}

std::string findPrefix(const mrpt::config::CConfigFileBase& config, const std::string& file)
{
	std::vector<std::string> sections;
	config.getAllSections(sections);
	std::set<std::string> prefixes;
	for (const std::string& s : sections)
		if (const std::string p = prefixOf(s); !p.empty()) prefixes.insert(p);
	if (prefixes.empty())
		throw UserError("'" + file + "' holds no section of a ridge map", "start from ridgemap-build --dump-config");
	if (prefixes.size() > 1)
		throw UserError(
			"'" + file + "' holds several ridge maps (" + *prefixes.begin() + ", " + *prefixes.rbegin() + ")",
			"keep one of them");
	return *prefixes.begin();
}

std::string readText(const std::string& file)
{
	GzInput input(file);
	std::string text;
	for (std::string line; input.readLine(line);)
	{
		if (line.find('\0') != std::string::npos) throw UserError("'" + file + "' is no text", "give an INI file");
		text += line + '\n';
	}
	return text;
}

}  // namespace

MapSettings::MapSettings(const std::string& iniFile, const std::vector<std::pair<std::string, std::string>>& settings)
	: iniFile_(iniFile), settings_(settings)
{
	if (iniFile.empty()) return;
	config_.emplace();
	config_->setContent(readText(iniFile));
	sectionPrefix_ = findPrefix(*config_, iniFile);
}

MapOptions MapSettings::applyTo(MapOptions options) const
{
	if (config_) try
		{
			options.loadFromConfigFile(*config_, sectionPrefix_);
		}
		catch (const std::exception& e)
		{
			throw UserError("'" + iniFile_ + "': " + oneLine(e), "compare with ridgemap-build --dump-config");
		}
	for (const auto& [key, value] : settings_) try
		{
			options.setOption(key, value);
		}
		catch (const std::exception& e)
		{
			throw UserError(oneLine(e), "see ridgemap-build --dump-config");
		}
	try
	{
		options.validate();
	}
	catch (const std::exception& e)
	{
		throw UserError(oneLine(e), "see ridgemap-build --dump-config");
	}
	return options;
}

std::string iniText(const MapOptions& options)
{
	const std::string map = "map";  // MRPT programs have names of their own for this section
	return "[" + map + "]\nridgeMap_count = 1\n\n" + options.toIniText(map + "_ridgeMap_00");
}

std::string differences(const Options& a, const Options& b)
{
	MapOptions x, y;
	x.creation = TCreationOptions(a);
	y.creation = TCreationOptions(b);
	std::string text;
	for (const std::string& key : MapOptions::keys())
	{
		const std::string u = x.getOption(key), v = y.getOption(key);
		if (u != v) text += (text.empty() ? "" : ", ") + key + " " + u + " and " + v;
	}
	return text;
}

}  // namespace ridgemap::apps
