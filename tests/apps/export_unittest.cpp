// SPDX-License-Identifier: BSD-3-Clause
// What ridgemap-export writes is read back by programs that are not ours, and by ridgemap-import.
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/serialization/CArchive.h>
#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/simplify.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "test_support.h"

namespace ridgemap::test
{
namespace
{
constexpr double written = 1e-6, tolerance = 0.01;

using Points = std::vector<Point2>;

bool same(const Point2& a, const Point2& b)
{
	return std::abs(a.x - b.x) <= written && std::abs(a.y - b.y) <= written;
}

class Export : public ::testing::Test
{
 protected:
	static TempDir* dir;
	static std::vector<Points> expected;  ///< simplified walls; closed ones repeat their first point
	static std::size_t closed;

	static void SetUpTestSuite()
	{
		dir = new TempDir;
		writeSimplemap(*dir / "drive.simplemap", simulateDrive());
		// Something round in the next room, seen from all sides: a closed line.
		std::string ring;
		for (int i = 0; i < 400; i++)
			ring += std::to_string(4 + 0.5 * std::cos(i * M_PI / 200)) + "," +
					std::to_string(10 + 0.5 * std::sin(i * M_PI / 200)) + "\n";
		writeFile(*dir / "ring.csv", ring);
		ASSERT_EQ(runBuild({*dir / "drive.simplemap", *dir / "ring.csv", "-o", *dir / "map", "--formats", "ridgemap",
							"--set", "freeSpace=off", "-q"})
					  .code,
				  0);
		for (const Polyline& line : loadRidgeMap(*dir / "map.ridgemap").simplified(tolerance - written))
		{
			expected.push_back(line.points);
			closed += line.closed ? 1 : 0;
		}
		ASSERT_GT(expected.size(), closed);
		ASSERT_GT(closed, 0u);
	}
	static void TearDownTestSuite()
	{
		delete dir;
		dir = nullptr;
		expected.clear();
	}

	static std::string exported(const std::string& name, std::vector<std::string> arguments = {})
	{
		const std::string path = *dir / name;
		arguments.insert(arguments.begin(), {*dir / "map.ridgemap", "-o", path, "--tolerance", "0.01"});
		const RunResult r = run(RIDGEMAP_EXPORT_PROGRAM, arguments);
		EXPECT_EQ(r.code, 0) << r.err;
		return path;
	}

	/** The points, and how many lines end where they begin. */
	static void expectSame(const std::vector<Points>& lines)
	{
		const auto isRing = [](const Points& p) { return p.size() > 3 && same(p.front(), p.back()); };
		EXPECT_EQ(std::size_t(std::count_if(lines.begin(), lines.end(), isRing)), closed);
		ASSERT_EQ(lines.size(), expected.size());
		for (std::size_t i = 0; i < lines.size(); i++)
		{
			ASSERT_EQ(lines[i].size(), expected[i].size()) << i;
			for (std::size_t k = 0; k < lines[i].size(); k++)
			{
				EXPECT_NEAR(lines[i][k].x, expected[i][k].x, written);
				EXPECT_NEAR(lines[i][k].y, expected[i][k].y, written);
			}
		}
	}
};

TempDir* Export::dir = nullptr;
std::vector<Points> Export::expected;
std::size_t Export::closed = 0;

/** The numbers of a text, two by two. */
Points pairsOf(std::string text)
{
	for (char& c : text)
		if (std::string("0123456789.-+e").find(c) == std::string::npos) c = ' ';
	std::istringstream in(text);
	Points points;
	for (Point2 p; in >> p.x >> p.y;) points.push_back(p);
	return points;
}

/** The geometries that GDAL's ogrinfo prints as WKT. */
std::vector<Points> readByGdal(const std::string& path, std::size_t* polygons = nullptr)
{
	const RunResult r = run("/usr/bin/ogrinfo", {"-ro", "-al", path});
	EXPECT_EQ(r.code, 0) << r.err << " (is gdal-bin installed?)";
	std::vector<Points> lines;
	std::istringstream in(r.out);
	for (std::string line; std::getline(in, line);)
	{
		const bool polygon = line.find("  POLYGON") == 0;
		if (!polygon && line.find("  LINESTRING") != 0) continue;
		if (polygons && polygon) ++*polygons;
		lines.push_back(pairsOf(line.substr(line.find('('))));
	}
	return lines;
}
}  // namespace

TEST_F(Export, dxfByGdal)
{
	const std::string path = exported("map.dxf");
	expectSame(readByGdal(path));
	EXPECT_NE(readFile(path).find("$INSUNITS\n70\n6\n"), std::string::npos) << "not in metres";
	const RunResult layer = run("/usr/bin/ogrinfo", {"-ro", "-al", "-where", "Layer='walls'", path});
	EXPECT_NE(layer.out.find("Feature Count: " + std::to_string(expected.size())), std::string::npos) << layer.out;
	// The flag of POLYLINE, behind its group code.
	std::size_t flags = 0;
	const std::string text = readFile(path), closedPolyline = "POLYLINE\n8\nwalls\n66\n1\n70\n1\n";
	for (auto at = text.find(closedPolyline); at != std::string::npos; at = text.find(closedPolyline, at + 1)) flags++;
	EXPECT_EQ(flags, closed);
}

TEST_F(Export, geoJsonByGdal)
{
	std::size_t polygons = 0;
	expectSame(readByGdal(exported("map.geojson"), &polygons));
	EXPECT_EQ(polygons, closed);
}

TEST_F(Export, wktByGdal)
{
	// OGR reads WKT from a column of a CSV file.
	std::istringstream in(readFile(exported("map.wkt")));
	std::string csv = "id,WKT\n";
	for (std::string line; std::getline(in, line);) csv += "1,\"" + line + "\"\n";
	writeFile(*dir / "wkt.csv", csv);
	expectSame(readByGdal(*dir / "wkt.csv"));
}

TEST_F(Export, svgByAnXmlParser)
{
	tinyxml2::XMLDocument document;
	ASSERT_EQ(document.LoadFile(exported("map.svg").c_str()), tinyxml2::XML_SUCCESS);
	const auto* turned = document.RootElement()->FirstChildElement("g");
	ASSERT_TRUE(turned);
	EXPECT_STREQ(turned->Attribute("transform"), "scale(1,-1)");
	const auto* walls = turned->FirstChildElement("g");
	ASSERT_TRUE(walls);
	EXPECT_STREQ(walls->Attribute("id"), "walls");
	std::vector<Points> lines;
	for (const auto* e = walls->FirstChildElement(); e; e = e->NextSiblingElement())
	{
		lines.push_back(pairsOf(e->Attribute("points")));
		if (std::string(e->Name()) == "polygon") lines.back().push_back(lines.back().front());
	}
	expectSame(lines);
}

TEST_F(Export, csv)
{
	std::istringstream in(readFile(exported("map.csv")));
	std::string line;
	std::getline(in, line);
	EXPECT_EQ(line, "layer,polyline,closed,x,y");
	std::vector<Points> lines;
	std::size_t marked = 0;
	while (std::getline(in, line))
	{
		std::string layer, index, isClosed, rest;
		std::istringstream fields(line);
		std::getline(std::getline(std::getline(fields, layer, ','), index, ','), isClosed, ',');
		std::getline(fields, rest);
		EXPECT_EQ(layer, "walls");
		lines.resize(std::stoul(index) + 1);
		lines.back().push_back(pairsOf(rest).at(0));
		if (lines.back().size() == 1 && isClosed == "1") marked++;
	}
	expectSame(lines);
	EXPECT_EQ(marked, closed);
}

TEST_F(Export, sceneByMrpt)
{
	mrpt::opengl::COpenGLScene scene;
	ASSERT_TRUE(scene.loadFromFile(exported("map.3Dscene")));
	const auto lines = std::dynamic_pointer_cast<mrpt::opengl::CSetOfLines>(scene.getByName("walls"));
	ASSERT_TRUE(lines);
	std::size_t segment = 0;
	for (const Points& p : expected)
		for (std::size_t i = 1; i < p.size(); i++, segment++)
		{
			ASSERT_LT(segment, lines->size());
			double x0 = 0, y0 = 0, z0 = 0, x1 = 0, y1 = 0, z1 = 0;
			lines->getLineByIndex(segment, x0, y0, z0, x1, y1, z1);
			// The scene holds single precision.
			for (const double off : {x0 - p[i - 1].x, y0 - p[i - 1].y, z0, x1 - p[i].x, y1 - p[i].y, z1})
				EXPECT_NEAR(off, 0, 2 * written);
		}
	EXPECT_EQ(lines->size(), segment);
}

TEST_F(Export, pictureByMrpt)
{
	mrpt::img::CImage image;
	ASSERT_TRUE(image.loadFromFile(exported("map.png")));
	std::size_t drawn = 0;
	for (std::size_t y = 0; y < image.getHeight(); y++)
		for (std::size_t x = 0; x < image.getWidth(); x++) drawn += *image.ptr<uint8_t>(int(x), int(y)) < 200;
	// Thin lines on white: more than the diagonal, and not an area.
	EXPECT_GT(drawn, image.getWidth());
	EXPECT_LT(drawn, image.getWidth() * image.getHeight() / 4);
}

TEST_F(Export, gridByMrpt)
{
	mrpt::maps::COccupancyGridMap2D grid;
	{
		mrpt::io::CFileGZInputStream file(
			exported("map.gridmap.gz", {"--free-space", *dir / "drive.simplemap", "--resolution", "0.02"}));
		mrpt::serialization::archiveFrom(file) >> grid;
	}
	EXPECT_NEAR(grid.getResolution(), 0.02, 1e-6);
	for (const Points& line : expected)
		for (std::size_t i = 1; i < line.size(); i++)
		{
			const double x = 0.5 * (line[i - 1].x + line[i].x), y = 0.5 * (line[i - 1].y + line[i].y);
			EXPECT_LT(grid.getPos(float(x), float(y)), 0.1f) << x << ' ' << y;
		}
	EXPECT_GT(grid.getPos(2.5f, 2.0f), 0.9f) << "where the robot drove";
	EXPECT_NEAR(grid.getPos(-0.3f, 3.0f), 0.5f, 0.05f) << "behind the wall";
}

TEST_F(Export, rosMapByMrpt)
{
	const std::string path = exported("map.yaml", {"--free-space", *dir / "drive.simplemap"});
	const auto converted = mrpt::maps::COccupancyGridMap2D::FromROSMapServerYAML(path);
	mrpt::maps::COccupancyGridMap2D grid;
	{
		mrpt::io::CFileGZInputStream file(exported("same.gridmap.gz", {"--free-space", *dir / "drive.simplemap"}));
		mrpt::serialization::archiveFrom(file) >> grid;
	}
	EXPECT_NEAR(converted.getResolution(), 0.05, 1e-6);
	std::size_t occupied = 0, differing = 0;
	for (double x = -0.225; x < 8.3; x += 0.05)
		for (double y = -0.225; y < 6.3; y += 0.05)
		{
			const float a = grid.getPos(float(x), float(y)), b = converted.getPos(float(x), float(y));
			occupied += a < 0.3f ? 1 : 0;
			differing += (a < 0.3f) != (b < 0.3f) || (a > 0.7f) != (b > 0.7f) ? 1 : 0;
		}
	EXPECT_GT(occupied, 300u);
	EXPECT_EQ(differing, 0u);
}

TEST_F(Export, rosMapByTheProgramOfMrpt)
{
	const std::string program = "/usr/bin/ros-map-yaml2mrpt";
	if (!std::filesystem::exists(program)) GTEST_SKIP() << "mrpt-apps is not installed";
	const std::string path = exported("ros.yaml", {"--resolution", "0.02"});
	const RunResult r = run(program, {"-w", "-i", path});
	ASSERT_EQ(r.code, 0) << r.out << r.err;
	mrpt::maps::COccupancyGridMap2D grid;
	{
		mrpt::io::CFileGZInputStream file(*dir / "ros.gridmap.gz");
		mrpt::serialization::archiveFrom(file) >> grid;
	}
	EXPECT_NEAR(grid.getResolution(), 0.02, 1e-6);
	for (const Points& line : expected)
		for (const Point2& p : line)
		{
			// On the border of two cells, single precision may take the one beside.
			float least = 1;
			for (const double dx : {-0.001, 0.001})
				for (const double dy : {-0.001, 0.001})
					least = std::min(least, grid.getPos(float(p.x + dx), float(p.y + dy)));
			EXPECT_LT(least, 0.3f) << p.x << ' ' << p.y;
		}
	EXPECT_NEAR(grid.getPos(2.5f, 2.0f), 0.5f, 0.1f) << "nobody said that this is free";
}

TEST_F(Export, frozenMap)
{
	const std::string path = exported("frozen.ridgemap", {"--frozen"});
	const CRidgeMap2D map = loadRidgeMap(path);
	EXPECT_TRUE(map.isFrozen());
	std::vector<Points> lines;
	for (const Polyline& line : map.walls()) lines.push_back(line.points);
	expectSame(lines);
	EXPECT_LT(std::filesystem::file_size(path), 3000u);
	EXPECT_NE(runInfo({path}).out.find("frozen"), std::string::npos);
	EXPECT_NE(runBuild({path, *dir / "drive.simplemap", "-o", *dir / "more"}).err.find("frozen"), std::string::npos);
}

TEST_F(Export, plansComeBack)
{
	for (const char* name : {"plan.dxf", "plan.geojson", "plan.svg"})
	{
		const RunResult r = run(RIDGEMAP_IMPORT_PROGRAM, {exported(name), "-o", *dir / "plan.ridgemap"});
		ASSERT_EQ(r.code, 0) << r.err;
		const CRidgeMap2D map = loadRidgeMap(*dir / "plan.ridgemap");
		EXPECT_TRUE(map.isFrozen());
		std::vector<Points> lines;
		std::size_t rings = 0;
		for (const Polyline& line : map.walls())
		{
			lines.push_back(line.points);
			rings += line.closed ? 1 : 0;
		}
		expectSame(lines);
		EXPECT_EQ(rings, closed) << name;
	}
}

TEST_F(Export, svgOfOtherPrograms)
{
	writeFile(
		*dir / "other.svg",
		"<svg xmlns='http://www.w3.org/2000/svg' width='200mm' viewBox='0 0 100 50'><defs><path d='M0 0L9 9'/></defs>"
		"<g transform='translate(10,0) scale(2)'><path d='m1,1 h2 v3 z M 5 5 C 5 6 6 6 6 5'/></g>"
		"<text>no line</text><rect x='1' y='2' width='3' height='4'/></svg>");
	const RunResult r = run(RIDGEMAP_IMPORT_PROGRAM, {*dir / "other.svg", "-o", *dir / "other.ridgemap"});
	ASSERT_EQ(r.code, 0) << r.err;
	EXPECT_NE(r.out.find("left out      1 "), std::string::npos) << r.out;
	const auto lines = loadRidgeMap(*dir / "other.ridgemap").walls();
	ASSERT_EQ(lines.size(), 3u);
	EXPECT_TRUE(lines[0].closed);
	EXPECT_FALSE(lines[1].closed);
	EXPECT_TRUE(lines[2].closed);
	EXPECT_NEAR(lines[0].points[1].x, 0.002 * 16, written);
	EXPECT_NEAR(lines[0].points[2].y, -0.002 * 8, written);
	EXPECT_NEAR(lines[1].points[8].y, -0.002 * 2 * 5.75, written);
	EXPECT_NEAR(lines[2].points[0].y, -0.002 * 2, written);
}

TEST_F(Export, wrongUseIsExplained)
{
	const std::string map = *dir / "map.ridgemap", out = *dir / "wrong";
	const auto errorOf = [&](const std::vector<std::string>& arguments)
	{
		const RunResult r = run(RIDGEMAP_EXPORT_PROGRAM, arguments);
		EXPECT_NE(r.code, 0);
		return r.err;
	};
	EXPECT_NE(errorOf({map, "-o", out + ".doc"}).find(".geojson"), std::string::npos);
	EXPECT_NE(errorOf({map, "-o", out + ".ridgemap"}).find("--frozen"), std::string::npos);
	EXPECT_NE(errorOf({map, "-o", out + ".svg", "--tolerance", "-1"}).find("--tolerance"), std::string::npos);
	EXPECT_NE(errorOf({map, "-o", out + ".svg", "--free-space", map}).find("grids"), std::string::npos);
	EXPECT_NE(errorOf({map}).find("-o FILE"), std::string::npos);
	EXPECT_FALSE(std::filesystem::exists(out + ".svg"));
	// No DXF file; one that was cut off, for which GDAL waits for ever; one that was cut off between two lines.
	const std::string header = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES";
	for (const std::string& content :
		 {std::string("nothing"), header + "\r", header + "\n0\nLINE\n10\n1\n20\n1\n11\n2\n21\n2\n"})
	{
		writeFile(*dir / "bad.dxf", content);
		const RunResult r = run(RIDGEMAP_IMPORT_PROGRAM, {*dir / "bad.dxf", "-o", out + ".ridgemap"});
		EXPECT_EQ(r.code, 1);
		EXPECT_NE(r.err.find("bad.dxf' is cut off"), std::string::npos) << r.err;
		EXPECT_FALSE(std::filesystem::exists(out + ".ridgemap"));
	}
}

}  // namespace ridgemap::test
