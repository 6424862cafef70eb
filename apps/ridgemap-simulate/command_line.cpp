// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.h"

#include "../common/help_output.h"
#include "../common/number_line.h"
#include "../common/user_error.h"

namespace ridgemap::apps
{
namespace
{
constexpr const char* description =
	"Simulates the drive of a robot through a scene whose true surfaces are known.\n\n"
	"SCENE is hallway (6 m wide, with a corner of 90 degrees), wall, corner, or a text file with lines 'wall x1 y1 x2 "
	"y2', 'arc cx cy radius from to' (degrees, counter-clockwise), 'glass share angle x1 y1 x2 y2' (returns this share "
	"of the beams that come within that angle of its normal, in degrees), 'posts radius spacing x1 y1 x2 y2' (a row of "
	"them), 'path x1 y1 x2 y2 ...' (the way of the robot) and 'mover radius speed x1 y1 x2 y2' (a round thing going to "
	"and fro). All but the path can have 'during from to' in front: it is there at these times only, in seconds, and "
	"does not count as true surface.\n\n"
	"The same command gives the same bytes.";

/** TCLAP takes strings only: numbers are read here, completely or not at all. */
struct Arguments
{
	TCLAP::CmdLine cmd{description, ' ', RIDGEMAP_VERSION};
	TCLAP::UnlabeledMultiArg<std::string> scene{"SCENE", "What to drive through", false, "SCENE", cmd};

	TCLAP::ValueArg<std::string> seed{"", "seed", "Start of the random numbers (default: 1)", false, "", "N", cmd};
	TCLAP::ValueArg<std::string> odometry{"",
										  "odometry-noise",
										  "Noise of the odometry in the rawlog, share of every movement (default: 0)",
										  false,
										  "",
										  "SHARE",
										  cmd};
	TCLAP::ValueArg<std::string> poseNoise{
		"",
		"pose-noise",
		"Noise of the poses in the simplemap as M,DEG: standard deviations in metres and degrees (default: 0,0)",
		false,
		"",
		"M,DEG",
		cmd};
	TCLAP::ValueArg<std::string> speed{"", "speed", "Speed of the robot in m/s (default: 1)", false, "", "V", cmd};
	TCLAP::ValueArg<std::string> spacing{"",  "spacing", "Way between two cycles in metres (default: 0.25)", false, "",
										 "M", cmd};
	TCLAP::ValueArg<std::string> outliers{
		"", "outliers", "Share of measurements that lie anywhere in view (default: 0)", false, "", "SHARE", cmd};
	TCLAP::ValueArg<std::string> noise{
		"",
		"noise",
		"Noise along the line of sight as A,B: A + B * distance, in metres (default: 0.01,0.01; lidar: 0.02,0)",
		false,
		"",
		"A,B",
		cmd};
	TCLAP::ValueArg<std::string> side{
		"",    "side-noise", "Noise across the line of sight as A,B, paper sensor only (default: 0.005,0.005)",
		false, "",           "A,B",
		cmd};
	TCLAP::ValueArg<std::string> rate{
		"", "rate", "Mean number of measurements per cycle, paper sensor only (default: 150)", false, "", "N", cmd};
	TCLAP::ValueArg<std::string> fov{
		"", "field-of-view", "Angle that the beams cover in degrees, lidar only (default: 270)", false, "", "DEG", cmd};
	TCLAP::ValueArg<std::string> beams{"", "beams", "Beams of a scan, lidar only (default: 361)", false, "", "N", cmd};
	TCLAP::ValueArg<std::string> view{
		"", "view", "Surfaces are seen up to this distance in metres (default: 4; lidar: 20)", false, "", "M", cmd};
	TCLAP::ValueArg<std::string> sensor{
		"",
		"sensor",
		"paper: a Poisson number of measurements spread over the visible surface in proportion to its cross-section "
		"(default); lidar: a scanner with evenly spaced beams",
		false,
		"paper",
		"NAME",
		cmd};
	TCLAP::ValueArg<std::string> output{"o",
										"output",
										"Where to write: PREFIX.rawlog, PREFIX.simplemap.gz, PREFIX_measurements.csv "
										"(x,y,sensorX,sensorY), PREFIX_poses.txt (t x y phi) and PREFIX_truth.csv "
										"(x1,y1,x2,y2,seen)",
										false,
										"",
										"PREFIX",
										cmd};
};

double number(TCLAP::ValueArg<std::string>& arg, double byDefault, double least, double most)
{
	if (!arg.isSet()) return byDefault;
	const auto v = parseNumber(arg.getValue());
	if (v && *v >= least && *v <= most) return *v;
	char range[80];
	std::snprintf(range, sizeof(range), "give a number from %g to %g", least, most);
	throw UserError("wrong value '" + arg.getValue() + "' of --" + arg.getName(), range);
}

NoiseModel noiseOf(TCLAP::ValueArg<std::string>& arg, NoiseModel byDefault,
				   const char* remedy = "give two numbers A,B from 0: A + B * distance, in metres")
{
	if (!arg.isSet()) return byDefault;
	const auto fields = splitFields(arg.getValue());
	if (fields.size() == 2)
		if (const auto a = parseNumber(fields[0]), b = parseNumber(fields[1]); a && b && *a >= 0 && *b >= 0)
			if (*a <= 1e3 && *b <= 1e3) return {*a, *b};
	throw UserError("wrong value '" + arg.getValue() + "' of --" + arg.getName(), remedy);
}

CommandLine readArguments(Arguments& a)
{
	CommandLine c;
	if (a.scene.getValue().size() > 1) throw UserError("more than one scene", "name one scene, or see --help");
	if (!a.scene.getValue().empty()) c.scene = a.scene.getValue().front();
	c.prefix = a.output.getValue();
	const std::string& sensor = a.sensor.getValue();
	if (sensor != "paper" && sensor != "lidar")
		throw UserError("unknown sensor '" + sensor + "'", "choose paper or lidar");
	c.lidar = sensor == "lidar";
	c.paper.view = number(a.view, c.paper.view, 0.1, 1e4);
	c.scanner.maxRange = number(a.view, c.scanner.maxRange, 0.1, 1e4);
	c.scanner.beams = int(number(a.beams, c.scanner.beams, 2, 1e5));
	c.scanner.fieldOfView = number(a.fov, 270, 1, 360) * 3.14159265358979323846 / 180;
	c.paper.rate = number(a.rate, c.paper.rate, 0, 1e7);
	c.paper.depth = noiseOf(a.noise, c.paper.depth);
	c.paper.transverse = noiseOf(a.side, c.paper.transverse);
	c.scanner.range = noiseOf(a.noise, c.scanner.range);
	c.paper.outliers = c.scanner.outliers = number(a.outliers, 0, 0, 1);
	c.spacing = number(a.spacing, c.spacing, 1e-3, 1e4);
	c.speed = number(a.speed, c.speed, 1e-3, 1e3);
	c.odometryNoise = number(a.odometry, 0, 0, 1);
	const NoiseModel pose = noiseOf(a.poseNoise, {0, 0}, "give metres and degrees from 0, such as 0.02,0.25");
	c.poseNoise = pose.constant;
	c.headingNoise = pose.perMetre * 3.14159265358979323846 / 180;
	c.seed = std::uint64_t(number(a.seed, 1, 0, 9e15));
	return c;
}

}  // namespace

std::optional<CommandLine> parseCommandLine(int argc, char** argv)
{
	HelpOutput output("ridgemap-simulate", "SCENE -o PREFIX");
	Arguments arguments;
	arguments.cmd.setOutput(&output);
	if (!arguments.cmd.parse(argc, argv)) return std::nullopt;
	rejectUnknownOptions(arguments.scene.getValue(), "ridgemap-simulate");
	CommandLine c = readArguments(arguments);
	if (c.scene.empty()) throw UserError("no scene", "name hallway, wall, corner or a file, or see --help");
	if (c.prefix.empty()) throw UserError("no output", "give -o PREFIX");
	if (c.prefix.back() == '/') throw UserError("-o " + c.prefix + " is a directory", "give -o DIRECTORY/NAME");
	return c;
}

}  // namespace ridgemap::apps
