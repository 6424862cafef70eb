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
void writeTimes(JsonWriter& json, const Times& t)
{
	json.value("firstUs", t.cold);
	json.value("medianUs", t.median);
	json.value("p99Us", t.p99);
	json.value("lastTenthOverFirst", t.growth);
}

void writeQueryTimes(JsonWriter& json, const std::string& key, const QueryTimes& t)
{
	json.beginObject(key);
	writeTimes(json, t.fresh);
	json.value("againMedianUs", t.again);
	json.end();
}

void writeLocalization(JsonWriter& json, const std::string& key, const Localization& l)
{
	json.beginObject(key);
	json.value("count", l.count);
	json.value("positionMedian", l.median);
	json.value("positionP99", l.p99);
	json.value("headingMedianDegrees", l.heading);
	json.value("shareLost", l.lost);
	json.end();
}

void writeFilterSettings(JsonWriter& json)
{
	const FilterSettings s;
	json.beginObject("localizationSettings");
	json.value("runs", s.runs);
	json.value("particles", s.particles);
	json.value("beams", s.beams);
	json.value("settlingScans", s.settling);
	json.value("spread", s.spread);
	json.value("hit", s.hit);
	json.value("range", s.range);
	json.value("farthest", s.farthest);
	json.value("lost", s.lost);
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

/** Words one below the other, as many in a line as fit. */
std::vector<std::string> wrapped(const std::string& text, std::size_t width)
{
	std::vector<std::string> lines;
	std::istringstream words(text);
	for (std::string word; words >> word;)
		if (!lines.empty() && lines.back().size() + 1 + word.size() <= width)
			lines.back() += " " + word;
		else
			lines.push_back(word);
	return lines;
}

void printNames(const Report& report, int width)
{
	std::vector<std::vector<std::string>> names;
	std::size_t lines = 0;
	for (const Figures& f : report.figures)
	{
		names.push_back(wrapped(f.name, std::size_t(width) - 1));
		lines = std::max(lines, names.back().size());
	}
	for (std::size_t i = 0; i < lines; i++)
	{
		std::printf("%s%-36s", i > 0 ? "\n" : "", "");
		for (const auto& name : names) std::printf("%*s", width, i < name.size() ? name[i].c_str() : "");
	}
}
}  // namespace

void printTable(const Report& report)
{
	constexpr int width = 11;
	printNames(report, width);
	std::string group;
	for (const Line& line : linesOf(report))
	{
		if (line.group != group) std::printf("\n%s", line.group.c_str());
		group = line.group;
		std::printf("\n  %-34s", (line.heading + (line.unit.empty() ? "" : " [" + line.unit + "]")).c_str());
		for (const Figures& f : report.figures) std::printf("%*s", width, line.text(f).c_str());
	}
	std::printf("\n\n");
	for (const std::string& sentence : inShort(report)) std::printf("%s\n", sentence.c_str());
}

void writeJson(std::ostream& out, const Report& report)
{
	JsonWriter json(out);
	json.beginObject();
	json.value("program", "ridgemap-compare");
	json.value("version", RIDGEMAP_VERSION);
	json.value("input", report.input);
	json.value("truth", report.truth);
	json.value("secondPass", report.secondPass);
	json.value("scans", report.scans);
	json.value("scansMadeOfPoints", report.fromClouds);
	json.value("folds", report.folds);
	json.value("rotationDegrees", report.rotation);
	json.value("sigma", report.sigma);
	if (report.localizes()) writeFilterSettings(json);
	json.beginArray("maps");
	for (const Figures& f : report.figures)
	{
		json.beginObject();
		json.value("name", f.name);
		json.value("bytesInMemory", f.memory);
		json.value("bytesOnHeapWithCaches", f.heap);
		json.value("bytesSerialized", f.serialized);
		json.value("bytesCompressed", f.compressed);
		json.value("bytesCompressedForLocalization", f.onRobot);
		json.beginObject("insertion");
		writeTimes(json, f.insertion);
		json.end();
		writeQueryTimes(json, "likelihood", f.likelihood);
		writeQueryTimes(json, "matching", f.matching);
		if (!report.truth.empty())
		{
			writeDistances(json, "surfaceToTruth", f.surface);
			json.value("completeness", f.completeness);
		}
		if (report.folds > 0) writeDistances(json, "heldOutScans", f.heldOut);
		if (report.localizes())
		{
			writeLocalization(json, "localization", f.localization);
			writeLocalization(json, "localizationInReducedMap", f.onRobotLocalization);
		}
		json.end();
	}
	json.end();
	json.end();
}

}  // namespace ridgemap::apps
