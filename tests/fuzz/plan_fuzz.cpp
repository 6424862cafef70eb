// SPDX-License-Identifier: BSD-3-Clause
// Building plans in DXF and GeoJSON, read by GDAL. The first byte chooses which, and whether a DXF file is made whole.
#include <ridgemap/CRidgeMap2D.h>

#include <cmath>
#include <stdexcept>

#include "../../apps/ridgemap-import/plan_readers.h"
#include "fuzz_target.h"
#include "text_input.h"

namespace ridgemap::fuzz
{
namespace
{
/** Group codes and values, one a line, as DXF has it; separated by blanks here. */
std::string dxf(std::string text)
{
	for (char& c : text)
		if (c == ' ') c = '\n';
	return text + "\n";
}

std::string dxfOf(const std::string& entities)
{
	return dxf("0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 ENTITIES " + entities + " 0 ENDSEC 0 EOF");
}
}  // namespace

std::vector<std::vector<std::uint8_t>> seeds()
{
	return {
		textSeed(0, dxfOf("0 LINE 8 walls 10 1 20 2 11 3 21 4")),
		textSeed(0, dxfOf("0 LWPOLYLINE 8 walls 90 3 70 1 10 0 20 0 42 0.5 10 5 20 0 10 5 20 5")),
		textSeed(0, dxfOf("0 ARC 8 a 10 1 20 1 40 2 50 10 51 200 0 CIRCLE 8 a 10 0 20 0 40 3 0 POINT 8 p 10 1 20 1")),
		textSeed(0, dxfOf("0 ELLIPSE 8 e 10 1 20 1 11 2 21 0 40 0.5 41 0 42 6.28 0 SPLINE 8 s 70 8 71 3 72 8 73 4 40 0 "
						  "40 0 40 0 40 0 40 1 40 1 40 1 40 1 10 0 20 0 10 1 20 1 10 2 20 0 10 3 20 1")),
		textSeed(0,
				 dxf("0 SECTION 2 BLOCKS 0 BLOCK 8 0 2 door 70 0 10 0 20 0 0 LINE 8 0 10 0 20 0 11 1 21 0 0 ENDBLK 0 "
					 "ENDSEC 0 SECTION 2 ENTITIES 0 INSERT 8 walls 2 door 10 5 20 5 41 2 42 2 50 30 0 ENDSEC 0 EOF")),
		// GDAL 3.6 waits for ever behind this.
		textSeed(2, dxf("0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2") + "ENTITIES\r"),
		textSeed(2, dxf("0 SECTION 2 ENTITIES 0 LINE 8 walls 10 1 20 2 11 3 21 4 0 EOF") + "\r"),
		textSeed(1, R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"Layer":"walls"},)"
					R"("geometry":{"type":"LineString","coordinates":[[0,0],[1,2],[3e2,-4.5]]}}]})"),
		textSeed(1, R"({"type":"Feature","properties":null,"geometry":{"type":"GeometryCollection","geometries":[)"
					R"({"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,0]],[[1,1],[2,1],[2,2],[1,1]]]},)"
					R"({"type":"MultiLineString","coordinates":[[[0,0],[1,1]],[[2,2],[3,3,3]]]},)"
					R"({"type":"Point","coordinates":[1,2]}]}})")};
}
}  // namespace ridgemap::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
	using namespace ridgemap;
	if (size == 0) return 0;
	std::string text(data + 1, data + size);
	const bool isDxf = data[0] % 2 == 0;
	if (isDxf && (data[0] & 2) == 0) text += "\n0\nEOF\n";  // else few would get as far as GDAL
	static const fuzz::ScratchFile files[] = {fuzz::ScratchFile(".dxf"), fuzz::ScratchFile(".geojson")};
	try
	{
		const std::string& path = files[isDxf ? 0 : 1].with(text);
		const apps::Plan plan = isDxf ? apps::readDxf(path, {}) : apps::readGeoJson(path, {});
		fuzz::require(std::isfinite(plan.metresPerUnit) && plan.metresPerUnit > 0, "units have a size");
		for (const Polyline& line : plan.lines) fuzz::require(line.points.size() >= 2, "lines have two points");
		const CRidgeMap2D map = CRidgeMap2D::fromPolylines(plan.lines);
		for (const Polyline& line : map.walls())
			for (const Point2& p : line.points)
				fuzz::require(std::isfinite(p.x) && std::isfinite(p.y), "maps are finite");
	}
	catch (const std::exception& e)
	{
		fuzz::require(*e.what() != 0, "errors have a message");
	}
	return 0;
}
