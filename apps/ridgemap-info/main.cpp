// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "../common/help_output.h"
#include "../common/map_file.h"
#include "../common/map_report.h"
#include "../common/user_error.h"

namespace ridgemap::apps
{
namespace
{
constexpr const char* description =
	"Prints options, figures and the bounding box of ridge maps that ridgemap-build or a program of MRPT's wrote.";

void printPolylines(const char* name, const std::vector<Polyline>& polylines)
{
	const PolylineFigures f = figuresOf(polylines);
	std::printf("%-14s%.3f m in %zu polylines (%zu closed) with %zu nodes\n", name, f.metres, f.polylines, f.closed,
				f.nodes);
}

void printText(const std::string& path, const CRidgeMap2D& map)
{
	const MapStatistics s = map.core().statistics();
	std::printf("file          %s (%s)\n", path.c_str(), humanBytes(double(std::filesystem::file_size(path))).c_str());
	if (map.isFrozen())
		std::printf("frozen        polylines without measurements\n");
	else
		std::printf("measurements  %llu in %zu cells\n", static_cast<unsigned long long>(s.measurements), s.cells);
	printPolylines("walls", map.walls());
	printPolylines("ridges", map.ridges());
	if (s.unstitchedCrossings != 0) std::printf("unstitched    %zu crossings of tile borders\n", s.unstitchedCrossings);
	for (std::size_t i = 0; i < s.stops.size(); i++)
		if (s.stops[i] != 0) std::printf("ends          %zu: %s\n", s.stops[i], toString(StopReason(i)));
	if (const Box2 b = map.box(); !b.empty())
		std::printf("bounding box  x %.3f to %.3f m, y %.3f to %.3f m\n", b.min.x, b.max.x, b.min.y, b.max.y);
	std::printf("memory        %s in %zu tiles\n", humanBytes(double(s.bytes)).c_str(), s.tiles);
	const MapOptions options = map.mapOptions();
	std::printf("options\n");
	for (const std::string& key : MapOptions::keys())
		std::printf("  %-22s%s\n", key.c_str(), options.getOption(key).c_str());
}

void printJson(JsonWriter& json, const std::string& path, const CRidgeMap2D& map)
{
	json.beginObject();
	json.value("file", path);
	json.value("fileBytes", std::filesystem::file_size(path));
	writeFigures(json, map);
	writeOptions(json, map.mapOptions());
	json.end();
}

int run(int argc, char** argv)
{
	HelpOutput output("ridgemap-info", "MAP.ridgemap...");
	TCLAP::CmdLine cmd(description, ' ', RIDGEMAP_VERSION);
	TCLAP::UnlabeledMultiArg<std::string> files("MAP", "Maps to describe", false, "MAP.ridgemap", cmd);
	TCLAP::SwitchArg asJson("", "json", "Print JSON: an object for one map, an array for several", cmd);
	cmd.setOutput(&output);
	if (!cmd.parse(argc, argv)) return 0;
	const std::vector<std::string>& paths = files.getValue();
	rejectUnknownOptions(paths, "ridgemap-info");
	if (paths.empty()) throw UserError("no map", "name a .ridgemap file, or see --help");

	// All maps are read before the first line is printed, so that an error stands alone.
	std::vector<CRidgeMap2D> maps;
	for (const std::string& path : paths) maps.push_back(loadMap(path));
	std::ostringstream text;
	JsonWriter json(text);
	if (asJson.getValue() && maps.size() > 1) json.beginArray();
	for (std::size_t i = 0; i < maps.size(); i++)
		if (asJson.getValue())
			printJson(json, paths[i], maps[i]);
		else
			printText(paths[i], maps[i]);
	if (asJson.getValue() && maps.size() > 1) json.end();
	std::fputs(text.str().c_str(), stdout);
	return 0;
}

}  // namespace
}  // namespace ridgemap::apps

int main(int argc, char** argv)
{
	return ridgemap::apps::runProgram("ridgemap-info", ridgemap::apps::run, argc, argv);
}
