// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/poses/CPose3D.h>
#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/atomic_file.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "../common/help_output.h"
#include "../common/map_report.h"
#include "../common/number_line.h"
#include "../common/scene.h"
#include "../common/user_error.h"
#include "../ridgemap-build/inputs.h"
#include "places.h"
#include "report.h"

namespace ridgemap::apps
{
namespace
{
constexpr const char* description =
	"Builds a ridge map, occupancy grids of 5, 2 and 1 cm and a points map from the scans of INPUT (.simplemap or "
	".rawlog) "
	"at the same poses, measures all of them the same way, and writes DIR/report.html and DIR/report.json.";

struct CommandLine
{
	std::string input, secondPass, truth, directory;
	double rotation = 17, sigma = Options().sigma;
	std::size_t folds = 5;
	PoseChoice poses;
};

std::vector<Segment> readTurnedTruth(const CommandLine& c)
{
	if (c.truth.empty()) return {};
	std::vector<Segment> truth = readTruth(c.truth);
	const mrpt::poses::CPose3D pose = turnBy(c.rotation);
	const auto turn = [&](const Point2& p)
	{
		Point2 out;
		double height = 0;
		pose.composePoint(p.x, p.y, 0, out.x, out.y, height);
		return out;
	};
	for (Segment& s : truth)
	{
		s.a = turn(s.a);
		s.b = turn(s.b);
	}
	return truth;
}

Picture draw(const Contestant& map, const std::string& name, const Box2& box, int pixels,
			 const std::vector<Segment>& truth)
{
	View view;
	view.box = box;
	view.scale = pixels / (box.max.x - box.min.x);
	cv::Mat picture(std::max(1, int((box.max.y - box.min.y) * view.scale)), pixels, CV_8UC3, cv::Scalar::all(255));
	map.draw(picture, view);
	for (const Segment& s : truth)
		cv::line(picture, cv::Point(cv::Point2d(view.px(s.a.x), view.py(s.a.y)) * 16),
				 cv::Point(cv::Point2d(view.px(s.b.x), view.py(s.b.y)) * 16), cv::Scalar(27, 71, 200), 1, cv::LINE_AA,
				 4);
	Picture out{name, {}};
	cv::imencode(".png", picture, out.png);
	return out;
}

/** A part of the map that is drawn of every contestant. */
struct Place
{
	std::string title;
	Box2 box;
	int pixels;
	bool withTruth;
};

std::vector<Place> placesOf(const CRidgeMap2D& map, const std::vector<Segment>& truth)
{
	std::vector<Place> places{{"The whole map", grown(map.box(), 0.5), 640, false}};
	const bool known = !truth.empty();
	const std::string red = known ? ", the truth in red" : "";
	if (const auto corner = sharpestCorner(map))
		places.push_back({"A corner, 1 m wide" + red, around(*corner, 0.5), 400, known});
	if (const auto thin = thinnestWall(map, truth))
		places.push_back({"Two close surfaces, 1 m wide" + red, around(*thin, 0.5), 400, known});
	return places;
}

std::string fileName(const std::string& path)
{
	return std::filesystem::path(path).filename().string();
}

Report compare(const CommandLine& c)
{
	Scans scans = readScans(c.input, c.poses, c.rotation);
	MapOptions options;
	options.creation.sigma = c.sigma;
	options.validate();
	Report report;
	report.input = fileName(c.input);
	report.truth = fileName(c.truth);
	report.secondPass = fileName(c.secondPass);
	report.scans = scans.all.size();
	report.fromClouds = scans.fromClouds;
	report.folds = c.folds;
	report.rotation = c.rotation;
	report.sigma = c.sigma;
	Material material{std::move(scans.all), {}, readTurnedTruth(c), c.folds};
	if (!c.secondPass.empty()) material.secondPass = readScans(c.secondPass, c.poses, c.rotation).all;
	const Surroundings around{grown(boxOf(material.scans), 1), scans.fromClouds > 0};
	std::vector<Place> places;
	for (const ContestantKind& kind : contestantKinds(options, around))
	{
		std::fprintf(stderr, "measuring %s\n", kind.name.c_str());
		const Measured measured = measure(kind, material);
		report.figures.push_back(measured.figures);
		if (places.empty())  // the ridge map is the first
		{
			places = placesOf(dynamic_cast<const CRidgeMap2D&>(measured.map->map()), material.truth);
			for (const Place& place : places) report.rows.push_back({place.title, {}});
		}
		for (std::size_t i = 0; i < places.size(); i++)
		{
			const Place& place = places[i];
			report.rows[i].pictures.push_back(draw(*measured.map, kind.name, place.box, place.pixels,
												   place.withTruth ? material.truth : std::vector<Segment>()));
		}
	}
	return report;
}

double numberOf(TCLAP::ValueArg<std::string>& arg, double otherwise, double least, double most)
{
	if (!arg.isSet()) return otherwise;
	const auto v = parseNumber(arg.getValue());
	if (v && *v >= least && *v <= most) return *v;
	char range[80];
	std::snprintf(range, sizeof(range), "give a number from %g to %g", least, most);
	throw UserError("wrong value '" + arg.getValue() + "' of --" + arg.getName(), range);
}

std::optional<CommandLine> parse(int argc, char** argv)
{
	HelpOutput output("ridgemap-compare", "INPUT -o DIR");
	TCLAP::CmdLine cmd(description, ' ', RIDGEMAP_VERSION);
	using Text = TCLAP::ValueArg<std::string>;
	TCLAP::UnlabeledMultiArg<std::string> inputs("INPUT", "Scans with poses", false, "INPUT", cmd);
	TCLAP::SwitchArg odometry("", "odometry", "Poses of a rawlog from its odometry", cmd);
	Text second("", "second-pass", "Scans with poses to be localised in the maps (default: scans held out)", false, "",
				"FILE", cmd);
	Text poses("", "poses", "Poses of a rawlog; see ridgemap-build", false, "", "FILE", cmd);
	Text folds("", "folds", "Maps built without one scan in N, to see how the others fit; 0: none (default: 5)", false,
			   "", "N", cmd);
	Text rotate("", "rotate", "Turn all poses, in degrees, so that no wall is along a grid (default: 17)", false, "",
				"DEG", cmd);
	Text sigma("", "sigma", "Smoothing parameter of the ridge map in metres", false, "", "M", cmd);
	Text truth("", "truth", "True surface: lines 'x1,y1,x2,y2[,seen]'", false, "", "FILE", cmd);
	Text directory("o", "output", "Directory for the report", false, "", "DIR", cmd);
	cmd.setOutput(&output);
	if (!cmd.parse(argc, argv)) return std::nullopt;
	rejectUnknownOptions(inputs.getValue(), "ridgemap-compare");
	if (inputs.getValue().size() != 1) throw UserError("there must be one input", "name one file, or see --help");
	if (!directory.isSet()) throw UserError("no output", "give -o DIR, or see --help");
	CommandLine c;
	c.input = inputs.getValue().front();
	c.directory = directory.getValue();
	c.truth = truth.getValue();
	c.secondPass = second.getValue();
	c.sigma = numberOf(sigma, c.sigma, 1e-4, 100);
	c.rotation = numberOf(rotate, c.rotation, -360, 360);
	c.folds = std::size_t(numberOf(folds, double(c.folds), 0, 100));
	if (c.folds == 1) throw UserError("--folds 1 leaves no scan to build from", "give 0, or 2 and more");
	c.poses.odometry = odometry.getValue();
	if (poses.isSet()) c.poses.track = std::make_shared<PoseTrack>(readPoseTrack(poses.getValue()));
	return c;
}

int run(int argc, char** argv)
{
	const auto c = parse(argc, argv);
	if (!c) return 0;
	std::filesystem::create_directories(c->directory);
	AtomicFile html(c->directory + "/report.html"), json(c->directory + "/report.json");
	const Report report = compare(*c);
	writeHtml(html.stream(), report);
	writeJson(json.stream(), report);
	html.finish();
	json.finish();
	html.commit();
	json.commit();
	printTable(report);
	printWritten(html.path());
	printWritten(json.path());
	return 0;
}

}  // namespace
}  // namespace ridgemap::apps

int main(int argc, char** argv)
{
	return ridgemap::apps::runProgram("ridgemap-compare", ridgemap::apps::run, argc, argv);
}
