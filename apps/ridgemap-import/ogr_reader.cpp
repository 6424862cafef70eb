// SPDX-License-Identifier: BSD-3-Clause
#include <ogrsf_frmts.h>

#include <algorithm>
#include <map>
#include <memory>
#include <sstream>

#include "../common/gz_input.h"
#include "../common/user_error.h"
#include "plan_readers.h"

namespace ridgemap::apps
{
namespace
{
void addLine(const OGRSimpleCurve& curve, Plan& plan)
{
	Polyline line;
	for (int i = 0; i < curve.getNumPoints(); i++) line.points.push_back({curve.getX(i), curve.getY(i)});
	if (line.points.size() < 2) return;
	line.closed = line.points.size() > 3 && line.points.front() == line.points.back();
	plan.lines.push_back(std::move(line));
}

void addGeometry(const OGRGeometry& geometry, Plan& plan)
{
	switch (wkbFlatten(geometry.getGeometryType()))
	{
		case wkbLineString:
			return addLine(*geometry.toLineString(), plan);
		case wkbPolygon:
			for (const OGRLinearRing* ring : *geometry.toPolygon()) addLine(*ring, plan);
			return;
		case wkbMultiLineString:
		case wkbMultiPolygon:
		case wkbGeometryCollection:
			for (const OGRGeometry* part : *geometry.toGeometryCollection()) addGeometry(*part, plan);
			return;
		default:
			plan.leftOut++;
	}
}

bool isWanted(const OGRFeature& feature, const std::string& ogrLayer, const std::set<std::string>& layers)
{
	if (layers.empty() || layers.count(ogrLayer) != 0) return true;
	const int field = feature.GetFieldIndex("Layer");  // in upper or lower case
	return field >= 0 && layers.count(feature.GetFieldAsString(field)) != 0;
}

/** A DXF file in memory, with line feeds alone between its lines: behind a carriage return at the end of a file, GDAL
 * 3.6 waits for ever. GDAL takes what there is of a file that was cut off, but here it must be whole. */
class DxfFile
{
 public:
	explicit DxfFile(const std::string& path)
	{
		GzInput input(path);
		for (std::string line; input.readLine(line);) text_ += line + "\n";
		std::replace(text_.begin(), text_.end(), '\r', '\n');
		std::istringstream words(text_);
		std::string word, last;
		while (words >> word) last = word;
		if (last != "EOF")
			throw UserError("'" + path + "' is cut off, or not a DXF file: it does not end with EOF",
							"export it again, as a DXF file in text form");
		VSIFCloseL(VSIFileFromMemBuffer(name, reinterpret_cast<GByte*>(text_.data()), text_.size(), FALSE));
	}
	~DxfFile() { VSIUnlink(name); }
	DxfFile(const DxfFile&) = delete;
	DxfFile& operator=(const DxfFile&) = delete;

	static constexpr const char* name = "/vsimem/ridgemap-import.dxf";

	/** Metres of its unit, which OGR does not tell: the value behind $INSUNITS. */
	double unit() const
	{
		static const std::map<std::string, double> units{
			{"1", 0.0254}, {"2", 0.3048}, {"4", 0.001}, {"5", 0.01}, {"6", 1}};
		std::istringstream words(text_);
		for (std::string word; words >> word && word != "ENTITIES";)
			if (word == "$INSUNITS" && words >> word && words >> word)
			{
				const auto unit = units.find(word);
				return unit == units.end() ? 1 : unit->second;
			}
		return 1;
	}

 private:
	std::string text_;
};

/** @param name what GDAL is to open, that which `path` names or a copy of it */
Plan read(const char* name, const char* driver, const std::string& path, const std::set<std::string>& layers)
{
	GDALAllRegister();
	const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
	CPLErrorReset();
	// Other drivers take files of any name, too, and some of them open what these files name: other files, or servers.
	const char* const drivers[] = {driver, nullptr};
	const std::unique_ptr<GDALDataset> data(GDALDataset::Open(name, GDAL_OF_VECTOR, drivers));
	const std::string cause = CPLGetLastErrorMsg();
	if (!data)
		throw UserError("'" + path + "' cannot be read" + (cause.empty() ? "" : ": " + cause),
						"give a .dxf or .geojson file");
	Plan plan;
	for (OGRLayer* layer : data->GetLayers())
		for (const auto& feature : *layer)
		{
			if (!isWanted(*feature, layer->GetName(), layers)) continue;
			const OGRGeometry* geometry = feature->GetGeometryRef();
			if (!geometry) continue;
			const std::unique_ptr<OGRGeometry> straight(geometry->getLinearGeometry());
			addGeometry(*straight, plan);
		}
	return plan;
}
}  // namespace

Plan readDxf(const std::string& path, const std::set<std::string>& layers)
{
	const DxfFile file(path);
	Plan plan = read(DxfFile::name, "DXF", path, layers);
	plan.metresPerUnit = file.unit();
	return plan;
}

Plan readGeoJson(const std::string& path, const std::set<std::string>& layers)
{
	const GzInput readable(path);
	return read(path.c_str(), "GeoJSON", path, layers);
}

}  // namespace ridgemap::apps
