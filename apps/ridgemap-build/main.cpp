// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/CRidgeMap2D.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>

#include "../common/map_file.h"
#include "../common/map_report.h"
#include "../common/user_error.h"
#include "builder.h"
#include "command_line.h"
#include "inputs.h"
#include "interrupt.h"
#include "map_settings.h"
#include "outputs.h"
#include "stats.h"

namespace ridgemap::apps
{
namespace
{
using EarlierMaps = std::map<std::string, CRidgeMap2D>;

/** Looks at all inputs before anything long is started. */
EarlierMaps checkInputs(const CommandLine& c)
{
	EarlierMaps maps;
	bool rawlog = false;
	for (const std::string& path : c.inputs)
	{
		const InputKind kind = kindOf(path);
		GzInput readable(path);
		rawlog = rawlog || kind == InputKind::rawlog;
		if (kind == InputKind::ridgemap) maps.emplace(path, loadMap(path));
	}
	if (!rawlog && (!c.poses.empty() || c.odometry))
		throw UserError("--poses and --odometry are for rawlogs, and there is none among the inputs",
						"leave the option out");
	return maps;
}

/** Options of earlier maps are taken over; what the user asks for must agree with them. */
MapOptions chooseOptions(const CommandLine& c, const MapSettings& settings, const EarlierMaps& maps)
{
	MapOptions options = settings.applyTo(maps.empty() ? MapOptions() : maps.begin()->second.mapOptions());
	if (c.keepScans != 0) options.insertion.keepScans = c.keepScans;
	if (c.keepSeconds > 0) options.insertion.keepSeconds = c.keepSeconds;
	for (const auto& [path, map] : maps)
		if (const Options& theirs = map.options(); theirs != options.creation)
			throw UserError("'" + path + "' was built with other options: " + differences(theirs, options.creation),
							"give maps built alike and leave these options out, or build from the measurements again");
	return options;
}

PoseChoice choosePoses(const CommandLine& c, const MapSettings& settings)
{
	PoseChoice choice;
	if (!c.poses.empty()) choice.track = std::make_shared<PoseTrack>(readPoseTrack(c.poses));
	choice.odometry = c.odometry;
	choice.config = settings.config();
	return choice;
}

std::string titleOf(const CommandLine& c, const CRidgeMap2D& map)
{
	std::string title = std::filesystem::path(c.inputs.front()).filename().string();
	if (c.inputs.size() > 1) title += " and " + std::to_string(c.inputs.size() - 1) + " more";
	char figures[100];
	std::snprintf(figures, sizeof(figures), ",  sigma %g m,  %.1f m of wall", map.options().sigma,
				  figuresOf(map.walls()).metres);
	return title + figures;
}

/** The map to start with: empty, or that of the run to continue. */
InterruptedRun startOf(const CommandLine& c, const MapOptions& options)
{
	if (!c.resume) return {{}, CRidgeMap2D(options)};
	InterruptedRun earlier = readResume(Outputs::resumePath(c.prefix));
	if (iniText(earlier.map.mapOptions()) != iniText(options))
		throw UserError("the options are not those of the interrupted run",
						"resume with the same command line, or start without --resume");
	return earlier;
}

/** Says on stderr how an interrupted run ended and gives its return code, as a shell would. */
int endInterrupted(const std::string& how)
{
	std::fprintf(stderr, "ridgemap-build: interrupted by %s; %s\n", interruptName().c_str(), how.c_str());
	return 128 + interruptedBy();
}

int build(const CommandLine& c, const MapSettings& settings, const EarlierMaps& maps, Outputs& outputs)
{
	const auto start = std::chrono::steady_clock::now();
	PoseChoice poses = choosePoses(c, settings);
	poses.map = chooseOptions(c, settings, maps);
	const Feed feed{c.shuffleSeed, c.batch, c.threads, c.everyScan, c.keepGoing};
	InterruptedRun run = startOf(c, poses.map);
	CRidgeMap2D& map = run.map;
	map.setThreads(c.threads);
	Progress progress(!c.quiet);
	Builder builder(
		map, feed, run.point, [&](const Measurement& m) { outputs.addMeasurement(m); }, progress);
	for (const std::string& path : c.inputs)
		if (!builder.goOn())
			break;
		else if (const auto earlier = maps.find(path); earlier != maps.end())
			builder.add(path, earlier->second);
		else
			builder.add(path, *openReader(path, poses, c.keepGoing));
	builder.finish();
	if (builder.stopped() && builder.behindEarlierRun())
		return endInterrupted("before it was as far as the earlier run; its files stay as they are");
	if (builder.stopped() && map.isEmpty())
		return endInterrupted("there were no measurements yet, and no file was written");

	const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
	std::vector<std::vector<Point2>> paths;
	for (const InputReport& r : builder.inputs())
		if (!r.robotPath.empty()) paths.push_back(r.robotPath);
	outputs.write(
		map, paths, titleOf(c, map),
		[&](std::ostream& out, const Outputs::FileSizes& sizes)
		{ writeStats(out, map, builder, feed, seconds, sizes); },
		builder.stopped() ? std::optional<ResumePoint>(builder.done()) : std::nullopt);
	if (!c.quiet) printSummary(map, builder, feed.everyScan, seconds, outputs);
	if (builder.stopped())
		return endInterrupted("the files hold the " + std::to_string(builder.done().frames) +
							  " frames read until then; the same command with --resume goes on");
	if (interruptedBy() != 0) return endInterrupted("all inputs had been read, and the files are complete");
	return 0;
}

int run(int argc, char** argv)
{
	const auto c = parseCommandLine(argc, argv);
	if (!c) return 0;
	const MapSettings settings(c->config, c->settings);
	if (c->dumpConfig)
	{
		std::fputs(iniText(settings.applyTo(MapOptions())).c_str(), stdout);
		return 0;
	}
	const EarlierMaps maps = checkInputs(*c);
	chooseOptions(*c, settings, maps);
	catchInterrupts();
	Outputs outputs(c->prefix, c->formats, {c->errors, c->showRemoved, c->showFree});
	return build(*c, settings, maps, outputs);
}

}  // namespace
}  // namespace ridgemap::apps

int main(int argc, char** argv)
{
	return ridgemap::apps::runProgram("ridgemap-build", ridgemap::apps::run, argc, argv);
}
