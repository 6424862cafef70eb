// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "../common/help_output.h"
#include "../common/number_line.h"
#include "../common/user_error.h"

namespace ridgemap::apps
{
namespace
{
constexpr const char* description =
	"Builds a ridge map: surfaces as polylines on the ridges of the continuous occupancy of all measurements.\n\n"
	"INPUT is a .simplemap[.gz] (poses inside), a .rawlog (poses from --poses, --odometry or, by default, MRPT's "
	"ICP-SLAM), a .csv, .txt or .xyz of points 'x y' in the map frame, or the .ridgemap of an earlier run. Several "
	"inputs are merged.";

constexpr int defaultFormats = 8;  ///< so many of allFormats() are written if the user does not choose

constexpr const char* shuffleHelp =
	"Feed the measurements in a random order. The files come out the same: the map keeps exact integer sums of the "
	"measurements, and its polylines are a pure function of these, so order and batches leave no trace. Without "
	"--batch, a tenth of the measurements is fed at a time";

template <class Integer>
Integer parseInteger(const std::string& option, const std::string& text, Integer least, const std::string& remedy)
{
	Integer value = 0;
	const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), value);
	if (error != std::errc() || at != text.data() + text.size() || value < least)
		throw UserError("wrong value '" + text + "' of " + option, remedy);
	return value;
}

std::string joined(const std::vector<std::string>& words)
{
	std::string out;
	for (const std::string& w : words) out += (out.empty() ? "" : ",") + w;
	return out;
}

std::set<std::string> parseFormats(const std::string& list)
{
	std::set<std::string> formats;
	std::stringstream in(list);
	for (std::string word; std::getline(in, word, ',');)
	{
		const auto& known = allFormats();
		if (std::find(known.begin(), known.end(), word) == known.end())
			throw UserError("unknown format '" + word + "' in --formats", "choose from " + joined(known));
		formats.insert(word);
	}
	if (formats.empty()) throw UserError("--formats names no format", "choose from " + joined(allFormats()));
	return formats;
}

std::pair<std::string, std::string> parseSetting(const std::string& text)
{
	const auto at = text.find('=');
	if (at == 0 || at == std::string::npos)
		throw UserError("wrong value '" + text + "' of --set", "write --set KEY=VALUE");
	return {text.substr(0, at), text.substr(at + 1)};
}

/** TCLAP takes strings only: numbers are read here, completely or not at all. */
struct Arguments
{
	TCLAP::CmdLine cmd{description, ' ', RIDGEMAP_VERSION};
	TCLAP::UnlabeledMultiArg<std::string> inputs{"INPUT", "Files to build the map from", false, "INPUT", cmd};
	TCLAP::SwitchArg quiet{"q", "quiet", "No progress and no summary", cmd};
	TCLAP::ValueArg<std::string> formats{"",
										 "formats",
										 "Files to write: some of " + joined(allFormats()) + " (default: the first " +
											 std::to_string(defaultFormats) + ")",
										 false,
										 "",
										 "LIST",
										 cmd};
	TCLAP::SwitchArg showRemoved{"", "show-removed", "Show in the pictures what was left out as rays passed through it",
								 cmd};
	TCLAP::SwitchArg showFree{"", "show-free", "Shade in the pictures what is known to be free", cmd};
	TCLAP::ValueArg<std::string> keepLast{"",
										  "keep-last",
										  "Keep the last N scans only, or with an s behind the number those of the "
										  "last N seconds, such as 60s: older ones "
										  "are taken out again, exactly",
										  false,
										  "",
										  "N|SECONDSs",
										  cmd};
	TCLAP::SwitchArg errors{"", "errors", "Colour the walls in the pictures by their standard errors", cmd};
	TCLAP::ValueArg<std::string> threads{
		"", "threads", "Threads to compute with; the files do not depend on it (default: 1)", false, "", "N", cmd};
	TCLAP::ValueArg<std::string> batch{
		"",    "batch", "Feed the measurements N at a time instead of scan by scan; the files do not depend on it",
		false, "",      "N",
		cmd};
	TCLAP::SwitchArg everyScan{"", "every-scan",
							   "Bring the polylines up to date after every scan or batch, as a robot does, and report "
							   "how long that takes; otherwise they are made once, at the end. The files do not depend "
							   "on it",
							   cmd};
	TCLAP::ValueArg<std::string> shuffle{"", "shuffle", shuffleHelp, false, "", "SEED", cmd};
	TCLAP::SwitchArg odometry{"", "odometry", "Poses of a rawlog from the odometry in it, uncorrected", cmd};
	TCLAP::ValueArg<std::string> poses{
		"",    "poses", "Poses of a rawlog: lines 't x y phi' or TUM's 't x y z qx qy qz qw', interpolated in time",
		false, "",      "FILE",
		cmd};
	TCLAP::MultiArg<std::string> set{
		"", "set", "Set an option of the map; --dump-config lists the keys. Repeatable", false, "KEY=VALUE", cmd};
	TCLAP::ValueArg<std::string> eps{
		"", "eps", "Bound on the distance of every polyline point to the true ridge, in metres", false, "", "M", cmd};
	TCLAP::ValueArg<std::string> sigma{
		"", "sigma", "Smoothing parameter in metres: 2.5 to 3 times the noise across a wall", false, "", "M", cmd};
	TCLAP::SwitchArg keepGoing{
		"", "keep-going",
		"Use what can be read of rawlogs and simplemaps that are cut off or damaged, have holes, objects of wrong "
		"classes or times that run backwards, and say how much was left out; otherwise these are errors",
		cmd};
	TCLAP::SwitchArg resume{"", "resume",
							"Continue an interrupted run, given the same command line: the files come out as if it had "
							"not been interrupted",
							cmd};
	TCLAP::SwitchArg dumpConfig{"", "dump-config", "Print the commented INI file of all map options and exit", cmd};
	TCLAP::ValueArg<std::string> config{"",
										"config",
										"INI file with map options, as --dump-config prints it; its sections [ICP] and "
										"[MappingApplication], if any, set "
										"up ICP-SLAM as for MRPT's icp-slam",
										false,
										"",
										"FILE.ini",
										cmd};
	TCLAP::ValueArg<std::string> output{
		"o",
		"output",
		"Where to write: PREFIX.ridgemap, PREFIX_ridges.csv, PREFIX_walls.csv, PREFIX_measurements.csv, PREFIX.png, "
		"PREFIX.svg, PREFIX.3Dscene and PREFIX_stats.json. The measurements, with their sensor positions, are an input "
		"for the same map again (beams that met nothing are not in it). The formats ridge_vertices and wall_vertices "
		"(PREFIX_ridge_vertices.csv, "
		"PREFIX_wall_vertices.csv) hold occupancy, noise, standard error and 95 % interval of every node, too; removed "
		"(PREFIX_removed.csv) what the walls leave out as rays passed through it",
		false,
		"",
		"PREFIX",
		cmd};
};

void parseKeepLast(const std::string& text, CommandLine& c)
{
	const std::string remedy = "give a number of scans, or of seconds with an s behind, such as 60s";
	if (text.empty() || text.back() != 's')
	{
		c.keepScans = parseInteger<unsigned>("--keep-last", text, 1, remedy);
		return;
	}
	const auto seconds = parseNumber(text.substr(0, text.size() - 1));
	if (!seconds || !(*seconds > 0 && *seconds <= 1e9))
		throw UserError("wrong value '" + text + "' of --keep-last", remedy);
	c.keepSeconds = *seconds;
}

CommandLine readArguments(Arguments& a)
{
	CommandLine c;
	c.inputs = a.inputs.getValue();
	c.prefix = a.output.getValue();
	c.config = a.config.getValue();
	if (a.sigma.isSet()) c.settings.emplace_back("sigma", a.sigma.getValue());
	if (a.eps.isSet()) c.settings.emplace_back("eps", a.eps.getValue());
	for (const std::string& s : a.set.getValue()) c.settings.push_back(parseSetting(s));
	c.poses = a.poses.getValue();
	c.odometry = a.odometry.getValue();
	if (a.shuffle.isSet())
		c.shuffleSeed = parseInteger<std::uint64_t>("--shuffle", a.shuffle.getValue(), 0, "give a whole number from 0");
	if (a.batch.isSet())
		c.batch = parseInteger<std::size_t>("--batch", a.batch.getValue(), 1, "give a whole number from 1");
	if (a.threads.isSet())
		c.threads = parseInteger<unsigned>("--threads", a.threads.getValue(), 1, "give a whole number from 1");
	c.everyScan = a.everyScan.getValue();
	const auto firstOthers = allFormats().begin() + defaultFormats;
	c.formats = a.formats.isSet() ? parseFormats(a.formats.getValue())
								  : std::set<std::string>(allFormats().begin(), firstOthers);
	c.errors = a.errors.getValue();
	c.showRemoved = a.showRemoved.getValue();
	c.showFree = a.showFree.getValue();
	if (a.keepLast.isSet()) parseKeepLast(a.keepLast.getValue(), c);
	c.keepGoing = a.keepGoing.getValue();
	c.resume = a.resume.getValue();
	c.quiet = a.quiet.getValue();
	c.dumpConfig = a.dumpConfig.getValue();
	return c;
}

void check(const CommandLine& c)
{
	rejectUnknownOptions(c.inputs, "ridgemap-build");
	if (!c.poses.empty() && c.odometry)
		throw UserError("--poses and --odometry were both given", "choose one source of poses");
	if ((c.keepScans != 0 || c.keepSeconds > 0) && (c.shuffleSeed || c.batch != 0))
		throw UserError("--keep-last goes by scans", "leave out --shuffle and --batch");
	if (c.threads > 256) throw UserError("--threads is above 256", "give at most the number of cores");
	if (c.dumpConfig) return;
	if (c.inputs.empty()) throw UserError("no input", "name the files to build from, or see --help");
	if (c.prefix.empty()) throw UserError("no output", "give -o PREFIX");
	if (c.prefix.back() == '/') throw UserError("-o " + c.prefix + " is a directory", "give -o DIRECTORY/NAME");
}

}  // namespace

const std::vector<std::string>& allFormats()
{
	static const std::vector<std::string> names{"ridgemap", "ridges",  "walls", "measurements",   "png",
												"svg",      "3dscene", "stats", "ridge_vertices", "wall_vertices",
												"removed"};
	return names;
}

std::optional<CommandLine> parseCommandLine(int argc, char** argv)
{
	HelpOutput output("ridgemap-build", "INPUT... -o PREFIX");
	Arguments arguments;
	arguments.cmd.setOutput(&output);
	if (!arguments.cmd.parse(argc, argv)) return std::nullopt;
	CommandLine c = readArguments(arguments);
	check(c);
	return c;
}

}  // namespace ridgemap::apps
