// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "../common/map_report.h"
#include "../common/user_error.h"
#include "command_line.h"
#include "recording.h"

namespace ridgemap::apps
{
namespace
{
Scene sceneOf(const std::string& name)
{
	if (name == "hallway") return hallwayScene();
	if (name == "wall") return wallScene();
	if (name == "corner") return cornerScene();
	return readScene(name);
}

void printSummary(const Recording& recording, const std::vector<std::string>& files)
{
	std::size_t measurements = 0;
	for (const Recording::Cycle& c : recording.cycles) measurements += c.measurements.size();
	double all = 0, seen = 0;
	for (const Segment& s : recording.truth)
	{
		all += s.length();
		seen += s.seen ? s.length() : 0;
	}
	std::printf("cycles        %zu\n", recording.cycles.size());
	std::printf("measurements  %zu\n", measurements);
	std::printf("surface       %.2f m, of which %.2f m in view at some time\n", all, seen);
	for (const std::string& f : files) printWritten(f);
}

int run(int argc, char** argv)
{
	const auto c = parseCommandLine(argc, argv);
	if (!c) return 0;
	const Recording recording = simulate(*c, sceneOf(c->scene));
	printSummary(recording, writeRecording(*c, recording));
	return 0;
}

}  // namespace
}  // namespace ridgemap::apps

int main(int argc, char** argv)
{
	return ridgemap::apps::runProgram("ridgemap-simulate", ridgemap::apps::run, argc, argv);
}
