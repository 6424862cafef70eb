// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace ridgemap
{
/** What a picture of a map shows, map frame [m]. Everything but the lines may be left empty. */
struct Drawing
{
	std::vector<Polyline> lines;             ///< walls or ridges: crisp dark lines
	std::vector<Point2> measurements;        ///< faint dots beneath the lines
	std::vector<std::vector<Point2>> paths;  ///< robot paths: thin orange lines
	std::vector<Polyline> cleared;           ///< what rays passed through, not part of the map: red lines
	std::vector<Point2> freeCells;           ///< centres of cells known to be free: shaded
	double freeCellEdge = 0;                 ///< their edge [m]
	/** Lines coloured by the standard errors of their vertices, with a scale below, instead of dark. */
	bool standardErrors = false;
	std::string title;      ///< one line of UTF-8 above the picture
	int longerSide = 2000;  ///< longer side of the map in the picture [pixels], 100 .. 8000
};

/** Writes the picture as SVG: the map in metres (y up, by one transform), axes in metres, a scale bar, a legend.
 * Measurements that fall on the same pixel are written once. */
void writeSvg(std::ostream& out, const Drawing& drawing);

/** The same into a file that appears complete or not at all. Throws std::runtime_error naming the path and the cause.
 */
void writeSvg(const std::string& path, const Drawing& drawing);

/** The same picture as the bytes of a PNG file. */
std::vector<std::uint8_t> encodePng(const Drawing& drawing);

/** The same into a file that appears complete or not at all. Throws std::runtime_error naming the path and the cause.
 */
void writePng(const std::string& path, const Drawing& drawing);

}  // namespace ridgemap
