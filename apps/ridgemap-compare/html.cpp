// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <ostream>

#include "html_notes.h"
#include "report.h"
#include "table.h"

namespace ridgemap::apps
{
namespace
{
constexpr const char* style = R"(<style>
:root{color-scheme:light}
body{font:16px/1.5 system-ui,sans-serif;color:#1c2430;background:#fff;max-width:1200px;margin:0 auto;padding:1rem}
h1{font-size:1.6rem;line-height:1.2;margin:.5rem 0;overflow-wrap:anywhere}
h2{font-size:1.2rem;margin:2rem 0 .5rem;break-after:avoid}
p,li{max-width:52rem}ul{padding-left:1.2rem}li{margin:.3rem 0}.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.85rem;font-variant-numeric:tabular-nums;min-width:100%}
th,td{padding:.25rem .5rem;text-align:right;border-bottom:1px solid #d9dee5}
th{font-weight:400;min-width:3.5rem}thead th{vertical-align:bottom;font-weight:600;line-height:1.25}
th:first-child{text-align:left;position:sticky;left:0;background:#fff;min-width:8.5rem}
.group th{font-weight:600;padding-top:.8rem;border-bottom-color:#8a94a3}
.best{font-weight:700;background:#e8f0e4}.unit{color:#667}
.row{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(46%,260px),1fr));gap:1rem}
figure{margin:0;break-inside:avoid}figcaption{font-size:.85rem;color:#445}
img,svg{width:100%;height:auto;display:block;border:1px solid #d9dee5}
@media(max-width:600px){table{font-size:.75rem}th,td{padding:.2rem .3rem}th:first-child{min-width:7rem}}
@media print{@page{margin:12mm}body{max-width:none;padding:0;font-size:10px}.wide{overflow:visible}
table{font-size:8px}th,td{padding:.1rem .25rem}tr,li{break-inside:avoid}.group{break-after:avoid}
.best{-webkit-print-color-adjust:exact;print-color-adjust:exact}th:first-child{position:static}
section{break-inside:avoid}figcaption{font-size:8px}h1{font-size:20px}h2{font-size:14px}p,li{max-width:none}.row{grid-template-columns:repeat(4,1fr);gap:.4rem}h2{margin-top:1rem}}
</style>
)";

std::string escaped(const std::string& s)
{
	std::string out;
	for (const char c : s)
		if (c == '<')
			out += "&lt;";
		else if (c == '&')
			out += "&amp;";
		else if (c == '"')
			out += "&quot;";
		else
			out += c;
	return out;
}

std::string base64(const std::vector<std::uint8_t>& bytes)
{
	constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	std::string out;
	for (std::size_t i = 0; i < bytes.size(); i += 3)
	{
		const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
		std::uint32_t v = 0;
		for (std::size_t k = 0; k < 3; k++) v = v << 8 | (k < n ? bytes[i + k] : 0u);
		for (std::size_t k = 0; k < 4; k++) out += k <= n ? digits[v >> (18 - 6 * k) & 63] : '=';
	}
	return out;
}

using Shown = std::vector<Figures>;

void writeTableHead(std::ostream& out, const Shown& maps)
{
	out << "<div class=\"wide\"><table><thead><tr><th></th>";
	for (const Figures& f : maps) out << "<th>" << escaped(f.name) << "</th>";
	out << "</tr></thead><tbody>\n";
}

/** The best of these maps is marked. */
void writeLine(std::ostream& out, const Line& line, const std::string& heading, const Shown& maps)
{
	out << "<tr><th>" << heading << " <span class=\"unit\">" << line.unit << "</span></th>";
	for (const Figures& f : maps)
		out << (line.isBest(f, maps) ? "<td class=\"best\">" : "<td>") << line.text(f) << "</td>";
	out << "</tr>\n";
}

void writeShortTable(std::ostream& out, const Report& r)
{
	Shown maps;
	for (const Figures& f : r.figures)
		if (!hasRemark(f)) maps.push_back(f);
	writeTableHead(out, maps);
	for (const Line& line : mainLinesOf(r)) writeLine(out, line, line.shortName, maps);
	out << "</tbody></table></div>\n";
}

void writeFiguresTable(std::ostream& out, const Report& r)
{
	out << "<section><h2>All figures</h2><p>Less is better everywhere but in &ldquo;complete&rdquo;. What the lines "
		   "mean is "
		   "said "
		   "at the end.</p>\n";
	writeTableHead(out, r.figures);
	std::string group;
	for (const Line& line : linesOf(r))
	{
		if (line.group != group)
			out << "<tr class=\"group\"><th colspan=\"" << r.figures.size() + 1 << "\">" << line.group
				<< "</th></tr>\n";
		group = line.group;
		writeLine(out, line, line.heading, r.figures);
	}
	out << "</tbody></table></div></section>\n";
}

/** Bars of 5 mm, the last one (in another colour) all that is beyond. */
void writeHistogram(std::ostream& out, const std::string& name, const Distances& d)
{
	constexpr double width = 300, height = 120, floor = 100;
	double most = 0.05;
	for (const double share : d.histogram) most = std::max(most, share);
	out << "<figure><svg viewBox=\"0 0 300 120\" role=\"img\" font-size=\"10\" fill=\"#445\">";
	char text[160];
	for (std::size_t i = 0; i < d.histogram.size(); i++)
	{
		const double w = width / double(bars), h = d.histogram[i] / most * (floor - 14);
		std::snprintf(text, sizeof(text), "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>",
					  double(i) * w + 1, floor - h, w - 2, h, i + 1 == bars ? "#c8471b" : "#23407a");
		out << text;
	}
	std::snprintf(text, sizeof(text), "<text x=\"2\" y=\"10\">%.0f %%</text>", 100 * most);
	out << text << "<text x=\"2\" y=\"" << height - 6 << "\">0</text><text x=\"130\" y=\"" << height - 6
		<< "\">5 cm</text><text x=\"262\" y=\"" << height - 6 << "\">&gt; 10</text></svg><figcaption>" << escaped(name)
		<< "</figcaption></figure>\n";
}

void writeHistograms(std::ostream& out, const Report& r, const char* title, const char* what, Distances Figures::*which)
{
	out << "<section><h2>" << title << "</h2><p>" << what
		<< " Bars are 5 mm wide; the last one is all beyond 10 cm. Scales differ: each shows its highest bar in "
		   "full.</p><div class=\"row\">";
	for (const Figures& f : r.figures) writeHistogram(out, f.name, f.*which);
	out << "</div></section>\n";
}
}  // namespace

void writeHtml(std::ostream& out, const Report& r)
{
	out << "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
		   "content=\"width=device-width,initial-scale=1\"><title>Maps of "
		<< escaped(r.input) << "</title>\n"
		<< style << "</head><body>\n<h1>Maps of " << escaped(r.input) << "</h1>\n<p>" << r.scans
		<< " scans, smoothing parameter sigma " << r.sigma << " m"
		<< (r.truth.empty() ? ", no truth" : ", truth from " + escaped(r.truth))
		<< (r.secondPass.empty() ? "" : ", second pass from " + escaped(r.secondPass))
		<< ".</p>\n<h2>In short</h2>\n<p>Less is better in all lines"
		<< (r.truth.empty() ? "" : " but that of completeness") << "; the best is marked.</p>\n";
	writeShortTable(out, r);
	out << "<ul>\n";
	for (const std::string& sentence : inShort(r)) out << "<li>" << escaped(sentence) << "</li>\n";
	out << "</ul>\n";
	for (const PictureRow& row : r.rows)
	{
		out << "<section><h2>" << escaped(row.title) << "</h2><div class=\"row\">\n";
		for (const Picture& p : row.pictures)
			out << "<figure><img alt=\"" << escaped(p.caption) << "\" src=\"data:image/png;base64," << base64(p.png)
				<< "\"><figcaption>" << escaped(p.caption) << "</figcaption></figure>\n";
		out << "</div></section>\n";
	}
	writeFiguresTable(out, r);
	if (!r.truth.empty())
		writeHistograms(out, r, "Error of the surface",
						"Distance of points along the surface of each map to the true surface.", &Figures::surface);
	if (r.folds > 0)
		writeHistograms(out, r, "Scans held out",
						"Distance of the ends of beams that the map has not seen to its surface.", &Figures::heldOut);
	writeNotes(out, r);
	out << "</body></html>\n";
}

}  // namespace ridgemap::apps
