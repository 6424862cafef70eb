// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace ridgemap::apps
{
/** Polylines of one kind. */
struct Layer
{
	std::string name;
	std::vector<Polyline> lines;
};

/** Decimals of the coordinates in the files below [m]: micrometres. Written numbers are off by half of this at most. */
constexpr int writtenDecimals = 6;
constexpr double writtenStep = 1e-6;

/** Plain geometry in real size: one user unit is a metre, y up by one transform; closed lines are polygons. */
void writePlainSvg(std::ostream& out, const std::vector<Layer>& layers);
/** DXF as of AutoCAD R12, which every CAD program reads: one POLYLINE each on the layer of its kind, in metres; closed
 * lines carry the flag. */
void writeDxf(std::ostream& out, const std::vector<Layer>& layers);
/** A FeatureCollection without a coordinate system, in metres: LineString, or Polygon for closed lines, with the
 * properties `layer` and `closed`. */
void writeGeoJson(std::ostream& out, const std::vector<Layer>& layers);
/** One LINESTRING, or POLYGON for closed lines, a line. */
void writeWkt(std::ostream& out, const std::vector<Layer>& layers);
/** `layer,polyline,closed,x,y`; a closed line repeats its first point. */
void writeLayersCsv(std::ostream& out, const std::vector<Layer>& layers);

}  // namespace ridgemap::apps
