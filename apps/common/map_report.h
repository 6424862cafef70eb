// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/CRidgeMap2D.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "json_writer.h"

namespace ridgemap::apps
{
/** Figures of a set of polylines. */
struct PolylineFigures
{
	std::size_t polylines = 0;
	std::size_t closed = 0;  ///< of these, closed loops
	std::size_t nodes = 0;
	double metres = 0;
};
PolylineFigures figuresOf(const std::vector<Polyline>& polylines);

/** Writes all options as an object `options`. */
void writeOptions(JsonWriter& json, const MapOptions& options);

/** Writes the figures of the map (measurements, cells, polylines, bounding box, ends by reason) as an object `map`. */
void writeFigures(JsonWriter& json, const CRidgeMap2D& map);

/** Counts by the names of the reasons, those that occur. */
void writeStops(JsonWriter& json, const std::string& key,
				const std::array<std::size_t, std::size_t(StopReason::count_)>& stops);

/** A number of bytes for people: `12.3 MB`. */
std::string humanBytes(double bytes);

/** The line of a summary on the terminal that names a file which was written, and its size. */
void printWritten(const std::string& path);

}  // namespace ridgemap::apps
