// SPDX-License-Identifier: BSD-3-Clause
#include "geometry_files.h"

#include <charconv>
#include <cmath>
#include <ostream>

namespace ridgemap::apps
{
namespace
{
/** With as many decimals as are written, zeros at the end left out, whatever the locale. */
std::string number(double v)
{
	char text[64];
	std::string s(text, std::to_chars(text, text + sizeof(text), v, std::chars_format::fixed, writtenDecimals).ptr);
	s.erase(s.find_last_not_of('0') + 1);
	if (s.back() == '.') s.pop_back();
	return s == "-0" ? "0" : s;
}

/** Points without the repeated first one. */
std::size_t distinctPoints(const Polyline& line)
{
	return line.points.size() - (line.closed ? 1 : 0);
}

Box2 boxOf(const std::vector<Layer>& layers)
{
	Box2 box;
	for (const Layer& layer : layers)
		for (const Polyline& line : layer.lines)
			for (const Point2& p : line.points) box.extend(p);
	if (box.empty()) box.extend(Point2{0, 0});
	return box;
}

/** `x y` of the first n points. */
std::string coordinates(const Polyline& line, std::size_t n, const char* within, const char* between)
{
	std::string s;
	for (std::size_t i = 0; i < n; i++)
		s += (i > 0 ? between : "") + number(line.points[i].x) + within + number(line.points[i].y);
	return s;
}

void writeGroup(std::ostream& out, int code, const std::string& value)
{
	out << code << '\n' << value << '\n';
}
}  // namespace

void writePlainSvg(std::ostream& out, const std::vector<Layer>& layers)
{
	constexpr double margin = 0.5, lineWidth = 0.02;
	const Box2 box = boxOf(layers);
	// Rounded first, so that the page has the size of its contents to the last digit.
	const auto rounded = [](double v) { return std::round(v / writtenStep) * writtenStep; };
	const double width = rounded(box.max.x - box.min.x + 2 * margin);
	const double height = rounded(box.max.y - box.min.y + 2 * margin);
	out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << number(width * 1000) << "mm\" height=\""
		<< number(height * 1000) << "mm\" viewBox=\"" << number(box.min.x - margin) << ' '
		<< number(-box.max.y - margin) << ' ' << number(width) << ' ' << number(height) << "\">\n"
		<< "<g transform=\"scale(1,-1)\" fill=\"none\" stroke=\"#102060\" stroke-linejoin=\"round\" stroke-width=\""
		<< number(lineWidth) << "\">\n";
	for (const Layer& layer : layers)
	{
		out << "<g id=\"" << layer.name << "\">\n";
		for (const Polyline& line : layer.lines)
			out << (line.closed ? "<polygon" : "<polyline") << " points=\""
				<< coordinates(line, distinctPoints(line), ",", " ") << "\"/>\n";
		out << "</g>\n";
	}
	out << "</g>\n</svg>\n";
}

void writeDxf(std::ostream& out, const std::vector<Layer>& layers)
{
	constexpr const char *metres = "6", *solid = "CONTINUOUS";
	out << "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$INSUNITS\n70\n"
		<< metres << "\n9\n$MEASUREMENT\n70\n1\n";
	out << "0\nENDSEC\n0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLTYPE\n70\n1\n0\nLTYPE\n2\n"
		<< solid << "\n70\n64\n3\nSolid line\n72\n65\n73\n0\n40\n0.0\n0\nENDTAB\n0\nTABLE\n2\nLAYER\n70\n"
		<< layers.size() << '\n';
	int color = 5;
	for (const Layer& layer : layers)
		out << "0\nLAYER\n2\n" << layer.name << "\n70\n0\n62\n" << color-- << "\n6\n" << solid << '\n';
	out << "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
	for (const Layer& layer : layers)
		for (const Polyline& line : layer.lines)
		{
			out << "0\nPOLYLINE\n8\n" << layer.name << "\n66\n1\n70\n" << (line.closed ? 1 : 0) << '\n';
			for (std::size_t i = 0; i < distinctPoints(line); i++)
			{
				out << "0\nVERTEX\n8\n" << layer.name << '\n';
				writeGroup(out, 10, number(line.points[i].x));
				writeGroup(out, 20, number(line.points[i].y));
			}
			out << "0\nSEQEND\n8\n" << layer.name << '\n';
		}
	out << "0\nENDSEC\n0\nEOF\n";
}

void writeGeoJson(std::ostream& out, const std::vector<Layer>& layers)
{
	out << "{\"type\":\"FeatureCollection\",\"features\":[";
	const char* separator = "\n";
	for (const Layer& layer : layers)
		for (const Polyline& line : layer.lines)
		{
			out << separator << "{\"type\":\"Feature\",\"properties\":{\"layer\":\"" << layer.name
				<< "\",\"closed\":" << (line.closed ? "true" : "false") << "},\"geometry\":{\"type\":\""
				<< (line.closed ? "Polygon" : "LineString") << "\",\"coordinates\":" << (line.closed ? "[[[" : "[[")
				<< coordinates(line, line.points.size(), ",", "],[") << (line.closed ? "]]]}}" : "]]}}");
			separator = ",\n";
		}
	out << "\n]}\n";
}

void writeWkt(std::ostream& out, const std::vector<Layer>& layers)
{
	for (const Layer& layer : layers)
		for (const Polyline& line : layer.lines)
			out << (line.closed ? "POLYGON ((" : "LINESTRING (") << coordinates(line, line.points.size(), " ", ", ")
				<< (line.closed ? "))\n" : ")\n");
}

void writeLayersCsv(std::ostream& out, const std::vector<Layer>& layers)
{
	out << "layer,polyline,closed,x,y\n";
	for (const Layer& layer : layers)
		for (std::size_t i = 0; i < layer.lines.size(); i++)
			for (const Point2& p : layer.lines[i].points)
				out << layer.name << ',' << i << ',' << (layer.lines[i].closed ? 1 : 0) << ',' << number(p.x) << ','
					<< number(p.y) << '\n';
}

}  // namespace ridgemap::apps
