// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/CSerializable.h>
#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/atomic_file.h>
#include <ridgemap/drawing.h>
#include <ridgemap/gz_archive.h>
#include <ridgemap/one_line.h>
#include <ridgemap/polyline_csv.h>
#include <ridgemap/scene_file.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace ridgemap
{
namespace
{
void saveScene(const CRidgeMap2D& map, const std::string& path)
{
	auto objects = mrpt::opengl::CSetOfObjects::Create();
	map.getVisualizationInto(*objects);
	AtomicFile file(path);
	writeScene(file, {objects});
	file.commit();
}
}  // namespace

void CRidgeMap2D::saveMetricMapRepresentationToFile(const std::string& filNamePrefix) const
{
	writePolylinesCsv(filNamePrefix + "_ridges.csv", ridges());
	writePolylinesCsv(filNamePrefix + "_walls.csv", walls());
	Drawing drawing;
	drawing.lines = walls();
	drawing.measurements = core().cellCentroids();
	writeSvg(filNamePrefix + ".svg", drawing);
	saveScene(*this, filNamePrefix + ".3Dscene");
}

CRidgeMap2D loadRidgeMap(const std::string& path)
{
	if (!std::ifstream(path)) throw std::runtime_error("cannot open '" + path + "': " + std::strerror(errno));
	try
	{
		mrpt::io::CFileGZInputStream file(path);
		auto archive = mrpt::serialization::archiveFrom(file);
		const auto object = archive.ReadObject();
		auto* map = dynamic_cast<CRidgeMap2D*>(object.get());
		if (!map) throw std::runtime_error("the file holds something else than a ridge map");
		return std::move(*map);
	}
	catch (const std::exception& e)
	{
		throw std::runtime_error("cannot read a ridge map from '" + path + "': " + oneLine(e));
	}
}

void saveRidgeMap(const std::string& path, const CRidgeMap2D& map)
{
	AtomicFile file(path);
	writeGzArchive(file, [&](mrpt::serialization::CArchive& out) { out << map; });
	file.commit();
}

}  // namespace ridgemap
