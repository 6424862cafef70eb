// SPDX-License-Identifier: BSD-3-Clause
// Readers of text: points, poses, INI files. The first byte chooses which.
#include <mrpt/config/CConfigFileMemory.h>
#include <ridgemap/map_options.h>
#include <ridgemap/options.h>
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../../apps/common/user_error.h"
#include "../../apps/ridgemap-build/points_reader.h"
#include "../../apps/ridgemap-build/pose_track.h"
#include "fuzz_target.h"
#include "text_input.h"

namespace ridgemap::fuzz
{
namespace
{
/** Points with and without sensors go into a map, with its sides and rays, and out again. */
void insertAndErase(const std::vector<Measurement>& points)
{
	RidgeMap map;
	try
	{
		map.insert(points);
		for (const Polyline& line : map.walls()) require(line.points.size() >= 2, "walls are lines");
		map.erase(points);
	}
	catch (const std::exception& e)
	{
		require(false, e.what());
	}
	require(map.empty() && map.ridges().empty(), "what was inserted and erased leaves nothing");
}

void readPoints(const std::string& path)
{
	apps::PointsReader reader(path);
	std::vector<Measurement> some;  // near the origin, to be quick
	for (apps::Frame frame; reader.next(frame);)
		for (const Measurement& m : frame.points)
		{
			require(std::abs(m.x) <= maxCoordinate && std::abs(m.y) <= maxCoordinate, "points are finite and in range");
			double farthest = 0;
			for (const double v : {m.x, m.y, m.sensorX, m.sensorY})
				if (!std::isnan(v)) farthest = std::max(farthest, std::abs(v));
			require(farthest <= maxCoordinate, "sensors are in range, or not known");
			if (farthest < 20 && some.size() < 100) some.push_back(m);
		}
	insertAndErase(some);
}

void readPoses(const std::string& path)
{
	const apps::PoseTrack track = apps::readPoseTrack(path);
	for (const double share : {0.0, 0.3, 1.0})
		if (const auto pose = track.at(track.firstTime() + share * (track.lastTime() - track.firstTime())))
			require(!std::isnan(pose->x()), "poses are numbers");
}

void readOptions(const std::string& text)
{
	mrpt::config::CConfigFileMemory config;
	config.setContent(text);
	MapOptions options;
	options.loadFromConfigFile(config, "map_");
	options.validate();
	for (const std::string& key : MapOptions::keys())
	{
		MapOptions copy;
		copy.setOption(key, options.getOption(key));
		require(copy.getOption(key) == options.getOption(key), "options are written and read alike");
	}
}
}  // namespace

std::vector<std::vector<std::uint8_t>> seeds()
{
	std::string ini = "[map_creationOpts]\n";
	for (const std::string& key : MapOptions::keys()) ini += key + " = " + MapOptions().getOption(key) + "\n";
	std::string wall = "x,y,sx,sy\n";
	for (int i = 0; i < 40; i++)
		wall += std::to_string(0.02 * i) + ",1." + std::to_string(i % 3) + (i % 2 == 0 ? ",0,0\n" : ",0.5,2\n");
	return {textSeed(0, "x,y\n1,2\n3;4\n# comment\n5 6 7 8\n"),
			textSeed(0, "1e5\t-1e-300\n+2 .5\n"),
			textSeed(0, wall),
			textSeed(1, "1 2 3 0.4\n2 2.5 3 0.5\n"),
			textSeed(1, "1 2 3 4 0 0 0 1\n5 6 7 8 0 0.6 0 0.8\n"),
			textSeed(2, ini),
			textSeed(2, "[map_creationOpts]\nsigma = 0.1 // m\n[map_insertOpts]\nmaxRange=30\n")};
}
}  // namespace ridgemap::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
	using namespace ridgemap;
	if (size == 0) return 0;
	const std::string text(data + 1, data + size);
	static const fuzz::ScratchFile file("");
	try
	{
		switch (data[0] % 3)
		{
			case 0:
				fuzz::readPoints(file.with(text));
				break;
			case 1:
				fuzz::readPoses(file.with(text));
				break;
			default:
				fuzz::readOptions(text);
		}
	}
	catch (const std::exception& e)
	{
		fuzz::require(*e.what() != 0, "errors have a message");
	}
	return 0;
}
