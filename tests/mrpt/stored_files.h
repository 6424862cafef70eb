// SPDX-License-Identifier: BSD-3-Clause
// Maps in files of a folder that goes with the test.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "damage.h"
#include "scenes.h"

namespace ridgemap::test
{
inline CRidgeMap2D mapOfRoom(double perMetre = 400)
{
	auto measurements = room(1.5, 1, perMetre);
	for (Measurement& m : measurements) m.sensorX = 0.1, m.sensorY = 0.2;
	CRidgeMap2D map;
	map.insertMeasurements(measurements);
	return map;
}

class Folder
{
 public:
	Folder() : path_(std::filesystem::temp_directory_path() / ("ridgemap_damage_" + std::to_string(::getpid())))
	{
		std::filesystem::create_directories(path_);
	}
	~Folder()
	{
		std::error_code ignored;
		std::filesystem::remove_all(path_, ignored);
	}
	std::string operator/(const std::string& name) const { return (path_ / name).string(); }
	std::size_t files() const { return std::size_t(std::distance(std::filesystem::directory_iterator(path_), {})); }

 private:
	std::filesystem::path path_;
};

inline Bytes contentOf(const std::string& path)
{
	std::ifstream in(path, std::ios::binary);
	return {std::istreambuf_iterator<char>(in), {}};
}

/** Bytes of the map in the file; nothing if it was refused. */
inline std::optional<Bytes> loaded(const std::string& path)
{
	try
	{
		return bytesOf(loadRidgeMap(path));
	}
	catch (const std::exception&)
	{
		return std::nullopt;
	}
}

}  // namespace ridgemap::test
