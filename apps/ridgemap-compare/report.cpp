// SPDX-License-Identifier: BSD-3-Clause
#include "report.h"

#include <algorithm>
#include <cstdio>

#include "../common/json_writer.h"
#include "table.h"

namespace ridgemap::apps
{
namespace
{
std::string fixed(double v, int digits)
{
	char text[48];
	std::snprintf(text, sizeof(text), "%.*f", digits, v);
	return text;
}

std::string kilobytes(std::size_t bytes)
{
	return fixed(double(bytes) / 1000, bytes < 10000 ? 1 : 0);
}

void writeTimes(JsonWriter& json, const std::string& key, const Times& t)
{
	json.beginObject(key);
	json.value("firstUs", t.cold);
	json.value("medianUs", t.median);
	json.value("p99Us", t.p99);
	json.value("lastTenthOverFirst", t.growth);
	json.end();
}

void writeDistances(JsonWriter& json, const std::string& key, const Distances& d)
{
	json.beginObject(key);
	json.value("count", d.count);
	json.value("rmsBelow10cm", d.rms);
	json.value("median", d.median);
	json.value("shareBeyond10cm", d.beyond);
	json.beginArray("histogramOf5mm");
	for (const double share : d.histogram) json.value("", share);
	json.end();
	json.end();
}
}  // namespace

std::vector<Column> columnsOf(const Report& report)
{
	std::vector<Column> columns;
	if (!report.truth.empty())
	{
		columns.push_back(
			{"error to truth, rms", "mm", [](const Figures& f) { return fixed(1e3 * f.surface.rms, 2); }});
		columns.push_back(
			{"farther than 10 cm", "%", [](const Figures& f) { return fixed(100 * f.surface.beyond, 2); }});
		columns.push_back({"complete", "%", [](const Figures& f) { return fixed(100 * f.completeness, 2); }});
	}
	if (report.folds > 0)
		columns.push_back(
			{"held-out scans, median", "mm", [](const Figures& f) { return fixed(1e3 * f.heldOut.median, 1); }});
	columns.push_back({"memory", "kB", [](const Figures& f) { return kilobytes(f.memory); }});
	columns.push_back({"serialized", "kB", [](const Figures& f) { return kilobytes(f.serialized); }});
	columns.push_back({"compressed", "kB", [](const Figures& f) { return kilobytes(f.compressed); }});
	columns.push_back({"insert a scan", "us", [](const Figures& f) { return fixed(f.insertion.median, 0); }});
	columns.push_back({"insert, 99 %", "us", [](const Figures& f) { return fixed(f.insertion.p99, 0); }});
	columns.push_back({"last / first tenth", "", [](const Figures& f) { return fixed(f.insertion.growth, 2); }});
	columns.push_back({"likelihood", "us", [](const Figures& f) { return fixed(f.likelihood.median, 0); }});
	columns.push_back({"likelihood, first", "us", [](const Figures& f) { return fixed(f.likelihood.cold, 0); }});
	columns.push_back({"matching", "us", [](const Figures& f) { return fixed(f.matching.median, 0); }});
	columns.push_back({"matching, first", "us", [](const Figures& f) { return fixed(f.matching.cold, 0); }});
	return columns;
}

void printTable(const Report& report)
{
	std::printf("%-28s", "");
	std::size_t width = 0;
	for (const Figures& f : report.figures) width = std::max(width, f.name.size());
	for (const Figures& f : report.figures) std::printf("%*s", int(width) + 2, f.name.c_str());
	std::printf("\n");
	for (const Column& column : columnsOf(report))
	{
		std::printf("%-28s", (column.heading + (column.unit.empty() ? "" : " [" + column.unit + "]")).c_str());
		for (const Figures& f : report.figures) std::printf("%*s", int(width) + 2, column.text(f).c_str());
		std::printf("\n");
	}
}

void writeJson(std::ostream& out, const Report& report)
{
	JsonWriter json(out);
	json.beginObject();
	json.value("program", "ridgemap-compare");
	json.value("version", RIDGEMAP_VERSION);
	json.value("input", report.input);
	json.value("truth", report.truth);
	json.value("scans", report.scans);
	json.value("folds", report.folds);
	json.value("rotationDegrees", report.rotation);
	json.value("sigma", report.sigma);
	json.beginArray("maps");
	for (const Figures& f : report.figures)
	{
		json.beginObject();
		json.value("name", f.name);
		json.value("bytesInMemory", f.memory);
		json.value("bytesSerialized", f.serialized);
		json.value("bytesCompressed", f.compressed);
		writeTimes(json, "insertion", f.insertion);
		writeTimes(json, "likelihood", f.likelihood);
		writeTimes(json, "matching", f.matching);
		if (!report.truth.empty())
		{
			writeDistances(json, "surfaceToTruth", f.surface);
			json.value("completeness", f.completeness);
		}
		if (report.folds > 0) writeDistances(json, "heldOutScans", f.heldOut);
		json.end();
	}
	json.end();
	json.end();
}

}  // namespace ridgemap::apps
