// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <set>
#include <string>
#include <vector>

namespace ridgemap::apps
{
/** Lines of a plan and the size of its unit. */
struct Plan
{
	std::vector<Polyline> lines;  ///< y up, in units of the plan
	double metresPerUnit = 1;     ///< as the file says; 1 if it does not
	std::size_t leftOut = 0;      ///< things that are no lines, such as points and text
};

/** Reads the lines and outlines of a DXF file in text form by GDAL's OGR, curves as short segments. Only those on the
 * given layers, or all if none is given. Throws UserError naming the file, also if it was cut off. */
Plan readDxf(const std::string& path, const std::set<std::string>& layers);

/** The same for GeoJSON. */
Plan readGeoJson(const std::string& path, const std::set<std::string>& layers);

/** Reads path, polyline, polygon, line and rect elements of an SVG file with their transforms. A page with a physical
 * size gives the unit. Layers are the ids of groups. Throws UserError naming the file. */
Plan readSvg(const std::string& path, const std::set<std::string>& layers);

/** Reads the path data of SVG, curves as short segments; y as in the file. Throws std::invalid_argument for what it
 * does not know (arcs). */
std::vector<Polyline> parseSvgPath(const std::string& data);

/** All numbers of a list separated by blanks and commas. Throws std::invalid_argument for anything else. */
std::vector<double> parseNumbers(const std::string& text);

}  // namespace ridgemap::apps
