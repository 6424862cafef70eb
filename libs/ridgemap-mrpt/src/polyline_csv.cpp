// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/atomic_file.h>
#include <ridgemap/polyline_csv.h>
#include <ridgemap/standard_error.h>

#include <charconv>
#include <cmath>
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

constexpr std::size_t maxLine = 192;

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

void writeVerticesCsv(std::ostream& out, const std::vector<Polyline>& polylines, double sigma)
{
	out << "polyline,x,y,occupancy,noise,standard_error,half_width_95\n";
	char line[maxLine];
	char* const end = line + maxLine;
	for (std::size_t i = 0; i < polylines.size(); i++)
		for (std::size_t k = 0; k < polylines[i].points.size(); k++)
		{
			const VertexInfo info = k < polylines[i].info.size() ? polylines[i].info[k] : VertexInfo();
			const RidgeUncertainty u = ridgeUncertainty(info, sigma);
			char* at = std::to_chars(line, end, i).ptr;
			const auto field = [&](double v, bool known, int digits)
			{
				*at++ = ',';
				if (known) at = std::to_chars(at, end, v, std::chars_format::general, digits).ptr;
			};
			field(polylines[i].points[k].x, true, 17);
			field(polylines[i].points[k].y, true, 17);
			field(double(info.occupancy), info.occupancy > 0, 9);
			field(u.noise, info.occupancy > 0 && info.curvature > 0, 6);
			const double error = double(info.standardError);
			field(error, std::isfinite(error), 6);
			// Fitted walls rest on so many measurements that their errors are normal.
			const bool onRidge = info.origin == VertexOrigin::ridge;
			field(onRidge ? u.halfWidth95 : 1.959964 * error, std::isfinite(error), 6);
			*at++ = '\n';
			out.write(line, at - line);
		}
}

void writeMeasurementsCsvHeader(std::ostream& out)
{
	out << "x,y,sensorX,sensorY\n";
}

void appendMeasurementCsv(std::ostream& out, const Measurement& m)
{
	char line[maxLine];
	char *at = line, *const end = line + maxLine;
	at = append(at, end, m.x);
	*at++ = ',';
	at = append(at, end, m.y);
	for (const double v : {m.sensorX, m.sensorY})
	{
		*at++ = ',';
		if (std::isfinite(v)) at = append(at, end, v);
	}
	*at++ = '\n';
	out.write(line, at - line);
}

}  // namespace ridgemap
