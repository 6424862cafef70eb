// SPDX-License-Identifier: BSD-3-Clause
#include "inputs.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

#include "../common/user_error.h"
#include "points_reader.h"
#include "simplemap_reader.h"

namespace ridgemap::apps
{
InputKind kindOf(const std::string& path)
{
	static const std::map<std::string, InputKind> kinds{
		{".simplemap", InputKind::simplemap}, {".rawlog", InputKind::rawlog}, {".csv", InputKind::points},
		{".txt", InputKind::points},          {".xyz", InputKind::points},    {".ridgemap", InputKind::ridgemap}};
	std::string name = std::filesystem::path(path).filename().string();
	std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
	if (const auto at = name.rfind(".gz"); at != std::string::npos && at + 3 == name.size()) name.resize(at);
	const auto dot = name.rfind('.');
	const auto found = dot == std::string::npos ? kinds.end() : kinds.find(name.substr(dot));
	if (found == kinds.end())
		throw UserError("'" + path + "' is of an unknown kind",
						"give .simplemap, .rawlog, .csv, .txt, .xyz or .ridgemap files, also with .gz");
	return found->second;
}

std::unique_ptr<FrameReader> openReader(const std::string& path, const PoseChoice& poses, bool keepGoing)
{
	switch (kindOf(path))
	{
		case InputKind::simplemap:
			return std::make_unique<SimpleMapReader>(path, keepGoing);
		case InputKind::rawlog:
			return std::make_unique<RawlogReader>(path, poses, keepGoing);
		case InputKind::points:
			return std::make_unique<PointsReader>(path);
		case InputKind::ridgemap:
			break;
	}
	throw std::logic_error("a ridge map is no stream of frames");
}

}  // namespace ridgemap::apps
