// SPDX-License-Identifier: BSD-3-Clause
#include "table.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace ridgemap::apps
{
namespace
{
std::string fixed(double v, int decimals)
{
	char text[48];
	std::snprintf(text, sizeof(text), "%.*f", decimals, v);
	return text;
}

void addAccuracy(std::vector<Line>& lines, const Report& r)
{
	const auto less = Better::less;
	if (!r.truth.empty())
	{
		const std::string group = "Surface against the truth";
		lines.push_back({group, "error (rms, up to 10 cm)", "mm", 2, less, "error of the surface",
						 [](const Figures& f) { return 1e3 * f.surface.rms; }});
		lines.push_back({group, "farther off than 10 cm", "%", 2, less, "",
						 [](const Figures& f) { return 100 * f.surface.beyond; }});
		lines.push_back({group, "complete within 3 cm", "%", 2, Better::more, "completeness of the surface",
						 [](const Figures& f) { return 100 * f.completeness; }});
	}
	if (r.folds > 0)
	{
		const std::string group = "Scans held out, distance to the map";
		lines.push_back({group, "median", "mm", 1, less, "distance of scans held out",
						 [](const Figures& f) { return 1e3 * f.heldOut.median; }});
		lines.push_back(
			{group, "rms, up to 10 cm", "mm", 1, less, "", [](const Figures& f) { return 1e3 * f.heldOut.rms; }});
		lines.push_back({group, "farther off than 10 cm", "%", 2, less, "",
						 [](const Figures& f) { return 100 * f.heldOut.beyond; }});
	}
}

void addLocalization(std::vector<Line>& lines, const Report& r)
{
	if (!r.localizes()) return;
	const std::string group =
		"Localisation of " + std::string(r.secondPass.empty() ? "held-out scans" : "a second pass");
	const auto less = Better::less;
	lines.push_back({group, "position error, median", "mm", 1, less, "localisation",
					 [](const Figures& f) { return 1e3 * f.localization.median; }});
	lines.push_back(
		{group, "position error, 99 %", "mm", 0, less, "", [](const Figures& f) { return 1e3 * f.localization.p99; }});
	lines.push_back(
		{group, "heading error, median", "deg", 3, less, "", [](const Figures& f) { return f.localization.heading; }});
	lines.push_back(
		{group, "lost (off by 0.5 m)", "%", 2, less, "", [](const Figures& f) { return 100 * f.localization.lost; }});
	lines.push_back({group, "median, in the reduced map", "mm", 1, less, "",
					 [](const Figures& f) { return 1e3 * f.onRobotLocalization.median; }});
}

void addSizes(std::vector<Line>& lines)
{
	const std::string group = "Size";
	const auto less = Better::less;
	lines.push_back(
		{group, "map in memory", "kB", 1, less, "", [](const Figures& f) { return 1e-3 * double(f.memory); }});
	lines.push_back(
		{group, "with caches of queries", "kB", 1, less, "", [](const Figures& f) { return 1e-3 * double(f.heap); }});
	lines.push_back(
		{group, "serialized", "kB", 1, less, "", [](const Figures& f) { return 1e-3 * double(f.serialized); }});
	lines.push_back({group, "serialized, gz", "kB", 1, less, "size (gz)",
					 [](const Figures& f) { return 1e-3 * double(f.compressed); }});
	lines.push_back({group, "reduced for localisation, gz", "kB", 1, less, "size of what localisation needs (gz)",
					 [](const Figures& f) { return 1e-3 * double(f.onRobot); }});
}

void addQueries(std::vector<Line>& lines, const std::string& group, const std::string& shortName,
				QueryTimes Figures::*query)
{
	const auto less = Better::less;
	lines.push_back(
		{group, "the very first", "us", 0, less, "", [query](const Figures& f) { return (f.*query).fresh.cold; }});
	lines.push_back({group, "cold: at a new place, median", "us", 0, less, shortName,
					 [query](const Figures& f) { return (f.*query).fresh.median; }});
	lines.push_back({group, "warm: there again, median", "us", 0, less, "",
					 [query](const Figures& f) { return (f.*query).again; }});
}

void addTimes(std::vector<Line>& lines)
{
	const std::string group = "Insertion of a scan";
	const auto less = Better::less;
	lines.push_back(
		{group, "median", "us", 0, less, "insertion of a scan", [](const Figures& f) { return f.insertion.median; }});
	lines.push_back({group, "99 %", "us", 0, less, "", [](const Figures& f) { return f.insertion.p99; }});
	lines.push_back(
		{group, "growth: last over first tenth", "", 2, less, "", [](const Figures& f) { return f.insertion.growth; }});
	addQueries(lines, "Likelihood of a scan", "likelihood at a new place", &Figures::likelihood);
	addQueries(lines, "Matching of a scan", "matching at a new place", &Figures::matching);
}

std::string listed(const std::vector<std::string>& names)
{
	std::string text;
	for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
	return text;
}

bool anotherIsBest(const Line& line, const std::vector<Figures>& all)
{
	return !line.isBest(all.front(), all) &&
		   std::any_of(all.begin(), all.end(), [&](const Figures& f) { return line.isBest(f, all); });
}
}  // namespace

std::string Line::text(const Figures& f) const
{
	return fixed(value(f), decimals);
}

bool Line::isWorse(const Figures& f, const Figures& than) const
{
	const double a = std::atof(text(f).c_str()), b = std::atof(text(than).c_str());
	return better == Better::less ? a > b : a < b;
}

bool Line::isBest(const Figures& f, const std::vector<Figures>& all) const
{
	const bool beaten = std::any_of(all.begin(), all.end(), [&](const Figures& other) { return isWorse(f, other); });
	const bool beats = std::any_of(all.begin(), all.end(), [&](const Figures& other) { return isWorse(other, f); });
	return beats && !beaten;
}

bool hasRemark(const Figures& f)
{
	return f.name.find(',') != std::string::npos;
}

std::vector<Line> linesOf(const Report& report)
{
	std::vector<Line> lines;
	addAccuracy(lines, report);
	addLocalization(lines, report);
	addSizes(lines);
	addTimes(lines);
	return lines;
}

std::vector<Line> mainLinesOf(const Report& report)
{
	std::vector<Line> lines = linesOf(report);
	const auto minor = [](const Line& line) { return line.shortName.empty(); };
	lines.erase(std::remove_if(lines.begin(), lines.end(), minor), lines.end());
	return lines;
}

std::vector<std::string> inShort(const Report& report)
{
	std::vector<std::string> all, some, none, elsewhere;
	for (const Line& line : mainLinesOf(report))
	{
		std::size_t grids = 0, beaten = 0;
		for (const Figures& f : report.figures)
			if (f.name.compare(0, 4, "grid") == 0 && !hasRemark(f))
			{
				grids++;
				beaten += line.isWorse(f, report.figures.front()) ? 1 : 0;
			}
		(beaten == grids ? all : beaten > 0 ? some : none).push_back(line.shortName);
		if (anotherIsBest(line, report.figures)) elsewhere.push_back(line.shortName);
	}
	std::vector<std::string> sentences;
	const auto say = [&](const char* what, const std::vector<std::string>& names)
	{
		if (!names.empty()) sentences.push_back(what + listed(names) + ".");
	};
	say("The ridge map is better than all grids in: ", all);
	say("It is better than some of them in: ", some);
	say("It is better than none of them in: ", none);
	say("A map of another kind is the best of all in: ", elsewhere);
	sentences.push_back(
		"Grids show free and unknown space in their cells, which planning of paths needs; the ridge map tells them "
		"apart "
		"only in cells of 2 sigma.");
	return sentences;
}

}  // namespace ridgemap::apps
