// SPDX-License-Identifier: BSD-3-Clause
// Pictures, CSV and atomic files.
#include <gtest/gtest.h>
#include <ridgemap/atomic_file.h>
#include <ridgemap/drawing.h>
#include <ridgemap/polyline_csv.h>
#include <ridgemap/standard_error.h>

#include <filesystem>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "test_support.h"

namespace ridgemap::test
{
namespace
{
Drawing oneWall()
{
	Drawing d;
	Polyline wall;
	wall.points = {{0, 0}, {10, 0}, {10, 8}};
	d.lines = {wall};
	return d;
}

/** Page coordinates of the frame: the box of the lines, grown by 2.5 % of its longer side, on 2000 pixels. */
cv::Vec3b pixelAt(const cv::Mat& image, double x, double y, double titleHeight)
{
	const double scale = 2000 / 10.5, left = 130, top = titleHeight;
	return image.at<cv::Vec3b>(int(top + (8.25 - y) * scale), int(left + (x + 0.25) * scale));
}

bool isDark(const cv::Vec3b& p)
{
	return p[0] + p[1] + p[2] < 300;
}

std::string svgOf(const Drawing& d)
{
	std::ostringstream out;
	writeSvg(out, d);
	return out.str();
}

}  // namespace

TEST(Png, wallsAreWhereTheyAreWithYUp)
{
	const cv::Mat image = cv::imdecode(encodePng(oneWall()), cv::IMREAD_COLOR);
	ASSERT_FALSE(image.empty());
	EXPECT_TRUE(isDark(pixelAt(image, 3, 0, 30)));
	EXPECT_TRUE(isDark(pixelAt(image, 10, 5, 30)));
	EXPECT_FALSE(isDark(pixelAt(image, 5, 5, 30)));
	EXPECT_FALSE(isDark(pixelAt(image, 0, 5, 30)));
	EXPECT_FALSE(isDark(pixelAt(image, 3, 0.1, 30)));
	EXPECT_EQ(image.at<cv::Vec3b>(0, 0), cv::Vec3b(255, 255, 255));
}

TEST(Png, odditiesDoNotStopIt)
{
	Drawing d;
	EXPECT_FALSE(encodePng(d).empty());  // nothing at all
	d.measurements = {{1, 1}};
	EXPECT_FALSE(encodePng(d).empty());  // one point
	d = oneWall();
	d.measurements = {{1e6, -1e6}, {std::numeric_limits<double>::quiet_NaN(), 0}, {5, 5}};
	d.paths = {{{2, 2}}, {}, {{-1e9, 0}, {4, 4}}};
	d.title =
		"stra\xc3\x9f"
		"e";
	d.paths.pop_back();
	EXPECT_FALSE(encodePng(d).empty());
	d.longerSide = 10;
	EXPECT_THROW(encodePng(d), std::invalid_argument);
}

TEST(Png, standardErrorsAreColours)
{
	Drawing d = oneWall();
	d.standardErrors = true;
	d.lines[0].info = {{10, 0.9f, 0.001f}, {10, 0.9f, 0.001f}, {10, 0.9f, 0.05f}};
	Polyline unknown;
	unknown.points = {{0, 5}, {4, 5}};
	unknown.info.resize(2);
	d.lines.push_back(unknown);
	const cv::Mat image = cv::imdecode(encodePng(d), cv::IMREAD_COLOR);
	EXPECT_EQ(pixelAt(image, 3, 0, 30), cv::Vec3b(156, 78, 31));    // small: blue
	EXPECT_EQ(pixelAt(image, 10, 5, 30), cv::Vec3b(43, 24, 178));   // large: red
	EXPECT_EQ(pixelAt(image, 2, 5, 30), cv::Vec3b(162, 154, 150));  // unknown: grey
	const std::string svg = svgOf(d);
	for (const char* word : {"standard error [mm]", ">1</text>", ">10</text>", ">none</text>"})
		EXPECT_NE(svg.find(word), std::string::npos) << word;
	d.lines.clear();
	EXPECT_FALSE(encodePng(d).empty());
}

TEST(Svg, linesAreInMetres)
{
	Drawing d = oneWall();
	d.title = "a <b> & \"c\"";
	const std::string svg = svgOf(d);
	EXPECT_NE(svg.find("points=\"0,0 10,0 10,8\""), std::string::npos) << svg;
	EXPECT_NE(svg.find("a &lt;b&gt; &amp; &quot;c&quot;"), std::string::npos) << svg;
}

TEST(Svg, manyMeasurementsStaySmallAndInAnyOrderTheSame)
{
	Drawing d = oneWall();
	for (int i = 0; i < 200000; i++) d.measurements.push_back({(i % 1000) * 0.01, (i / 1000) * 0.0001});
	const std::string svg = svgOf(d);
	EXPECT_LT(svg.size(), 200000u);
	std::reverse(d.measurements.begin(), d.measurements.end());
	EXPECT_EQ(svgOf(d), svg);
}

TEST(PolylineCsv, numbersComeBackExactly)
{
	Polyline a, b;
	a.points = {{0.1, -1.0 / 3}, {1e6, 5e-324}};
	b.points = {{-0.0, 2}, {123456.789012345678, 1}};
	std::ostringstream out;
	writePolylinesCsv(out, {a, b});
	std::istringstream in(out.str());
	std::string line;
	std::getline(in, line);
	EXPECT_EQ(line, "polyline,x,y");
	for (const auto& [id, p] : {std::pair{0, a.points[0]}, {0, a.points[1]}, {1, b.points[0]}, {1, b.points[1]}})
	{
		int k = -1;
		double x = 0, y = 0;
		ASSERT_TRUE(std::getline(in, line));
		ASSERT_EQ(std::sscanf(line.c_str(), "%d,%lf,%lf", &k, &x, &y), 3) << line;
		EXPECT_EQ(k, id);
		EXPECT_EQ(x, p.x);
		EXPECT_EQ(y, p.y);
	}
	EXPECT_FALSE(std::getline(in, line));
}

TEST(VerticesCsv, whatIsKnownAndWhatIsNot)
{
	Polyline line;
	line.points = {{0.1, 2}, {3, 4}};
	line.info = {{100, 0.8f}, {}};
	line.info[0].standardError = float(ridgeUncertainty(line.info[0], 0.1).standardError);
	std::ostringstream out;
	writeVerticesCsv(out, {line}, 0.1);
	std::istringstream in(out.str());
	std::string text;
	std::getline(in, text);
	EXPECT_EQ(text, "polyline,x,y,occupancy,noise,standard_error,half_width_95");
	std::getline(in, text);
	int k = -1;
	double v[6] = {};
	ASSERT_EQ(std::sscanf(text.c_str(), "%d,%lf,%lf,%lf,%lf,%lf,%lf", &k, &v[0], &v[1], &v[2], &v[3], &v[4], &v[5]), 7);
	EXPECT_EQ(k, 0);
	EXPECT_EQ(v[0], 0.1);
	EXPECT_EQ(v[2], 100);
	EXPECT_NEAR(v[3], 0.05, 1e-6);  // 1/(1 + s^2/sigma^2) = 0.8
	// s^2/(sqrt(2) L) (1 + q)^2.5/(1 + 2q)^1.5 with q = 1/4, and one and a half of 154.9 measurements used up
	EXPECT_NEAR(v[4], 0.05 * std::sqrt(1.7469281 / 1.8371173 / 141.42136 * 154.91933 / 153.41933), 1e-6);
	EXPECT_NEAR(v[5] / v[4], 1.9755, 1e-3);
	std::getline(in, text);
	EXPECT_EQ(text, "0,3,4,,,,");
	EXPECT_FALSE(std::getline(in, text));
}

TEST(AtomicFile, appearsOnCommitOnly)
{
	const TempDir dir;
	writeFile(dir / "a", "old");
	{
		AtomicFile file(dir / "a");
		file.stream() << "new";
		EXPECT_EQ(readFile(dir / "a"), "old");
	}
	EXPECT_EQ(readFile(dir / "a"), "old");
	EXPECT_EQ(dir.files().size(), 1u);
	AtomicFile file(dir / "a");
	file.stream() << "new";
	AtomicFile moved(std::move(file));
	moved.finish();
	EXPECT_EQ(readFile(dir / "a"), "old");
	moved.commit();
	EXPECT_EQ(readFile(dir / "a"), "new");
	EXPECT_EQ(dir.files().size(), 1u);
}

TEST(AtomicFile, errorsNamePathAndCause)
{
	const TempDir dir;
	const auto message = [](const std::string& path) -> std::string
	{
		try
		{
			writePolylinesCsv(path, {});
		}
		catch (const std::runtime_error& e)
		{
			return e.what();
		}
		return "";
	};
	EXPECT_EQ(message(dir / "none/x.csv"), "cannot write '" + (dir / "none/x.csv") + "': No such file or directory");
	std::filesystem::create_directory(dir / "taken");
	EXPECT_EQ(message(dir / "taken"), "cannot write '" + (dir / "taken") + "': Is a directory");
	EXPECT_EQ(message(dir / "fine.csv"), "");
	EXPECT_EQ(readFile(dir / "fine.csv"), "polyline,x,y\n");
}

}  // namespace ridgemap::test
