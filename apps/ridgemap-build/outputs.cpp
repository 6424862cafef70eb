// SPDX-License-Identifier: BSD-3-Clause
#include "outputs.h"

#include <mrpt/opengl/CSetOfObjects.h>
#include <ridgemap/drawing.h>
#include <ridgemap/gz_archive.h>
#include <ridgemap/polyline_csv.h>
#include <ridgemap/scene_file.h>

#include <filesystem>

#include "../common/user_error.h"
#include "command_line.h"

namespace ridgemap::apps
{
namespace fs = std::filesystem;

namespace
{
constexpr const char* remedy = "choose another -o PREFIX, or make room there";
}  // namespace

Outputs::Outputs(const std::string& prefix, const std::set<std::string>& formats, const PictureContents& pictures)
	: prefix_(prefix), formats_(formats), pictures_(pictures)
{
	createDirectory();
	try
	{
		for (const std::string& path : paths()) AtomicFile probe(path);
		if (!wanted("measurements")) return;
		measurements_.emplace(pathOf("measurements"));
		writeMeasurementsCsvHeader(measurements_->stream());
	}
	catch (const std::exception& e)
	{
		if (!createdDirectory_.empty()) fs::remove(createdDirectory_);
		throw UserError(oneLine(e), remedy);
	}
}

Outputs::~Outputs()
{
	measurements_.reset();
	finished_.clear();
	std::error_code ignored;
	if (!createdDirectory_.empty()) fs::remove(createdDirectory_, ignored);  // fails if files were written to it
}

void Outputs::createDirectory()
{
	const fs::path directory = fs::path(prefix_).parent_path();
	std::error_code error;
	if (directory.empty() || fs::is_directory(directory, error)) return;
	if (fs::exists(directory, error)) throw UserError("'" + directory.string() + "' is not a directory", remedy);
	fs::create_directory(directory, error);
	if (error)
		throw UserError("cannot create the directory '" + directory.string() + "': " + error.message(),
						"create its parent, or choose another -o PREFIX");
	createdDirectory_ = directory.string();
}

std::string Outputs::pathOf(const std::string& format) const
{
	static const std::map<std::string, std::string> suffixes{{"ridgemap", ".ridgemap"},
															 {"ridges", "_ridges.csv"},
															 {"walls", "_walls.csv"},
															 {"measurements", "_measurements.csv"},
															 {"png", ".png"},
															 {"svg", ".svg"},
															 {"3dscene", ".3Dscene"},
															 {"stats", "_stats.json"},
															 {"ridge_vertices", "_ridge_vertices.csv"},
															 {"wall_vertices", "_wall_vertices.csv"},
															 {"removed", "_removed.csv"}};
	return prefix_ + suffixes.at(format);
}

std::vector<std::string> Outputs::paths() const
{
	std::vector<std::string> all;
	for (const std::string& format : allFormats())
		if (wanted(format)) all.push_back(pathOf(format));
	return all;
}

void Outputs::addMeasurement(const Measurement& m)
{
	if (measurements_) appendMeasurementCsv(measurements_->stream(), m);
}

void Outputs::keep(const std::string& format, const std::function<void(AtomicFile&)>& writer)
{
	if (!wanted(format)) return;
	AtomicFile file(pathOf(format));
	writer(file);
	file.finish();
	finished_.push_back(std::move(file));
}

void Outputs::writePictures(const CRidgeMap2D& map, const std::vector<std::vector<Point2>>& robotPaths,
							const std::string& title)
{
	if (!wanted("png") && !wanted("svg")) return;
	Drawing drawing;
	drawing.lines = map.walls();
	drawing.measurements = map.core().cellCentroids();
	drawing.paths = robotPaths;
	drawing.title = title;
	drawing.standardErrors = pictures_.standardErrors;
	if (pictures_.removed) drawing.cleared = map.core().clearedWalls();
	if (pictures_.free)
	{
		drawing.freeCells = map.core().freeCellCentres(map.options().freeSpaceLeast);
		drawing.freeCellEdge = 2 * map.options().sigma;
	}
	keep("svg", [&](AtomicFile& file) { writeSvg(file.stream(), drawing); });
	keep("png",
		 [&](AtomicFile& file)
		 {
			 const std::vector<std::uint8_t> bytes = encodePng(drawing);
			 file.stream().write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
		 });
}

void Outputs::writeScene(const CRidgeMap2D& map, const std::vector<std::vector<Point2>>& robotPaths)
{
	keep("3dscene",
		 [&](AtomicFile& file)
		 {
			 auto objects = mrpt::opengl::CSetOfObjects::Create();
			 map.getVisualizationInto(*objects);
			 if (!robotPaths.empty()) objects->insert(sceneLines(robotPaths, "robot path", {0xf0, 0x80, 0x18}, 1));
			 ridgemap::writeScene(file, {objects});
		 });
}

void Outputs::write(const CRidgeMap2D& map, const std::vector<std::vector<Point2>>& robotPaths,
					const std::string& title, const std::function<void(std::ostream&, const FileSizes&)>& writeStats,
					const std::optional<ResumePoint>& stoppedAt)
{
	try
	{
		keep("ridgemap",
			 [&](AtomicFile& file) { writeGzArchive(file, [&](mrpt::serialization::CArchive& out) { out << map; }); });
		keep("ridges", [&](AtomicFile& file) { writePolylinesCsv(file.stream(), map.ridges()); });
		keep("walls", [&](AtomicFile& file) { writePolylinesCsv(file.stream(), map.walls()); });
		keep("removed", [&](AtomicFile& file) { writePolylinesCsv(file.stream(), map.core().clearedWalls()); });
		const double sigma = map.options().sigma;
		keep("ridge_vertices", [&](AtomicFile& file) { writeVerticesCsv(file.stream(), map.ridges(), sigma); });
		keep("wall_vertices", [&](AtomicFile& file) { writeVerticesCsv(file.stream(), map.walls(), sigma); });
		if (measurements_)
		{
			measurements_->finish();
			finished_.push_back(std::move(*measurements_));
			measurements_.reset();
		}
		writePictures(map, robotPaths, title);
		writeScene(map, robotPaths);
		FileSizes sizes;
		for (const AtomicFile& file : finished_)
			sizes[fs::path(file.path()).filename().string()] = fs::file_size(file.temporaryPath());
		keep("stats", [&](AtomicFile& file) { writeStats(file.stream(), sizes); });
		if (stoppedAt)
		{
			AtomicFile file(resumePath(prefix_));
			writeResume(file, *stoppedAt, map);
			file.finish();
			finished_.push_back(std::move(file));
		}
		for (AtomicFile& file : finished_) file.commit();
		if (!stoppedAt) fs::remove(resumePath(prefix_));
	}
	catch (const std::exception& e)
	{
		throw UserError(oneLine(e), remedy);
	}
}

}  // namespace ridgemap::apps
