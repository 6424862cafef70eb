// SPDX-License-Identifier: BSD-3-Clause
#include "stats.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "../common/json_writer.h"
#include "../common/map_report.h"

namespace ridgemap::apps
{
namespace
{
void writeInputs(JsonWriter& json, const std::vector<InputReport>& inputs)
{
	json.beginArray("inputs");
	for (const InputReport& r : inputs)
	{
		json.beginObject();
		json.value("file", r.path);
		json.value("poses", r.poseSource);
		json.value("scans", r.scans);
		json.value("measurements", r.measurements);
		json.value("observationsWithoutPose", r.withoutPose);
		json.value("rangesNotFinite", r.notFinite);
		json.beginObject("skipped");
		for (const auto& [what, count] : r.skipped) json.value(what, count);
		json.end();
		json.beginObject("observations");
		for (const auto& [name, count] : r.classes) json.value(name, count);
		json.end();
		json.end();
	}
	json.end();
}

void writeFeed(JsonWriter& json, const Feed& feed)
{
	json.beginObject("feed");
	json.value("shuffled", feed.shuffleSeed.has_value());
	if (feed.shuffleSeed) json.value("seed", *feed.shuffleSeed);
	json.value("batch", feed.batch);
	json.value("threads", feed.threads);
	json.value("polylinesAfterEveryScan", feed.everyScan);
	json.value("keepGoing", feed.keepGoing);
	json.end();
}

void writeUpdates(JsonWriter& json, const UpdateReport& u)
{
	json.beginObject("updates");
	json.value("updates", u.milliseconds.size());
	json.value("regions", u.regions);
	json.value("tiles", u.sum.tiles);
	json.value("evaluations", u.sum.evaluations);
	json.value("kernels", u.sum.kernels);
	json.value("seeds", u.sum.seeds);
	json.value("ridgesAppeared", u.appeared);
	json.value("ridgesVanished", u.vanished);
	writeStops(json, "tracesEndedBy", u.sum.stops);
	json.end();
}

void writeTimes(JsonWriter& json, const UpdateReport& u, double seconds)
{
	const TimeFigures t = figuresOf(u.milliseconds), insertions = figuresOf(u.insertions);
	json.beginObject("times");
	json.value("totalSeconds", seconds);
	json.value("insertionMedianMs", insertions.median);
	json.value("insertion99PercentMs", insertions.p99);
	json.value("insertionMaxMs", insertions.max);
	json.value("insertionSumMs", insertions.sum);
	json.value("updateMedianMs", t.median);
	json.value("update99PercentMs", t.p99);
	json.value("updateMaxMs", t.max);
	json.value("updateSumMs", t.sum);
	const auto list = [&](const char* name, const std::vector<double>& all)
	{
		json.beginArray(name);
		for (const double ms : all) json.value("", std::round(ms * 1000) / 1000);
		json.end();
	};
	list("insertionsMs", u.insertions);
	list("updatesMs", u.milliseconds);
	json.end();
}

}  // namespace

TimeFigures figuresOf(std::vector<double> ms)
{
	TimeFigures f;
	if (ms.empty()) return f;
	std::sort(ms.begin(), ms.end());
	const auto quantile = [&](double q) { return ms[std::size_t(std::ceil(q * double(ms.size()))) - 1]; };
	f.median = quantile(0.5);
	f.p99 = quantile(0.99);
	f.max = ms.back();
	for (const double t : ms) f.sum += t;
	return f;
}

void writeStats(std::ostream& out, const CRidgeMap2D& map, const Builder& builder, const Feed& feed, double seconds,
				const Outputs::FileSizes& sizes)
{
	JsonWriter json(out);
	json.beginObject();
	json.value("program", "ridgemap-build");
	json.value("version", RIDGEMAP_VERSION);
	writeInputs(json, builder.inputs());
	writeOptions(json, map.mapOptions());
	writeFeed(json, feed);
	writeFigures(json, map);
	writeUpdates(json, builder.updates());
	json.beginObject("fileBytes");
	for (const auto& [name, size] : sizes) json.value(name, size);
	json.end();
	writeTimes(json, builder.updates(), seconds);
	json.end();
}

void printSummary(const CRidgeMap2D& map, const Builder& builder, bool everyScan, double seconds,
				  const Outputs& outputs)
{
	std::size_t scans = 0, measurements = 0, withoutPose = 0, notFinite = 0;
	for (const InputReport& r : builder.inputs())
	{
		std::printf("input         %s (poses: %s)\n", r.path.c_str(), r.poseSource.c_str());
		scans += r.scans;
		measurements += r.measurements;
		withoutPose += r.withoutPose;
		notFinite += r.notFinite;
	}
	std::printf("scans         %zu\nmeasurements  %zu", scans, measurements);
	if (const auto all = map.core().statistics().measurements; all != measurements)
		std::printf(" in this run, %llu in the map", static_cast<unsigned long long>(all));
	std::printf("\n");
	if (notFinite != 0) std::printf("left out      %zu ranges that are NaN or infinite\n", notFinite);
	if (withoutPose != 0) std::printf("left out      %zu observations at times without a pose\n", withoutPose);
	for (const InputReport& r : builder.inputs())
		for (const auto& [what, count] : r.skipped)
			std::printf("left out      %zu %s of %s\n", count, what.c_str(), r.path.c_str());
	const PolylineFigures walls = apps::figuresOf(map.walls()), ridges = apps::figuresOf(map.ridges());
	std::printf("walls         %.1f m in %zu polylines with %zu nodes\n", walls.metres, walls.polylines, walls.nodes);
	std::printf("ridges        %.1f m in %zu polylines with %zu nodes\n", ridges.metres, ridges.polylines,
				ridges.nodes);
	const TimeFigures insertions = figuresOf(builder.updates().insertions);
	const TimeFigures t = figuresOf(builder.updates().milliseconds);
	std::printf("times         %.1f s in all; ", seconds);
	if (everyScan)
		std::printf("an insertion with up-to-date polylines takes %.2f ms (median), %.2f ms (99 %%)\n", t.median,
					t.p99);
	else
		std::printf("an insertion takes %.3f ms (median), %.3f ms (99 %%), the polylines at the end %.2f s\n",
					insertions.median, insertions.p99, 1e-3 * t.sum);
	for (const std::string& path : outputs.paths()) printWritten(path);
}

}  // namespace ridgemap::apps
