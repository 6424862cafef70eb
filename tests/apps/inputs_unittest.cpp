// SPDX-License-Identifier: BSD-3-Clause
// Every kind of input, as a user gives it to ridgemap-build.
#include <gtest/gtest.h>
#include <mrpt/containers/yaml.h>

#include <cmath>
#include <sstream>

#include "test_support.h"

namespace ridgemap::test
{
namespace
{
const std::vector<std::string> csvOnly{"--formats", "walls,ridges,measurements,stats"};

std::vector<std::string> arguments(std::vector<std::string> a)
{
	a.insert(a.end(), csvOnly.begin(), csvOnly.end());
	return a;
}

/** Builds and returns the statistics; fails the test if the program fails. */
mrpt::containers::yaml build(const std::vector<std::string>& inputs, const std::string& prefix,
							 const std::vector<std::string>& options = {})
{
	std::vector<std::string> a = inputs;
	a.insert(a.end(), options.begin(), options.end());
	a.insert(a.end(), {"-o", prefix});
	const RunResult r = runBuild(arguments(a));
	EXPECT_EQ(r.code, 0) << r.err;
	EXPECT_EQ(r.err, "");
	if (r.code != 0) return {};
	return mrpt::containers::yaml::FromText(readFile(prefix + "_stats.json"));
}

double wallMetres(const mrpt::containers::yaml& stats)
{
	return stats["map"]["walls"]["metres"].as<double>();
}

/** Largest distance of a wall node to the true surfaces of the simulated room. */
double largestError(const std::string& csv)
{
	std::istringstream in(readFile(csv));
	std::string line;
	std::getline(in, line);
	EXPECT_EQ(line, "polyline,x,y");
	double largest = 0;
	while (std::getline(in, line))
	{
		double id = 0, x = 0, y = 0;
		EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &id, &x, &y), 3) << line;
		double d = std::abs(std::hypot(x - 5, y - 4) - 0.4);
		for (const double wall : {std::abs(x), std::abs(x - 8), std::abs(y), std::abs(y - 6)}) d = std::min(d, wall);
		largest = std::max(largest, d);
	}
	return largest;
}

}  // namespace

TEST(Inputs, simplemap)
{
	const TempDir dir;
	writeSimplemap(dir / "drive.simplemap", simulateDrive());
	const auto stats = build({dir / "drive.simplemap"}, dir / "map");
	EXPECT_EQ(stats["inputs"](0)["scans"].as<int>(), 24);
	EXPECT_EQ(stats["map"]["measurements"].as<int>(), 24 * 181);
	EXPECT_EQ(stats["inputs"](0)["poses"].as<std::string>(), "simplemap");
	EXPECT_GT(wallMetres(stats), 15);
	EXPECT_LT(largestError(dir / "map_walls.csv"), 0.06);
}

TEST(Inputs, rawlogOfActionsWithItsOdometry)
{
	const TempDir dir;
	const auto drive = simulateDrive();
	writeSimplemap(dir / "drive.simplemap", drive);
	writeActionRawlog(dir / "drive.rawlog", drive);
	const auto expected = build({dir / "drive.simplemap"}, dir / "a");
	const auto stats = build({dir / "drive.rawlog"}, dir / "b", {"--odometry"});
	EXPECT_EQ(stats["map"]["measurements"].as<int>(), expected["map"]["measurements"].as<int>());
	EXPECT_NEAR(wallMetres(stats), wallMetres(expected), 0.3);
	EXPECT_LT(largestError(dir / "b_walls.csv"), 0.06);
}

TEST(Inputs, rawlogOfObservationsWithItsOdometry)
{
	const TempDir dir;
	const auto drive = simulateDrive();
	writeSimplemap(dir / "drive.simplemap", drive);
	writeObservationRawlog(dir / "drive.rawlog", drive);
	build({dir / "drive.simplemap"}, dir / "a");
	const auto stats = build({dir / "drive.rawlog"}, dir / "b", {"--odometry"});
	EXPECT_EQ(stats["inputs"](0)["scans"].as<int>(), 24);
	EXPECT_EQ(readFile(dir / "a_walls.csv"), readFile(dir / "b_walls.csv"));
}

TEST(Inputs, rawlogWithPosesFromAFile)
{
	const TempDir dir;
	const auto drive = simulateDrive();
	writeSimplemap(dir / "drive.simplemap", drive);
	writeObservationRawlog(dir / "drive.rawlog", drive, false);
	writePoses(dir / "poses.txt", drive);
	build({dir / "drive.simplemap"}, dir / "a");
	const auto stats = build({dir / "drive.rawlog"}, dir / "b", {"--poses", dir / "poses.txt"});
	EXPECT_NEAR(wallMetres(stats), wallMetres(build({dir / "drive.simplemap"}, dir / "a")), 0.3);
	EXPECT_EQ(stats["inputs"](0)["observationsWithoutPose"].as<int>(), 0);
	EXPECT_LT(largestError(dir / "b_walls.csv"), 0.06);
}

TEST(Inputs, posesInTumFormatAreInterpolated)
{
	const TempDir dir;
	auto drive = simulateDrive(3);
	drive[0].pose = {1, 2, 0};
	drive[2].pose = {3, 4, 1};
	writeObservationRawlog(dir / "drive.rawlog", {drive[1]}, false);
	char text[300];
	std::snprintf(text, sizeof(text), "1600000000 1 2 0 0 0 0 1\n1600000002 3 4 0 0 0 %.17g %.17g\n", std::sin(0.5),
				  std::cos(0.5));
	writeFile(dir / "poses.txt", text);
	build({dir / "drive.rawlog"}, dir / "a", {"--poses", dir / "poses.txt"});
	drive[1].pose = {2, 3, 0.5};
	writeSimplemap(dir / "drive.simplemap", {drive[1]});
	build({dir / "drive.simplemap"}, dir / "b");
	std::istringstream a(readFile(dir / "a_measurements.csv")), b(readFile(dir / "b_measurements.csv"));
	std::string p, q;
	std::getline(a, p);
	std::getline(b, q);
	int lines = 0;
	while (std::getline(a, p) && std::getline(b, q))
	{
		double px = 0, py = 0, qx = 0, qy = 0;
		ASSERT_EQ(std::sscanf(p.c_str(), "%lf,%lf", &px, &py), 2);
		ASSERT_EQ(std::sscanf(q.c_str(), "%lf,%lf", &qx, &qy), 2);
		EXPECT_NEAR(std::hypot(px - qx, py - qy), 0, 1e-6);
		lines++;
	}
	EXPECT_EQ(lines, 181);
}

TEST(Inputs, rawlogsGetPosesFromIcpSlam)
{
	const TempDir dir;
	const auto drive = simulateDrive();
	writeActionRawlog(dir / "actions.rawlog", drive);
	writeObservationRawlog(dir / "observations.rawlog", drive);
	for (const char* name : {"actions", "observations"})
	{
		const auto stats = build({dir / (std::string(name) + ".rawlog")}, dir / name);
		EXPECT_EQ(stats["inputs"](0)["poses"].as<std::string>(), "ICP-SLAM");
		EXPECT_EQ(stats["inputs"](0)["scans"].as<int>(), 24);
		// A wrong pose would double the walls: those of the room measure 28 m, not all of it is seen.
		EXPECT_GT(wallMetres(stats), 15);
		EXPECT_LT(wallMetres(stats), 32);
	}
}

/** The lines of PREFIX_measurements.csv, without sensor positions. */
std::vector<std::string> measurementsOf(const std::string& prefix)
{
	std::vector<std::string> points;
	std::istringstream in(readFile(prefix + "_measurements.csv"));
	for (std::string line; std::getline(in, line);)
		points.push_back(line.substr(0, line.find(',', line.find(',') + 1)));
	return points;
}

TEST(Inputs, pointsInEveryNotation)
{
	const TempDir dir;
	std::string points;
	for (int i = 0; i < 400; i++) points += std::to_string(0.01 * i) + ",1.25\n";
	writeFile(dir / "a.csv", points);
	build({dir / "a.csv"}, dir / "a");
	const auto replaced = [&](const std::string& separator)
	{
		std::string s = points;
		for (std::size_t at = 0; (at = s.find(',', at)) != std::string::npos; at += separator.size())
			s.replace(at, 1, separator);
		return s;
	};
	writeFile(dir / "b.txt", "# a comment\n\nx y\n" + replaced(" ") + "# the end\n");
	writeFile(dir / "c.xyz", replaced(";\t"));
	std::string four = "x,y,sensor_x,sensor_y\r\n";
	std::istringstream lines(points);
	for (std::string line; std::getline(lines, line);) four += line + ",0.5,-2\r\n";
	writeFile(dir / "d.csv", four);
	for (const char* name : {"b.txt", "c.xyz", "d.csv"})
	{
		build({dir / name, "--set", "sides=off", "--set", "freeSpace=off"}, dir / "other");
		EXPECT_EQ(readFile(dir / "a_walls.csv"), readFile(dir / "other_walls.csv")) << name;
		EXPECT_EQ(measurementsOf(dir / "a"), measurementsOf(dir / "other")) << name;
	}
}

TEST(Inputs, measurementsGiveTheSameMapAgain)
{
	const TempDir dir;
	writeSimplemap(dir / "drive.simplemap", simulateDrive());
	build({dir / "drive.simplemap"}, dir / "a");
	build({dir / "a_measurements.csv"}, dir / "b");
	for (const char* ending : {"_ridges.csv", "_walls.csv", "_measurements.csv"})
		EXPECT_TRUE(readFile(dir / ("a" + std::string(ending))) == readFile(dir / ("b" + std::string(ending))))
			<< ending;
}

TEST(Inputs, measurementsWithoutSensorGiveTheSameMapAgain)
{
	const TempDir dir;
	std::string points;
	for (int i = 0; i < 400; i++)
		points += std::to_string(0.01 * i) + (i % 2 ? ",1.25\n" : ",1.25,1,-2\n");  // every other sensor is known
	writeFile(dir / "points.csv", points);
	build({dir / "points.csv"}, dir / "a");
	build({dir / "a_measurements.csv"}, dir / "b");
	EXPECT_NE(readFile(dir / "a_measurements.csv").find(",1.25,,\n"), std::string::npos);
	for (const char* ending : {"_ridges.csv", "_walls.csv", "_measurements.csv"})
		EXPECT_TRUE(readFile(dir / ("a" + std::string(ending))) == readFile(dir / ("b" + std::string(ending))))
			<< ending;
}

TEST(Inputs, rangesThatAreNotFiniteAreLeftOutAndCounted)
{
	const TempDir dir;
	const auto drive = simulateDrive();
	drive[3].scan->setScanRange(10, std::nanf(""));
	drive[3].scan->setScanRange(11, HUGE_VALF);
	drive[4].scan->setScanRange(12, -HUGE_VALF);
	writeSimplemap(dir / "drive.simplemap", drive);
	const auto stats = build({dir / "drive.simplemap"}, dir / "a");
	EXPECT_EQ(stats["inputs"](0)["rangesNotFinite"].as<int>(), 3);
	EXPECT_EQ(stats["map"]["measurements"].as<int>(), 24 * 181 - 3);
}

TEST(Inputs, scansOutsideThePosesAreLeftOutAndCounted)
{
	const TempDir dir;
	const auto drive = simulateDrive();
	writeObservationRawlog(dir / "drive.rawlog", drive, false);
	writePoses(dir / "poses.txt", {drive.begin() + 4, drive.end()});
	const auto stats = build({dir / "drive.rawlog"}, dir / "a", {"--poses", dir / "poses.txt"});
	EXPECT_EQ(stats["inputs"](0)["observationsWithoutPose"].as<int>(), 4);
	EXPECT_EQ(stats["inputs"](0)["scans"].as<int>(), 20);
}

}  // namespace ridgemap::test
