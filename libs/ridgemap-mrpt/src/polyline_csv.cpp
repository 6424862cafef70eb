// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/atomic_file.h>
#include <ridgemap/polyline_csv.h>

#include <charconv>
#include <ostream>

namespace ridgemap
{
namespace
{
/** 17 significant digits, whatever the locale. */
char* append(char* p, char* end, double v)
{
	return std::to_chars(p, end, v, std::chars_format::general, 17).ptr;
}

constexpr std::size_t maxLine = 96;

void appendXY(char* p, char* end, double x, double y, char* begin, std::ostream& out)
{
	p = append(p, end, x);
	*p++ = ',';
	p = append(p, end, y);
	*p++ = '\n';
	out.write(begin, p - begin);
}

}  // namespace

void writePolylinesCsv(std::ostream& out, const std::vector<Polyline>& polylines)
{
	out << "polyline,x,y\n";
	char line[maxLine];
	for (std::size_t i = 0; i < polylines.size(); i++)
		for (const Point2& p : polylines[i].points)
		{
			char* at = std::to_chars(line, line + maxLine, i).ptr;
			*at++ = ',';
			appendXY(at, line + maxLine, p.x, p.y, line, out);
		}
}

void writePolylinesCsv(const std::string& path, const std::vector<Polyline>& polylines)
{
	AtomicFile file(path);
	writePolylinesCsv(file.stream(), polylines);
	file.commit();
}

void writePointsCsvHeader(std::ostream& out)
{
	out << "x,y\n";
}

void appendPointCsv(std::ostream& out, double x, double y)
{
	char line[maxLine];
	appendXY(line, line + maxLine, x, y, line, out);
}

void writePointsCsv(std::ostream& out, const std::vector<Point2>& points)
{
	writePointsCsvHeader(out);
	for (const Point2& p : points) appendPointCsv(out, p.x, p.y);
}

void writePointsCsv(const std::string& path, const std::vector<Point2>& points)
{
	AtomicFile file(path);
	writePointsCsv(file.stream(), points);
	file.commit();
}

}  // namespace ridgemap
