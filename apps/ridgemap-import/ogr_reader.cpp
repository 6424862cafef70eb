// SPDX-License-Identifier: BSD-3-Clause
#include <ogrsf_frmts.h>

#include <map>
#include <memory>

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

/** Metres of a unit of a DXF file, which OGR does not tell: the value behind $INSUNITS. */
double dxfUnit(const std::string& path)
{
	static const std::map<std::string, double> units{{"1", 0.0254}, {"2", 0.3048}, {"4", 0.001}, {"5", 0.01}, {"6", 1}};
	GzInput input(path);
	int after = 0;  // lines behind the name: group code, value
	for (std::string line; input.readLine(line);)
	{
		const auto first = line.find_first_not_of(" \t");
		const std::string word = first == std::string::npos ? "" : line.substr(first);
		if (after == 2)
		{
			const auto unit = units.find(word);
			return unit == units.end() ? 1 : unit->second;
		}
		if (after > 0 || word == "$INSUNITS") after++;
		if (word == "ENTITIES") break;
	}
	return 1;
}
}  // namespace

Plan readOgr(const std::string& path, const std::set<std::string>& layers)
{
	GzInput readable(path);
	GDALAllRegister();
	const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
	CPLErrorReset();
	// Others take files of any name, too, and some of them open what these files name: other files, or servers.
	const char* const drivers[] = {"DXF", "GeoJSON", nullptr};
	const std::unique_ptr<GDALDataset> data(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR, drivers));
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
	if (std::string(data->GetDriverName()) == "DXF") plan.metresPerUnit = dxfUnit(path);
	return plan;
}

}  // namespace ridgemap::apps
