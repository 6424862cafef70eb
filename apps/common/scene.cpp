// SPDX-License-Identifier: BSD-3-Clause
#include "scene.h"

#include <ridgemap/options.h>

#include <cstdio>
#include <ostream>

#include "gz_input.h"
#include "number_line.h"
#include "user_error.h"

namespace ridgemap::apps
{
namespace
{
constexpr double pi = 3.14159265358979323846;
constexpr double chordError = 1e-5;  // [m]

/** Lines of fields of a text file, with errors that name the line. */
class FieldFile
{
 public:
	FieldFile(const std::string& path, const std::string& remedy) : input_(path), remedy_(remedy) {}

	/** The next line that is not blank; false at the end. */
	bool next(std::vector<std::string>& fields)
	{
		for (std::string text; input_.readLine(text);)
		{
			line_++;
			fields = splitFields(text);
			if (!fields.empty()) return true;
		}
		return false;
	}

	[[noreturn]] void fail(const std::string& why) const
	{
		throw UserError(input_.path() + ":" + std::to_string(line_) + ": " + why, remedy_);
	}

	/** The fields from `first` on as coordinates and the like. */
	std::vector<double> numbers(const std::vector<std::string>& fields, std::size_t first) const
	{
		std::vector<double> values;
		for (std::size_t i = first; i < fields.size(); i++)
		{
			const auto v = parseNumber(fields[i]);
			if (!v || !(std::abs(*v) <= maxCoordinate))
				fail("'" + fields[i].substr(0, 40) + "' is not a number within +-1e6");
			values.push_back(*v);
		}
		return values;
	}

 private:
	GzInput input_;
	std::string remedy_;
	std::size_t line_ = 0;
};

/** A line of a scene without `during`. */
void readThing(const FieldFile& file, const std::vector<std::string>& fields, Scene& scene)
{
	const std::vector<double> v = file.numbers(fields, 1);
	const std::string& what = fields[0];
	const auto need = [&](bool right, const char* form)
	{
		if (!right) file.fail("expected '" + what + " " + form + "'");
	};
	if (what == "wall")
	{
		need(v.size() == 4, "x1 y1 x2 y2");
		scene.addWall({v[0], v[1]}, {v[2], v[3]});
	}
	else if (what == "arc")
	{
		need(v.size() == 5 && v[2] > 0 && v[4] > v[3] && v[4] <= v[3] + 360, "cx cy radius from to', angles rising");
		scene.addArc({v[0], v[1]}, v[2], v[3] * pi / 180, v[4] * pi / 180);
	}
	else if (what == "glass")
	{
		need(v.size() == 6 && v[0] >= 0 && v[0] <= 1 && v[1] > 0 && v[1] <= 90,
			 "share angle x1 y1 x2 y2', share 0 .. 1");
		scene.addWall({v[2], v[3]}, {v[4], v[5]});
		scene.surfaces.back().returned = v[0];
		scene.surfaces.back().widest = v[1] * pi / 180;
	}
	else if (what == "posts")
	{
		need(v.size() == 6 && v[0] > 0 && v[1] > 0 && std::hypot(v[4] - v[2], v[5] - v[3]) <= 1000 * v[1],
			 "radius spacing x1 y1 x2 y2', up to 1000 posts");
		scene.addPosts(v[0], v[1], {v[2], v[3]}, {v[4], v[5]});
	}
	else if (what == "path")
	{
		need(v.size() >= 2 && v.size() % 2 == 0, "x1 y1 x2 y2 ...");
		for (std::size_t i = 0; i < v.size(); i += 2) scene.path.push_back({v[i], v[i + 1]});
	}
	else if (what == "mover")
	{
		need(v.size() == 6 && v[0] > 0 && v[1] >= 0, "radius speed x1 y1 x2 y2");
		scene.movers.push_back({v[0], v[1], {v[2], v[3]}, {v[4], v[5]}, {}});
	}
	else
		file.fail("unknown word '" + what.substr(0, 40) + "'");
}

void readSceneLine(const FieldFile& file, std::vector<std::string> fields, Scene& scene)
{
	if (fields[0] != "during") return readThing(file, fields, scene);
	if (fields.size() < 4 || fields[3] == "path") file.fail("expected 'during from to' and a thing, not the path");
	const std::vector<double> times = file.numbers({fields[1], fields[2]}, 0);
	if (!(times[0] < times[1])) file.fail("expected 'during from to' with rising times");
	fields.erase(fields.begin(), fields.begin() + 3);
	const std::size_t surfaces = scene.surfaces.size(), movers = scene.movers.size();
	readThing(file, fields, scene);
	const Presence when{times[0], times[1]};
	for (std::size_t i = surfaces; i < scene.surfaces.size(); i++) scene.surfaces[i].when = when;
	for (std::size_t i = movers; i < scene.movers.size(); i++) scene.movers[i].when = when;
}

}  // namespace

double Surface::returnedAlong(double dx, double dy) const
{
	if (opaque()) return 1;
	const double along = std::abs(dx * (shape.b.x - shape.a.x) + dy * (shape.b.y - shape.a.y)) / shape.length();
	return std::asin(std::min(1.0, along)) <= widest ? returned : 0;
}

Point2 Mover::at(double time) const
{
	const double length = std::hypot(b.x - a.x, b.y - a.y);
	if (!(length > 0)) return a;
	const double walked = std::fmod(time * speed, 2 * length);
	const double t = (walked <= length ? walked : 2 * length - walked) / length;
	return Segment{a, b}.at(t);
}

void Scene::addArc(Point2 centre, double radius, double from, double to)
{
	const double chord = 2 * std::acos(std::max(0.0, 1 - chordError / radius));
	const int n = std::max(1, int(std::ceil((to - from) / chord)));
	const auto at = [&](int i)
	{
		const double angle = from + (to - from) * i / n;
		return Point2{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
	};
	for (int i = 0; i < n; i++) addWall(at(i), at(i + 1));
}

void Scene::addPosts(double radius, double spacing, Point2 a, Point2 b)
{
	const Segment row{a, b};
	const double length = row.length();
	const int gaps = int(std::floor(length / spacing * (1 + 1e-12)));
	for (int i = 0; i <= gaps; i++) addArc(row.at(length > 0 ? i * spacing / length : 0), radius, 0, 2 * pi);
}

Scene hallwayScene()
{
	Scene s;
	s.addWall({0, 0}, {16, 0});
	s.addWall({16, 0}, {16, 16});
	s.addWall({0, 6}, {10, 6});
	s.addWall({10, 6}, {10, 16});
	s.path = {{2, 3}, {9, 3}, {11, 3.3}, {13.3, 2.7}, {13, 5}, {13, 14}};
	return s;
}

Scene wallScene()
{
	Scene s;
	s.addWall({0, 0}, {10, 0});
	s.path = {{0, 2}, {10, 2}};
	return s;
}

Scene cornerScene()
{
	Scene s;
	s.addWall({0, 0}, {5, 0});
	s.addWall({0, 0}, {0, 5});
	s.path = {{4, 1.5}, {1.5, 1.5}, {1.5, 4}};
	return s;
}

Scene readScene(const std::string& path)
{
	FieldFile file(path, "see ridgemap-simulate --help for the lines of a scene");
	Scene scene;
	for (std::vector<std::string> fields; file.next(fields);) readSceneLine(file, fields, scene);
	if (scene.surfaces.empty()) file.fail("the scene has no surface");
	if (scene.path.empty()) file.fail("the scene has no path");
	return scene;
}

std::vector<Segment> readTruth(const std::string& path)
{
	FieldFile file(path, "give x1,y1,x2,y2 or x1,y1,x2,y2,seen in metres on every line");
	std::vector<Segment> truth;
	bool first = true;
	for (std::vector<std::string> fields; file.next(fields); first = false)
	{
		if (first && fields[0] == "x1") continue;
		if (fields.size() == 6 && !parseNumber(fields[5])) fields.resize(4);  // number and name of a surface
		const std::vector<double> v = file.numbers(fields, 0);
		if (v.size() != 4 && v.size() != 5) file.fail("expected 4 or 5 numbers, found " + std::to_string(v.size()));
		truth.push_back({{v[0], v[1]}, {v[2], v[3]}, v.size() < 5 || v[4] != 0});
	}
	if (truth.empty()) file.fail("the file holds no segment");
	return truth;
}

void writeTruth(std::ostream& out, const std::vector<Segment>& truth)
{
	out << "x1,y1,x2,y2,seen\n";
	for (const Segment& s : truth)
	{
		char line[160];
		std::snprintf(line, sizeof(line), "%.17g,%.17g,%.17g,%.17g,%d\n", s.a.x, s.a.y, s.b.x, s.b.y, int(s.seen));
		out << line;
	}
}

}  // namespace ridgemap::apps
