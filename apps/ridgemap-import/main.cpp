// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/CRidgeMap2D.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "../common/help_output.h"
#include "../common/map_report.h"
#include "../common/number_line.h"
#include "../common/user_error.h"
#include "plan_readers.h"

namespace ridgemap::apps
{
namespace
{
constexpr const char* description =
	"Makes a frozen ridge map, for localisation, of a building plan: the lines and outlines of a .dxf, .geojson or "
	".svg "
	"file (path, polyline, polygon, line and rect elements).";

struct CommandLine
{
	std::string plan, output;
	std::set<std::string> layers;
	std::optional<double> scale;
	bool quiet = false;
};

Plan readPlan(const CommandLine& c)
{
	std::string extension = std::filesystem::path(c.plan).extension().string();
	for (char& letter : extension)
		if (letter >= 'A' && letter <= 'Z') letter = char(letter - 'A' + 'a');
	if (extension == ".svg") return readSvg(c.plan, c.layers);
	if (extension == ".dxf") return readDxf(c.plan, c.layers);
	if (extension == ".geojson" || extension == ".json") return readGeoJson(c.plan, c.layers);
	throw UserError("'" + c.plan + "' is of an unknown kind", "give a .dxf, .geojson or .svg file");
}

CRidgeMap2D makeMap(Plan plan, double scale)
{
	for (Polyline& line : plan.lines)
		for (Point2& p : line.points) p = {p.x * scale, p.y * scale};
	return CRidgeMap2D::fromPolylines(plan.lines);
}

std::optional<CommandLine> parse(int argc, char** argv)
{
	HelpOutput output("ridgemap-import", "PLAN -o FILE.ridgemap");
	TCLAP::CmdLine cmd(description, ' ', RIDGEMAP_VERSION);
	TCLAP::UnlabeledMultiArg<std::string> plans("PLAN", "Plan to read", false, "PLAN", cmd);
	TCLAP::SwitchArg quiet("q", "quiet", "No summary", cmd);
	TCLAP::ValueArg<std::string> scale("", "scale", "Metres per unit of the plan (default: as the file says, else 1)",
									   false, "", "M", cmd);
	TCLAP::MultiArg<std::string> layer("", "layer",
									   "Read this layer (for SVG: group with this id) only. Repeatable (default: all)",
									   false, "NAME", cmd);
	TCLAP::ValueArg<std::string> file("o", "output", "Map to write", false, "", "FILE.ridgemap", cmd);
	cmd.setOutput(&output);
	if (!cmd.parse(argc, argv)) return std::nullopt;
	rejectUnknownOptions(plans.getValue(), "ridgemap-import");
	if (plans.getValue().size() != 1) throw UserError("there must be one plan", "name one file, or see --help");
	if (!file.isSet()) throw UserError("no output", "give -o FILE.ridgemap, or see --help");
	CommandLine c;
	c.plan = plans.getValue().front();
	c.output = file.getValue();
	c.layers.insert(layer.getValue().begin(), layer.getValue().end());
	c.quiet = quiet.getValue();
	if (!scale.isSet()) return c;
	c.scale = parseNumber(scale.getValue());
	if (!c.scale || !std::isfinite(*c.scale) || *c.scale <= 0)
		throw UserError("wrong value '" + scale.getValue() + "' of --scale", "give metres per unit, above 0");
	return c;
}

int run(int argc, char** argv)
{
	const auto c = parse(argc, argv);
	if (!c) return 0;
	const Plan plan = readPlan(*c);
	const double scale = c->scale.value_or(plan.metresPerUnit);
	const CRidgeMap2D map = makeMap(plan, scale);
	if (map.isEmpty())
		throw UserError("'" + c->plan + "' holds no lines" + (c->layers.empty() ? "" : " on these layers"),
						"give a plan with lines" + std::string(c->layers.empty() ? "" : ", or leave out --layer"));
	saveRidgeMap(c->output, map);
	if (c->quiet) return 0;
	const PolylineFigures f = figuresOf(map.walls());
	const Box2 box = map.box();
	std::printf("walls         %.3f m in %zu polylines (%zu closed) with %zu nodes\n", f.metres, f.polylines, f.closed,
				f.nodes);
	std::printf("size          %.3f m x %.3f m, %g m per unit of the plan\n", box.max.x - box.min.x,
				box.max.y - box.min.y, scale);
	if (plan.leftOut != 0) std::printf("left out      %zu things that are no lines\n", plan.leftOut);
	printWritten(c->output);
	return 0;
}

}  // namespace
}  // namespace ridgemap::apps

int main(int argc, char** argv)
{
	return ridgemap::apps::runProgram("ridgemap-import", ridgemap::apps::run, argc, argv);
}
