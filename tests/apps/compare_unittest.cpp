// SPDX-License-Identifier: BSD-3-Clause
// The report of ridgemap-compare.
#include <gtest/gtest.h>
#include <mrpt/containers/yaml.h>

#include <algorithm>
#include <map>

#include "test_support.h"

namespace ridgemap::test
{
TEST(Compare, reportOfARoom)
{
	const TempDir dir;
	writeSimplemap(dir / "drive.simplemap", simulateDrive());
	writeFile(dir / "truth.csv", "0,0,8,0,0\n8,0,8,6\n8,6,0,6\n0,6,0,0\n");
	const RunResult r = run(RIDGEMAP_COMPARE_PROGRAM, {dir / "drive.simplemap", "--truth", dir / "truth.csv", "--folds",
													   "2", "-o", dir / "report"});
	ASSERT_EQ(r.code, 0) << r.err;
	const auto report = mrpt::containers::yaml::FromText(readFile(dir / "report/report.json"));
	EXPECT_EQ(report["scans"].as<int>(), 24);
	const auto maps = report["maps"];
	ASSERT_EQ(maps.asSequence().size(), 8u);
	std::map<std::string, double> error, bytes;
	for (std::size_t i = 0; i < 8; i++)
	{
		const auto map = maps(int(i));
		const std::string name = map["name"].as<std::string>();
		// Longer names are in several lines above their column.
		EXPECT_NE(r.out.find(name.substr(0, name.find(' ', 6))), std::string::npos) << name;
		error[name] = map["surfaceToTruth"]["median"].as<double>();
		bytes[name] = map["bytesSerialized"].as<double>();
		EXPECT_GT(map["heldOutScans"]["count"].as<double>(), 4000) << name;
		EXPECT_LT(map["heldOutScans"]["median"].as<double>(), 0.04) << name;
		for (const char* what : {"insertion", "likelihood", "matching"})
			EXPECT_GT(map[what]["medianUs"].as<double>(), 0) << name << ' ' << what;
		EXPECT_GT(map["likelihood"]["againMedianUs"].as<double>(), 0) << name;
		// Twelve of the scans are localised in the map of the others, three times, and the first five do not count.
		for (const char* which : {"localization", "localizationInReducedMap"})
		{
			EXPECT_EQ(map[which]["count"].as<int>(), 3 * 7) << name;
			EXPECT_LT(map[which]["positionMedian"].as<double>(), 0.06) << name;
			EXPECT_EQ(map[which]["shareLost"].as<double>(), 0) << name;
		}
	}
	// Noise of 1 cm: the ridge averages it, cells and points do not.
	EXPECT_LT(error["ridge map"], 0.005);
	EXPECT_GT(error["grid 5 cm"], 2 * error["ridge map"]);
	EXPECT_GT(bytes["grid 2 cm"], 5 * bytes["grid 5 cm"]);
	const std::string html = readFile(dir / "report/report.html");
	EXPECT_NE(html.find("</html>"), std::string::npos);
	EXPECT_NE(html.find("data:image/png;base64,"), std::string::npos);
	for (const char* outside : {"src=\"http", "href=", "<script", "@import"})
		EXPECT_EQ(html.find(outside), std::string::npos) << outside;
}

TEST(Compare, secondPassOfItsOwn)
{
	const TempDir dir;
	auto drive = simulateDrive(12);
	writeSimplemap(dir / "drive.simplemap", drive);
	// What stands elsewhere is not found: the second pass says that the robot was 1 m beside where it was.
	for (PosedScan& s : drive) s.pose.x(s.pose.x() + 1);
	writeSimplemap(dir / "beside.simplemap", drive);
	const auto medians = [&](const std::string& secondPass)
	{
		const RunResult r = run(RIDGEMAP_COMPARE_PROGRAM, {dir / "drive.simplemap", "--second-pass", dir / secondPass,
														   "--folds", "0", "-o", dir / "report"});
		EXPECT_EQ(r.code, 0) << r.err;
		EXPECT_NE(r.out.find("Localisation of a second pass"), std::string::npos) << r.out;
		const auto report = mrpt::containers::yaml::FromText(readFile(dir / "report/report.json"));
		EXPECT_EQ(report["secondPass"].as<std::string>(), secondPass);
		std::vector<double> all;
		for (int i = 0; i < 8; i++) all.push_back(report["maps"](i)["localization"]["positionMedian"].as<double>());
		return all;
	};
	for (const double median : medians("drive.simplemap")) EXPECT_LT(median, 0.06);
	for (const double median : medians("beside.simplemap")) EXPECT_GT(median, 0.2);
}

TEST(Compare, pointsAreMadeScans)
{
	const TempDir dir;
	const std::string hallway = RIDGEMAP_DATASETS "/hallway/hallway";
	const RunResult r = run(RIDGEMAP_COMPARE_PROGRAM, {hallway + ".simplemap.gz", "--truth", hallway + "_truth.csv",
													   "--sigma", "0.1", "--folds", "0", "-o", dir / "report"});
	ASSERT_EQ(r.code, 0) << r.err;
	const auto report = mrpt::containers::yaml::FromText(readFile(dir / "report/report.json"));
	EXPECT_EQ(report["scansMadeOfPoints"].as<int>(), 91);
	const auto maps = report["maps"];
	ASSERT_EQ(maps.asSequence().size(), 5u) << "points have no beam angles to be wrong about";
	for (int i = 0; i < 5; i++) EXPECT_GT(maps(i)["completeness"].as<double>(), 0.85);
	// The points map keeps every measurement of the data set.
	EXPECT_EQ(maps(4)["surfaceToTruth"]["count"].as<int>(), 13829);
	EXPECT_LT(maps(0)["surfaceToTruth"]["rmsBelow10cm"].as<double>(), 0.01);
	EXPECT_EQ(r.out.find("Localisation"), std::string::npos) << "nothing was there to localise";
}

TEST(Compare, wrongUseIsExplained)
{
	const TempDir dir;
	writeFile(dir / "points.csv", "1,2\n3,4\n");
	const auto errorOf = [&](const std::vector<std::string>& arguments)
	{
		const RunResult r = run(RIDGEMAP_COMPARE_PROGRAM, arguments);
		EXPECT_NE(r.code, 0);
		return r.err;
	};
	EXPECT_NE(errorOf({dir / "points.csv", "-o", dir / "r"}).find("scans"), std::string::npos);
	EXPECT_NE(errorOf({dir / "points.csv"}).find("-o DIR"), std::string::npos);
	EXPECT_NE(errorOf({dir / "points.csv", "-o", dir / "r", "--folds", "1"}).find("--folds"), std::string::npos);
}

}  // namespace ridgemap::test
