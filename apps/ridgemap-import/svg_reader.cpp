// SPDX-License-Identifier: BSD-3-Clause
#include <tinyxml2.h>

#include <cmath>
#include <map>

#include "../common/gz_input.h"
#include "../common/user_error.h"
#include "plan_readers.h"

namespace ridgemap::apps
{
namespace
{
using tinyxml2::XMLElement;

/** x' = a x + c y + e, y' = b x + d y + f, as SVG's matrix(a b c d e f). */
struct Transform
{
	double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

	Point2 operator()(const Point2& p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
	/** First `o`, then this. */
	Transform after(const Transform& o) const
	{
		return {a * o.a + c * o.b, b * o.a + d * o.b,     a * o.c + c * o.d,
				b * o.c + d * o.d, a * o.e + c * o.f + e, b * o.e + d * o.f + f};
	}
};

Transform makeTransform(const std::string& name, const std::vector<double>& v)
{
	const auto at = [&](std::size_t i, double otherwise) { return i < v.size() ? v[i] : otherwise; };
	if (name == "matrix" && v.size() == 6) return {v[0], v[1], v[2], v[3], v[4], v[5]};
	if (name == "translate" && !v.empty()) return {1, 0, 0, 1, v[0], at(1, 0)};
	if (name == "scale" && !v.empty()) return {v[0], 0, 0, at(1, v[0]), 0, 0};
	if (name == "rotate" && !v.empty())
	{
		const double angle = v[0] * std::acos(-1.0) / 180, c = std::cos(angle), s = std::sin(angle);
		const double x = at(1, 0), y = at(2, 0);
		return {c, s, -s, c, x - c * x + s * y, y - s * x - c * y};
	}
	throw std::invalid_argument("the transform '" + name + "' is not supported");
}

/** A list such as `translate(1,2) scale(3)`: the last one comes first. */
Transform parseTransform(const std::string& text)
{
	Transform all;
	for (std::size_t at = 0;;)
	{
		at = text.find_first_not_of(" ,\t\r\n", at);
		if (at == std::string::npos) return all;
		const auto open = text.find('(', at), close = text.find(')', at);
		if (open == std::string::npos || close == std::string::npos || close < open)
			throw std::invalid_argument("wrong transform '" + text + "'");
		std::string name = text.substr(at, open - at);
		name.erase(name.find_last_not_of(" \t\r\n") + 1);
		all = all.after(makeTransform(name, parseNumbers(text.substr(open + 1, close - open - 1))));
		at = close + 1;
	}
}

std::string text(const XMLElement& element, const char* name)
{
	const char* value = element.Attribute(name);
	return value ? value : "";
}

double numberOf(const XMLElement& element, const char* name)
{
	const auto numbers = parseNumbers(text(element, name));
	return numbers.empty() ? 0 : numbers.front();
}

Polyline fromPairs(const std::vector<double>& v, bool closed)
{
	Polyline line;
	for (std::size_t i = 0; i + 1 < v.size(); i += 2) line.points.push_back({v[i], v[i + 1]});
	if (closed && line.points.size() > 2)
	{
		if (line.points.front() != line.points.back()) line.points.push_back(line.points.front());
		line.closed = true;
	}
	return line;
}

/** The lines of one element itself; `known` says whether it can have any. */
std::vector<Polyline> linesOf(const XMLElement& element, bool& known)
{
	const std::string name = element.Name();
	known = true;
	if (name == "path") return parseSvgPath(text(element, "d"));
	if (name == "polyline" || name == "polygon")
		return {fromPairs(parseNumbers(text(element, "points")), name == "polygon")};
	const auto n = [&](const char* attribute) { return numberOf(element, attribute); };
	if (name == "line") return {fromPairs({n("x1"), n("y1"), n("x2"), n("y2")}, false)};
	if (name == "rect")
	{
		const double x = n("x"), y = n("y"), w = n("width"), h = n("height");
		return {fromPairs({x, y, x + w, y, x + w, y + h, x, y + h}, true)};
	}
	known = name == "g" || name == "svg" || name == "a" || name == "title" || name == "desc" || name == "metadata" ||
			name == "style";
	return {};
}

bool isShown(const std::string& name)
{
	return name != "defs" && name != "symbol" && name != "clipPath" && name != "mask" && name != "pattern";
}

void collect(const XMLElement& element, const Transform& outer, bool wanted, const std::set<std::string>& layers,
			 Plan& plan)
{
	if (!isShown(element.Name())) return;
	const Transform transform = outer.after(parseTransform(text(element, "transform")));
	wanted = wanted || layers.count(text(element, "id")) != 0;
	bool known = false;
	for (Polyline& line : linesOf(element, known))
	{
		if (!wanted || line.points.size() < 2) continue;
		for (Point2& p : line.points)
		{
			p = transform(p);
			p.y = -p.y;  // y grows downwards in SVG
		}
		plan.lines.push_back(std::move(line));
	}
	if (wanted && !known) plan.leftOut++;
	for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
		collect(*child, transform, wanted, layers, plan);
}

/** Metres of a length such as `210mm`; 0 if it has no physical unit. */
double physicalLength(const std::string& length)
{
	static const std::map<std::string, double> units{{"mm", 0.001}, {"cm", 0.01}, {"in", 0.0254}, {"m", 1}};
	const auto end = length.find_last_of("0123456789.");
	if (end == std::string::npos) return 0;
	const auto unit = units.find(length.substr(end + 1));
	return unit == units.end() ? 0 : unit->second * parseNumbers(length.substr(0, end + 1)).front();
}

double unitOf(const XMLElement& svg)
{
	const double width = physicalLength(text(svg, "width"));
	const auto view = parseNumbers(text(svg, "viewBox"));
	return width > 0 && view.size() == 4 && view[2] > 0 ? width / view[2] : 1;
}
}  // namespace

Plan readSvg(const std::string& path, const std::set<std::string>& layers)
{
	GzInput input(path);
	std::string content;
	for (char part[1 << 14];;)
	{
		const std::size_t n = input.Read(part, sizeof(part));
		content.append(part, n);
		if (n < sizeof(part)) break;
	}
	tinyxml2::XMLDocument document;
	if (document.Parse(content.data(), content.size()) != tinyxml2::XML_SUCCESS)
		throw UserError("'" + path + "' is no XML: " + document.ErrorStr(), "give an SVG file");
	const XMLElement* svg = document.RootElement();
	if (!svg || std::string(svg->Name()) != "svg") throw UserError("'" + path + "' is no SVG", "give an SVG file");
	Plan plan;
	try
	{
		plan.metresPerUnit = unitOf(*svg);
		collect(*svg, Transform(), layers.empty(), layers, plan);
	}
	catch (const std::invalid_argument& e)
	{
		throw UserError("'" + path + "': " + e.what(), "convert paths to straight segments, or save it as DXF");
	}
	return plan;
}

}  // namespace ridgemap::apps
