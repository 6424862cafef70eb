// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "../common/help_output.h"
#include "../common/map_report.h"
#include "../common/number_line.h"
#include "../common/user_error.h"
#include "experiments.h"

namespace ridgemap::apps
{
namespace
{
constexpr const char* description =
	"Repeats the experiments of the paper and those that its claims ask for, and puts each beside what the paper says: "
	"DIR/index.html with pictures, and the data as csv files.";

struct Experiment
{
	const char* name;
	Finding (*run)(const Setting&);
};
constexpr Experiment experiments[] = {{"fig1", constructionFigure},
									  {"fig2", hallwayFigure},
									  {"fig3", straightWall},
									  {"fig4", cornerError},
									  {"fig5", cornerFigure},
									  {"fig6", runTime},
									  {"permutations", permutations},
									  {"corrections", corrections},
									  {"changes", changes},
									  {"convergence", convergence},
									  {"step-rules", stepRules},
									  {"outliers", outlierShares},
									  {"standard-errors", standardErrors}};

struct Arguments
{
	TCLAP::CmdLine cmd{description, ' ', RIDGEMAP_VERSION};
	TCLAP::UnlabeledMultiArg<std::string> names{"EXPERIMENT", "Only these", false, "EXPERIMENT", cmd};
	TCLAP::ValueArg<std::string> note{
		"", "note", "Words to put at the head of the page, such as commit and machine", false, "", "TEXT", cmd};
	TCLAP::ValueArg<std::string> seed{"", "seed", "Start of the random numbers (default: 1)", false, "", "N", cmd};
	TCLAP::SwitchArg list{"", "list", "Print the names of the experiments and exit", cmd};
	TCLAP::SwitchArg quick{"", "quick", "Fewer repetitions: minutes become seconds, the figures less certain", cmd};
	TCLAP::ValueArg<std::string> output{"o", "output", "Where to write; made if needed", false, "", "DIR", cmd};
};

std::vector<Experiment> chosen(const std::vector<std::string>& names)
{
	if (names.empty()) return {std::begin(experiments), std::end(experiments)};
	std::vector<Experiment> result;
	for (const std::string& name : names)
	{
		const std::size_t before = result.size();
		for (const Experiment& e : experiments)
			if (name == e.name) result.push_back(e);
		if (result.size() == before) throw UserError("unknown experiment '" + name + "'", "see --list");
	}
	return result;
}

int run(int argc, char** argv)
{
	HelpOutput output("ridgemap-paper", "[EXPERIMENT]... -o DIR");
	Arguments a;
	a.cmd.setOutput(&output);
	if (!a.cmd.parse(argc, argv)) return 0;
	rejectUnknownOptions(a.names.getValue(), "ridgemap-paper");
	if (a.list.getValue())
	{
		for (const Experiment& e : experiments) std::printf("%s\n", e.name);
		return 0;
	}
	const std::vector<Experiment> wanted = chosen(a.names.getValue());
	Setting setting;
	setting.directory = a.output.getValue();
	setting.quick = a.quick.getValue();
	if (setting.directory.empty()) throw UserError("no output", "give -o DIR");
	if (a.seed.isSet())
	{
		const auto seed = parseNumber(a.seed.getValue());
		if (!seed || !(*seed >= 0 && *seed <= 9e15))
			throw UserError("wrong value '" + a.seed.getValue() + "' of --seed", "give a whole number from 0");
		setting.seed = std::uint64_t(*seed);
	}
	std::filesystem::create_directories(setting.directory);
	std::vector<Finding> findings;
	for (const Experiment& e : wanted)
	{
		const auto start = std::chrono::steady_clock::now();
		findings.push_back(e.run(setting));
		const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
		std::printf("%s (%.1f s)\n    %s\n", e.name, seconds, findings.back().result.c_str());
		std::fflush(stdout);
	}
	std::string note = a.note.getValue();
	if (setting.quick) note += std::string(note.empty() ? "" : " ") + "Quick run: fewer repetitions.";
	writeReport(setting, findings, note);
	printWritten(setting.path("index.html"));
	return 0;
}

}  // namespace
}  // namespace ridgemap::apps

int main(int argc, char** argv)
{
	return ridgemap::apps::runProgram("ridgemap-paper", ridgemap::apps::run, argc, argv);
}
