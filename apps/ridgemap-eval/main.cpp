// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <sstream>

#include "../common/evaluation.h"
#include "../common/help_output.h"
#include "../common/json_writer.h"
#include "../common/map_file.h"
#include "../common/number_line.h"
#include "../common/scene.h"
#include "../common/user_error.h"

namespace ridgemap::apps
{
namespace
{
constexpr const char* description =
	"Compares ridges and walls of a map with the true surface.\n\n"
	"RMSD is the root mean square distance to the nearest true point over the length of all polylines, equation (9) of "
	"the paper; complete is the share of the true surface that was seen and has a polyline within reach; spurious is "
	"what lies out of reach of the truth, duplicates what lies beside a stretch that the map has already; fragments "
	"counts the polylines on every connected true surface. All figures are integrals in closed form.";

struct Arguments
{
	TCLAP::CmdLine cmd{description, ' ', RIDGEMAP_VERSION};
	TCLAP::UnlabeledMultiArg<std::string> map{"MAP", "Map to evaluate", false, "MAP.ridgemap", cmd};
	TCLAP::SwitchArg polylines{"", "polylines", "Print every polyline, too", cmd};
	TCLAP::SwitchArg json{"", "json", "Print JSON, with every polyline", cmd};
	TCLAP::ValueArg<std::string> corner{
		"", "corner-radius", "What is this near to a corner is shown apart, in metres (default: 1)", false, "", "M",
		cmd};
	TCLAP::ValueArg<std::string> within{
		"",  "within", "Reach: farthest that map and truth may be apart, in metres (default: sigma)", false, "",
		"M", cmd};
	TCLAP::ValueArg<std::string> truth{
		"",     "truth", "True surface: lines 'x1,y1,x2,y2[,seen]', as ridgemap-simulate writes them", false, "",
		"FILE", cmd};
};

double positive(TCLAP::ValueArg<std::string>& arg, double byDefault)
{
	if (!arg.isSet()) return byDefault;
	const auto v = parseNumber(arg.getValue());
	if (v && *v > 0 && *v <= 1e6) return *v;
	throw UserError("wrong value '" + arg.getValue() + "' of --" + arg.getName(), "give a number of metres above 0");
}

void writeDistance(JsonWriter& json, const std::string& key, const DistanceSum& d)
{
	json.beginObject(key);
	json.value("metres", d.length);
	json.value("rmsd", d.rmsd());
	json.value("maximum", d.maximum);
	json.end();
}

void writeEvaluation(JsonWriter& json, const std::string& key, const Evaluation& e)
{
	json.beginObject(key);
	writeDistance(json, "all", e.all);
	writeDistance(json, "corners", e.corners);
	writeDistance(json, "straight", e.straight);
	writeDistance(json, "withinReach", e.right);
	json.value("completeness", e.completeness());
	json.value("truthMetres", e.truthLength);
	json.value("truthCoveredMetres", e.truthCovered);
	json.value("cornerTruthMetres", e.truthCornerLength);
	json.value("cornerTruthCoveredMetres", e.truthCornerCovered);
	json.value("spuriousMetres", e.spurious);
	json.value("duplicateMetres", e.duplicates);
	json.value("surfaces", e.surfaces);
	json.value("fragments", e.fragments);
	json.beginArray("polylines");
	for (const PolylineEvaluation& p : e.polylines)
	{
		json.beginObject();
		json.value("metres", p.distance.length);
		json.value("rmsd", p.distance.rmsd());
		json.value("maximum", p.distance.maximum);
		json.value("metresWithinReach", p.right.length);
		json.end();
	}
	json.end();
	json.end();
}

void printRow(const char* name, const char* unit, double ridges, double walls, int digits)
{
	std::printf("%-22s%12.*f%12.*f  %s\n", name, digits, ridges, digits, walls, unit);
}

void printTable(const Evaluation& r, const Evaluation& w, const EvaluationSettings& settings)
{
	std::printf("%-22s%12s%12s\n", "", "ridges", "walls");
	printRow("RMSD", "mm", 1e3 * r.all.rmsd(), 1e3 * w.all.rmsd(), 3);
	printRow("  near corners", "mm", 1e3 * r.corners.rmsd(), 1e3 * w.corners.rmsd(), 3);
	printRow("  elsewhere", "mm", 1e3 * r.straight.rmsd(), 1e3 * w.straight.rmsd(), 3);
	printRow("  within reach", "mm", 1e3 * r.right.rmsd(), 1e3 * w.right.rmsd(), 3);
	printRow("maximum", "mm", 1e3 * r.all.maximum, 1e3 * w.all.maximum, 3);
	printRow("  near corners", "mm", 1e3 * r.corners.maximum, 1e3 * w.corners.maximum, 3);
	printRow("  elsewhere", "mm", 1e3 * r.straight.maximum, 1e3 * w.straight.maximum, 3);
	printRow("complete", "%", 100 * r.completeness(), 100 * w.completeness(), 2);
	printRow("length", "m", r.all.length, w.all.length, 2);
	printRow("  near corners", "m", r.corners.length, w.corners.length, 2);
	printRow("spurious", "m", r.spurious, w.spurious, 3);
	printRow("duplicates", "m", r.duplicates, w.duplicates, 3);
	printRow("polylines", "", double(r.polylines.size()), double(w.polylines.size()), 0);
	printRow("fragments", "", double(r.fragments), double(w.fragments), 0);
	std::printf("\ntruth: %.2f m seen, in %zu connected surfaces with %zu corners\n", r.truthLength, r.surfaces,
				r.cornerCount);
	std::printf("reach: %g m; near corners: within %g m\n", settings.within, settings.cornerRadius);
}

void printPolylines(const char* name, const Evaluation& e)
{
	std::printf("\n%-10s%12s%12s%12s\n", name, "length m", "RMSD mm", "maximum mm");
	for (std::size_t i = 0; i < e.polylines.size(); i++)
	{
		const DistanceSum& d = e.polylines[i].distance;
		std::printf("%-10zu%12.3f%12.3f%12.3f\n", i, d.length, 1e3 * d.rmsd(), 1e3 * d.maximum);
	}
}

int run(int argc, char** argv)
{
	HelpOutput output("ridgemap-eval", "MAP.ridgemap --truth FILE");
	Arguments a;
	a.cmd.setOutput(&output);
	if (!a.cmd.parse(argc, argv)) return 0;
	rejectUnknownOptions(a.map.getValue(), "ridgemap-eval");
	if (a.map.getValue().size() != 1) throw UserError("expected one map", "name one .ridgemap file, or see --help");
	if (!a.truth.isSet()) throw UserError("no truth", "give --truth FILE");
	const CRidgeMap2D map = loadMap(a.map.getValue().front());
	const std::vector<Segment> truth = readTruth(a.truth.getValue());
	EvaluationSettings settings;
	settings.within = positive(a.within, map.options().sigma);
	settings.cornerRadius = positive(a.corner, settings.cornerRadius);
	const Evaluation ridges = evaluate(map.ridges(), truth, settings), walls = evaluate(map.walls(), truth, settings);
	if (!a.json.getValue())
	{
		printTable(ridges, walls, settings);
		if (!a.polylines.getValue()) return 0;
		printPolylines("ridge", ridges);
		printPolylines("wall", walls);
		return 0;
	}
	std::ostringstream text;
	JsonWriter json(text);
	json.beginObject();
	json.value("map", a.map.getValue().front());
	json.value("truth", a.truth.getValue());
	json.value("within", settings.within);
	json.value("cornerRadius", settings.cornerRadius);
	json.value("corners", ridges.cornerCount);
	writeEvaluation(json, "ridges", ridges);
	writeEvaluation(json, "walls", walls);
	json.end();
	std::fputs(text.str().c_str(), stdout);
	return 0;
}

}  // namespace
}  // namespace ridgemap::apps

int main(int argc, char** argv)
{
	return ridgemap::apps::runProgram("ridgemap-eval", ridgemap::apps::run, argc, argv);
}
