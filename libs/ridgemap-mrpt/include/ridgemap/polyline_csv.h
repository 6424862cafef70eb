// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace ridgemap
{
/** Writes polylines as CSV: header `polyline,x,y`, one node a line, polylines counted from 0, metres with 17
 * significant digits, which give back the same doubles. A closed polyline repeats its first node. */
void writePolylinesCsv(std::ostream& out, const std::vector<Polyline>& polylines);

/** The same into a file that appears complete or not at all. Throws std::runtime_error naming the path and the cause.
 */
void writePolylinesCsv(const std::string& path, const std::vector<Polyline>& polylines);

/** Writes what is known of every node, in the order of writePolylinesCsv(): header
 * `polyline,x,y,occupancy,noise,standard_error,half_width_95` with occupancy in kernels and the rest in metres: noise
 * of the measurements across the wall, VertexInfo::standardError, half width of the 95 % interval of the place (on
 * ridges see ridgeUncertainty()). Fields of which nothing is known stay empty.
 * @param sigma smoothing parameter of the map [m]. */
void writeVerticesCsv(std::ostream& out, const std::vector<Polyline>& polylines, double sigma);

/** Writes the header `x,y,sensorX,sensorY` of a CSV of measurements, which ridgemap-build reads again. */
void writeMeasurementsCsvHeader(std::ostream& out);

/** Appends one line in metres with 17 significant digits; a sensor position that is not known stays empty. */
void appendMeasurementCsv(std::ostream& out, const Measurement& m);

}  // namespace ridgemap
