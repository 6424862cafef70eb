// SPDX-License-Identifier: BSD-3-Clause
#include "map_report.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace ridgemap::apps
{
namespace
{
/** An option keeps its type in JSON: number, truth value or text. */
void writeOption(JsonWriter& json, const std::string& key, const std::string& text)
{
	double number = 0;
	const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), number);
	const bool isColor = key.find("Color") != std::string::npos;  // hexadecimal digits
	if (!isColor && error == std::errc() && at == text.data() + text.size() && std::isfinite(number))
		json.value(key, number);
	else if (text == "true" || text == "false")
		json.value(key, text == "true");
	else
		json.value(key, text);
}

void writePolylines(JsonWriter& json, const std::string& key, const std::vector<Polyline>& polylines)
{
	const PolylineFigures f = figuresOf(polylines);
	json.beginObject(key);
	json.value("polylines", f.polylines);
	json.value("closed", f.closed);
	json.value("nodes", f.nodes);
	json.value("metres", f.metres);
	json.end();
}

}  // namespace

PolylineFigures figuresOf(const std::vector<Polyline>& polylines)
{
	PolylineFigures f;
	f.polylines = polylines.size();
	for (const Polyline& p : polylines)
	{
		f.closed += p.closed ? 1 : 0;
		f.nodes += p.points.size();
		f.metres += p.length();
	}
	return f;
}

void writeOptions(JsonWriter& json, const MapOptions& options)
{
	json.beginObject("options");
	for (const std::string& key : MapOptions::keys()) writeOption(json, key, options.getOption(key));
	json.value("effectiveEps", options.creation.effectiveEps());
	json.end();
}

void writeStops(JsonWriter& json, const std::string& key,
				const std::array<std::size_t, std::size_t(StopReason::count_)>& stops)
{
	json.beginObject(key);
	for (std::size_t i = 0; i < stops.size(); i++)
		if (stops[i] != 0) json.value(toString(StopReason(i)), stops[i]);
	json.end();
}

void writeFigures(JsonWriter& json, const CRidgeMap2D& map)
{
	const MapStatistics s = map.core().statistics();
	json.beginObject("map");
	json.value("frozen", map.isFrozen());
	json.value("measurements", s.measurements);
	json.value("cells", s.cells);
	json.value("tiles", s.tiles);
	json.value("bytesInMemory", s.bytes);
	writePolylines(json, "ridges", map.ridges());
	writePolylines(json, "walls", map.walls());
	json.value("unstitchedCrossings", s.unstitchedCrossings);
	writeStops(json, "ends", s.stops);
	if (const Box2 box = map.box(); !box.empty())
	{
		json.beginObject("boundingBox");
		json.value("minX", box.min.x);
		json.value("minY", box.min.y);
		json.value("maxX", box.max.x);
		json.value("maxY", box.max.y);
		json.end();
	}
	json.end();
}

std::string humanBytes(double bytes)
{
	const char* units[] = {"bytes", "kB", "MB", "GB"};
	int unit = 0;
	for (; bytes >= 1000 && unit < 3; unit++) bytes /= 1000;
	char text[32];
	std::snprintf(text, sizeof(text), unit == 0 ? "%.0f %s" : "%.1f %s", bytes, units[unit]);
	return text;
}

void printWritten(const std::string& path)
{
	std::error_code error;
	const auto size = std::filesystem::file_size(path, error);
	std::printf("wrote         %s (%s)\n", path.c_str(), error ? "?" : humanBytes(double(size)).c_str());
}

}  // namespace ridgemap::apps
