// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <ostream>

#include "report.h"
#include "table.h"

namespace ridgemap::apps
{
namespace
{
constexpr const char* style = R"(<style>
:root{color-scheme:light}
body{font:16px/1.5 system-ui,sans-serif;color:#1c2430;background:#fff;max-width:1200px;margin:0 auto;padding:1rem}
h1{font-size:1.6rem;line-height:1.2;margin:.5rem 0}h2{font-size:1.2rem;margin:2rem 0 .5rem}
p{max-width:48rem}.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.78rem;font-variant-numeric:tabular-nums;min-width:100%}
th,td{padding:.35rem .4rem;text-align:right;border-bottom:1px solid #d9dee5}
th:first-child,td:first-child{text-align:left;position:sticky;left:0;background:#fff}
td:first-child{white-space:nowrap}thead th{vertical-align:bottom;font-weight:600}.unit{color:#667;font-weight:400}
.row{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(46%,260px),1fr));gap:1rem}
figure{margin:0;break-inside:avoid}figcaption{font-size:.85rem;color:#445}
img,svg{width:100%;height:auto;display:block;border:1px solid #d9dee5}
@media print{body{max-width:none;font-size:11px}.wide{overflow:visible}table{font-size:8px}th,td{padding:.15rem .25rem}
.row{grid-template-columns:repeat(4,1fr);gap:.4rem}}
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

void writeFiguresTable(std::ostream& out, const Report& r)
{
	const auto columns = columnsOf(r);
	out << "<div class=\"wide\"><table><thead><tr><th>map</th>";
	for (const Column& c : columns)
		out << "<th>" << c.heading << "<br><span class=\"unit\">" << c.unit << "</span></th>";
	out << "</tr></thead><tbody>\n";
	for (const Figures& f : r.figures)
	{
		out << "<tr><td>" << escaped(f.name) << "</td>";
		for (const Column& c : columns) out << "<td>" << c.text(f) << "</td>";
		out << "</tr>\n";
	}
	out << "</tbody></table></div>\n";
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

void writeHistograms(std::ostream& out, const Report& r)
{
	const bool truth = !r.truth.empty();
	if (!truth && r.folds == 0) return;
	out << "<h2>" << (truth ? "Error of the surface" : "Held-out scans") << "</h2><p>"
		<< (truth ? "Distance of the points along the surface of each map to the true surface."
				  : "Distance of the ends of scans that the map has not seen to its surface.")
		<< " Bars are 5 mm wide; the last one is all beyond 10 cm. Scales differ: each shows its highest bar in "
		   "full.</p>"
		<< "<div class=\"row\">";
	for (const Figures& f : r.figures) writeHistogram(out, f.name, truth ? f.surface : f.heldOut);
	out << "</div>\n";
}

/** What the figures mean, and where they do not speak for the ridge map. */
void writeNotes(std::ostream& out, const Report& r)
{
	out << "<h2>How to read this</h2>\n<ul>\n"
		   "<li>All maps took in the same scans at the same poses, one after the other, in one thread. The poses are "
		   "not "
		   "corrected by any of the maps.</li>\n<li>All poses were turned by "
		<< r.rotation
		<< " degrees: walls that run along the axes of a grid are its easiest or its worst case, depending on where "
		   "the "
		   "cell borders happen to fall.</li>\n"
		   "<li>MRPT's grid spreads the N beams of a scan over the aperture in steps of aperture/N; its other maps, "
		   "and "
		   "scanners, use aperture/(N-1). The grids without a remark were given scans turned and widened so that their "
		   "beams lie where they were measured; the others show MRPT as it is.</li>\n"
		   "<li>The surface of a grid is the centres of all cells below 0.35 (probability of being free), that of the "
		   "points "
		   "map its points, that of the ridge map its walls. A cell or point on either side of a wall counts as an "
		   "error "
		   "although it is where a measurement was: this is what a user of the surface gets.</li>\n"
		   "<li>Held-out scans favour maps that keep many scattered points: the nearest of many noisy points is near "
		   "by "
		   "chance. The distance to a true wall would have the noise of the scanner as its median, not zero.</li>\n"
		   "<li>Memory is that of the map alone: cells, or points, or measurements with polylines, not trees and "
		   "caches. "
		   "Serialized is MRPT's archive, compressed by zlib. The ridge map stores its measurements; frozen, only its "
		   "polylines, a few kilobytes.</li>\n"
		   "<li>Likelihood and matching take all beams, 4 cm beside the true pose. The first time builds what queries "
		   "need "
		   "(trees, or the likelihood cache of a grid); the median is of up to 200 further scans.</li>\n"
		   "<li>What the grid does and the ridge map does not: it knows free space from unknown space, it forgets "
		   "people "
		   "who went away, and it takes in a scan in a time that does not depend on what is there. Choose it for "
		   "planning "
		   "paths.</li>\n</ul>\n";
}
}  // namespace

void writeHtml(std::ostream& out, const Report& r)
{
	out << "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
		   "content=\"width=device-width,initial-scale=1\"><title>Maps of "
		<< escaped(r.input) << "</title>\n"
		<< style << "</head><body>\n<h1>Maps of " << escaped(r.input) << "</h1>\n<p>" << r.scans
		<< " scans, smoothing parameter sigma " << r.sigma << " m"
		<< (r.truth.empty() ? ", no truth" : ", truth from " + escaped(r.truth)) << ". Less is better in all columns"
		<< (r.truth.empty() ? "" : " but complete (share of the seen surface with a surface of the map within 3 cm)")
		<< ".</p>\n";
	writeFiguresTable(out, r);
	for (const PictureRow& row : r.rows)
	{
		out << "<h2>" << escaped(row.title) << "</h2><div class=\"row\">\n";
		for (const Picture& p : row.pictures)
			out << "<figure><img alt=\"" << escaped(p.caption) << "\" src=\"data:image/png;base64," << base64(p.png)
				<< "\"><figcaption>" << escaped(p.caption) << "</figcaption></figure>\n";
		out << "</div>\n";
	}
	writeHistograms(out, r);
	writeNotes(out, r);
	out << "</body></html>\n";
}

}  // namespace ridgemap::apps
