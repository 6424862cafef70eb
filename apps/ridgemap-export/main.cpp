// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/atomic_file.h>
#include <ridgemap/drawing.h>
#include <ridgemap/gz_archive.h>
#include <ridgemap/observation_to_measurements.h>
#include <ridgemap/scene_file.h>
#include <ridgemap/simplify.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>

#include "../common/geometry_files.h"
#include "../common/help_output.h"
#include "../common/map_file.h"
#include "../common/map_report.h"
#include "../common/number_line.h"
#include "../common/user_error.h"
#include "../ridgemap-build/inputs.h"
#include "grid_image.h"

namespace ridgemap::apps
{
namespace
{
constexpr const char* description =
	"Writes the walls of a ridge map for other programs. The extension of FILE says how: .svg (plain geometry in real "
	"size), .dxf (metres, one layer a kind), .geojson, .csv, .wkt, .3Dscene, .png, .gridmap or .gridmap.gz "
	"(COccupancyGridMap2D of MRPT), .yaml (map of ROS, with its .pgm beside it), or, with --frozen, .ridgemap.";

struct CommandLine
{
	std::string map, output, freeSpace;
	double tolerance = 0, resolution = 0.05;
	bool ridges = false, frozen = false, quiet = false;
	PoseChoice poses;
};

double parseLength(TCLAP::ValueArg<std::string>& arg, double otherwise, bool zero)
{
	if (!arg.isSet()) return otherwise;
	const auto value = parseNumber(arg.getValue());
	if (!value || !std::isfinite(*value) || *value < 0 || (*value == 0 && !zero))
		throw UserError("wrong value '" + arg.getValue() + "' of --" + arg.getName(), "give a length in metres");
	return *value;
}

bool endsWith(const std::string& s, const std::string& end)
{
	return s.size() > end.size() && s.compare(s.size() - end.size(), end.size(), end) == 0;
}

/** The layers to write: walls, simplified, and ridges if wanted. */
std::vector<Layer> layersOf(const CRidgeMap2D& map, const CommandLine& c)
{
	// Coordinates are rounded when written; the bound holds for what is in the file.
	const double tolerance = std::max(0.0, c.tolerance - writtenStep);
	std::vector<Layer> layers{{"walls", map.simplified(tolerance)}};
	if (c.ridges) layers.push_back({"ridges", simplified(map.ridges(), tolerance)});
	return layers;
}

std::vector<Polyline> allLines(const std::vector<Layer>& layers)
{
	std::vector<Polyline> lines;
	for (const Layer& layer : layers) lines.insert(lines.end(), layer.lines.begin(), layer.lines.end());
	return lines;
}

/** Marks what the rays of the observations passed, up to a little before their ends. */
void markFreeSpace(GridImage& grid, const CRidgeMap2D& map, const CommandLine& c)
{
	const double before = std::max(grid.resolution(), 2 * map.options().sigma);
	const auto reader = openReader(c.freeSpace, c.poses);
	std::size_t rays = 0;
	for (Frame frame; reader->next(frame);)
	{
		if (frame.observation && frame.pose && canConvertToMeasurements(*frame.observation))
			frame.points = observationToMeasurements(*frame.observation, *frame.pose, map.insertionOptions);
		for (const Measurement& m : frame.points)
		{
			const double dx = m.x - m.sensorX, dy = m.y - m.sensorY, length = std::hypot(dx, dy);
			if (!(length > before)) continue;
			const double t = 1 - before / length;
			grid.mark({m.sensorX, m.sensorY}, {m.sensorX + t * dx, m.sensorY + t * dy}, GridImage::Cell::free);
			rays++;
		}
	}
	if (rays == 0)
		throw UserError("'" + c.freeSpace + "' holds no rays", "give observations with poses, such as a .simplemap");
}

GridImage gridOf(const CRidgeMap2D& map, const CommandLine& c)
{
	const std::vector<Polyline> lines = allLines(layersOf(map, c));
	Box2 box = map.box();
	for (const Polyline& line : lines)
		for (const Point2& p : line.points) box.extend(p);
	if (box.empty()) box.extend(Point2{0, 0});
	GridImage grid(box, c.resolution);
	for (const Polyline& line : lines)
		for (std::size_t i = 1; i < line.points.size(); i++)
			grid.mark(line.points[i - 1], line.points[i], GridImage::Cell::occupied);
	if (!c.freeSpace.empty())
		markFreeSpace(grid, map, c);
	else if (map.core().passedAnywhere())
		grid.markFree([&](const Point2& p) { return map.core().passes(p) > map.options().freeSpaceLeast; });
	return grid;
}

void writeSceneFile(const std::string& path, const std::vector<Layer>& layers)
{
	std::vector<mrpt::opengl::CRenderizable::Ptr> objects;
	for (const Layer& layer : layers)
		objects.push_back(sceneLines(layer.lines, layer.name.c_str(), {0x10, 0x20, 0x60}, 2));
	AtomicFile file(path);
	writeScene(file, objects);
	file.commit();
}

using Writer = std::function<void(const CRidgeMap2D&, const CommandLine&)>;

Writer textWriter(void (*write)(std::ostream&, const std::vector<Layer>&))
{
	return [write](const CRidgeMap2D& map, const CommandLine& c)
	{
		AtomicFile file(c.output);
		write(file.stream(), layersOf(map, c));
		file.commit();
	};
}

void writePicture(const CRidgeMap2D& map, const CommandLine& c)
{
	Drawing drawing;
	drawing.lines = allLines(layersOf(map, c));
	drawing.title = std::filesystem::path(c.map).filename().string();
	writePng(c.output, drawing);
}

void writeFrozenMap(const CRidgeMap2D& map, const CommandLine& c)
{
	CRidgeMap2D frozen = map;
	frozen.freeze(std::max(0.0, c.tolerance - writtenStep));
	saveRidgeMap(c.output, frozen);
}

const std::map<std::string, Writer>& writers()
{
	static const auto gridWriter = [](const CRidgeMap2D& map, const CommandLine& c)
	{ gridOf(map, c).writeGridMap(c.output); };
	static const std::map<std::string, Writer> all{
		{".svg", textWriter(writePlainSvg)},
		{".dxf", textWriter(writeDxf)},
		{".geojson", textWriter(writeGeoJson)},
		{".csv", textWriter(writeLayersCsv)},
		{".wkt", textWriter(writeWkt)},
		{".3dscene", [](const CRidgeMap2D& map, const CommandLine& c) { writeSceneFile(c.output, layersOf(map, c)); }},
		{".png", writePicture},
		{".gridmap", gridWriter},
		{".gridmap.gz", gridWriter},
		{".yaml", [](const CRidgeMap2D& map, const CommandLine& c) { gridOf(map, c).writeRosMap(c.output); }},
		{".ridgemap", writeFrozenMap}};
	return all;
}

Writer writerFor(const CommandLine& c)
{
	std::string name = std::filesystem::path(c.output).filename().string();
	for (char& letter : name)
		if (letter >= 'A' && letter <= 'Z') letter = char(letter - 'A' + 'a');
	for (const auto& [extension, writer] : writers())
		if (endsWith(name, extension))
		{
			const bool isMap = extension == ".ridgemap", isGrid = extension[1] == 'g' && extension[2] == 'r';
			if (isMap != c.frozen)
				throw UserError(c.frozen ? "--frozen makes a ridge map" : "a .ridgemap is written of frozen maps only",
								c.frozen ? "give -o FILE.ridgemap" : "give --frozen, or another extension");
			if (!c.freeSpace.empty() && !isGrid && extension != ".yaml")
				throw UserError("--free-space is for grids", "give -o FILE.gridmap.gz or FILE.yaml");
			return writer;
		}
	std::string known;
	for (const auto& entry : writers()) known += (known.empty() ? "" : ", ") + entry.first;
	throw UserError("'" + c.output + "' has an unknown extension", "choose from " + known);
}

std::optional<CommandLine> parse(int argc, char** argv)
{
	HelpOutput output("ridgemap-export", "MAP.ridgemap -o FILE");
	TCLAP::CmdLine cmd(description, ' ', RIDGEMAP_VERSION);
	using Text = TCLAP::ValueArg<std::string>;
	TCLAP::UnlabeledMultiArg<std::string> maps("MAP", "Map to export", false, "MAP.ridgemap", cmd);
	TCLAP::SwitchArg quiet("q", "quiet", "No summary", cmd);
	TCLAP::SwitchArg odometry("", "odometry", "Poses of a rawlog of --free-space from its odometry", cmd);
	Text poses("", "poses", "Poses of a rawlog of --free-space; see ridgemap-build", false, "", "FILE", cmd);
	Text freeSpace(
		"", "free-space",
		"Observations with poses (.simplemap, .rawlog, or .csv of x,y,sensorX,sensorY): cells of a grid that "
		"their rays pass are free (default: where rays passed as the map itself has counted)",
		false, "", "FILE", cmd);
	Text resolution("", "resolution", "Edge of a cell of a grid in metres (default: 0.05)", false, "", "M", cmd);
	TCLAP::SwitchArg frozen("", "frozen", "Write a map without measurements, for localisation: -o FILE.ridgemap", cmd);
	TCLAP::SwitchArg ridges("", "ridges", "Write the strict ridges, too, on a layer of their own", cmd);
	Text tolerance("", "tolerance",
				   "Use the fewest vertices that keep lines and walls within this distance of each other in both "
				   "directions, in metres; junctions and ends stay (default: all vertices)",
				   false, "", "M", cmd);
	Text file("o", "output", "File to write", false, "", "FILE", cmd);
	cmd.setOutput(&output);
	if (!cmd.parse(argc, argv)) return std::nullopt;
	rejectUnknownOptions(maps.getValue(), "ridgemap-export");
	if (maps.getValue().size() != 1) throw UserError("there must be one map", "name one .ridgemap file, or see --help");
	if (!file.isSet()) throw UserError("no output", "give -o FILE, or see --help");
	CommandLine c;
	c.map = maps.getValue().front();
	c.output = file.getValue();
	c.freeSpace = freeSpace.getValue();
	c.tolerance = parseLength(tolerance, 0, true);
	c.resolution = parseLength(resolution, c.resolution, false);
	c.ridges = ridges.getValue();
	c.frozen = frozen.getValue();
	c.quiet = quiet.getValue();
	c.poses.odometry = odometry.getValue();
	if (poses.isSet()) c.poses.track = std::make_shared<PoseTrack>(readPoseTrack(poses.getValue()));
	if (c.frozen && c.ridges) throw UserError("a frozen map holds walls only", "leave out --ridges");
	return c;
}

/** Looks at walls and result anew, without knowing how the result was made. */
double verifiedDeviation(const CRidgeMap2D& map, const CommandLine& c, const std::vector<Polyline>& walls)
{
	constexpr double step = 0.01, rounding = 1e-9;
	const double deviation = greatestDeviation(map.walls(), walls, step);
	if (deviation > c.tolerance + rounding)
		throw std::logic_error("a line is " + std::to_string(deviation) +
							   " m off its wall; please report this as a bug");
	return deviation;
}

int run(int argc, char** argv)
{
	const auto c = parse(argc, argv);
	if (!c) return 0;
	const Writer write = writerFor(*c);
	const CRidgeMap2D map = loadMap(c->map);
	const std::vector<Polyline> walls = layersOf(map, *c).front().lines;
	const double deviation = verifiedDeviation(map, *c, walls);
	write(map, *c);
	if (c->quiet) return 0;
	const PolylineFigures before = figuresOf(map.walls()), after = figuresOf(walls);
	// Without a tolerance, walls that meet get their junction as a vertex.
	const std::string of = c->tolerance > 0 ? " of " + std::to_string(before.nodes) : "";
	std::printf("walls         %zu polylines (%zu closed), %zu%s vertices, at most %.3f mm off\n", after.polylines,
				after.closed, after.nodes, of.c_str(), deviation * 1000);
	printWritten(c->output);
	return 0;
}

}  // namespace
}  // namespace ridgemap::apps

int main(int argc, char** argv)
{
	return ridgemap::apps::runProgram("ridgemap-export", ridgemap::apps::run, argc, argv);
}
