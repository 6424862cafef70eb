// SPDX-License-Identifier: BSD-3-Clause
// What ridgemap-build and ridgemap-info write and print.
#include <gtest/gtest.h>
#include <mrpt/containers/yaml.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/polyline_csv.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "test_support.h"

namespace ridgemap::test
{
namespace
{
class OutputFiles : public ::testing::Test
{
 protected:
	const TempDir dir;
	RunResult result;

	void SetUp() override
	{
		writeSimplemap(dir / "drive.simplemap", simulateDrive());
		result = runBuild({dir / "drive.simplemap", "-o", dir / "map", "--set", "maxRange=5"});
		ASSERT_EQ(result.code, 0) << result.err;
	}

	std::string walls(const CRidgeMap2D& map) const
	{
		std::ostringstream out;
		writePolylinesCsv(out, map.walls());
		return out.str();
	}
};

}  // namespace

TEST_F(OutputFiles, allAndNothingElse)
{
	const std::vector<std::string> expected{"drive.simplemap", "map.3Dscene",    "map.png",
											"map.ridgemap",    "map.svg",        "map_measurements.csv",
											"map_ridges.csv",  "map_stats.json", "map_walls.csv"};
	EXPECT_EQ(dir.files(), expected);
}

TEST_F(OutputFiles, summary)
{
	EXPECT_EQ(result.err, "");  // no progress bar without a terminal
	for (const char* word : {"scans         24", "measurements", "walls", "ridges", "nodes", "median", "99 %",
							 "map.png (", "map_stats.json ("})
		EXPECT_NE(result.out.find(word), std::string::npos) << word << " in " << result.out;
}

TEST_F(OutputFiles, mapCanBeLoadedAgain)
{
	const CRidgeMap2D map = loadRidgeMap(dir / "map.ridgemap");
	EXPECT_EQ(map.insertionOptions.maxRange, 5);
	EXPECT_GT(map.walls().size(), 0u);
	EXPECT_EQ(walls(map), readFile(dir / "map_walls.csv"));
}

TEST_F(OutputFiles, statistics)
{
	const auto stats = mrpt::containers::yaml::FromText(readFile(dir / "map_stats.json"));
	const CRidgeMap2D map = loadRidgeMap(dir / "map.ridgemap");
	for (const std::string& key : MapOptions::keys()) EXPECT_TRUE(stats["options"].has(key)) << key;
	EXPECT_EQ(stats["options"]["maxRange"].as<double>(), 5);
	EXPECT_EQ(stats["options"]["sigma"].as<double>(), map.options().sigma);
	EXPECT_EQ(stats["map"]["walls"]["polylines"].as<std::size_t>(), map.walls().size());
	EXPECT_EQ(stats["map"]["ridges"]["polylines"].as<std::size_t>(), map.ridges().size());
	EXPECT_EQ(stats["updates"]["updates"].as<int>(), 1);
	EXPECT_GT(stats["updates"]["evaluations"].as<double>(), 0);
	EXPECT_EQ(stats["times"]["insertionsMs"].asSequence().size(), 24u);
	EXPECT_EQ(stats["times"]["updatesMs"].asSequence().size(), 1u);
	EXPECT_EQ(stats["fileBytes"]["map.png"].as<std::uintmax_t>(), std::filesystem::file_size(dir / "map.png"));
}

TEST_F(OutputFiles, statisticsOfUpdatesAfterEveryScan)
{
	const RunResult every =
		runBuild({dir / "drive.simplemap", "-o", dir / "every", "--formats", "stats", "--every-scan"});
	ASSERT_EQ(every.code, 0) << every.err;
	EXPECT_NE(every.out.find("an insertion with up-to-date polylines takes"), std::string::npos) << every.out;
	const auto stats = mrpt::containers::yaml::FromText(readFile(dir / "every_stats.json"));
	EXPECT_EQ(stats["updates"]["updates"].as<int>(), 24);
	EXPECT_EQ(stats["times"]["updatesMs"].asSequence().size(), 24u);
	EXPECT_GE(stats["times"]["updateSumMs"].as<double>(), stats["times"]["insertionSumMs"].as<double>());
}

TEST_F(OutputFiles, measurements)
{
	std::istringstream in(readFile(dir / "map_measurements.csv"));
	std::string line;
	std::getline(in, line);
	EXPECT_EQ(line, "x,y,sensorX,sensorY");
	std::size_t count = 0;
	while (std::getline(in, line)) count++;
	EXPECT_EQ(count, loadRidgeMap(dir / "map.ridgemap").core().statistics().measurements);
}

TEST_F(OutputFiles, pictures)
{
	const cv::Mat image = cv::imread(dir / "map.png");
	ASSERT_FALSE(image.empty());
	EXPECT_GE(std::max(image.cols, image.rows), 1600);
	EXPECT_LE(std::max(image.cols, image.rows), 2400);
	const std::string svg = readFile(dir / "map.svg");
	EXPECT_EQ(svg.compare(0, 4, "<svg"), 0);
	EXPECT_NE(svg.find("</svg>\n"), std::string::npos);
	for (const char* word :
		 {"<polyline", "drive.simplemap", "sigma 0.05 m", "x [m]", "y [m]", "robot path", "measurements"})
		EXPECT_NE(svg.find(word), std::string::npos) << word;
}

TEST_F(OutputFiles, scene)
{
	mrpt::opengl::COpenGLScene scene;
	ASSERT_TRUE(scene.loadFromFile(dir / "map.3Dscene"));
	EXPECT_GE(scene.viewportsCount(), 1u);
	EXPECT_TRUE(scene.getByName("robot path"));

	// SceneViewer3D takes over the camera: from above, x to the right, and all of the map within its 45 degrees.
	EXPECT_TRUE(scene.followCamera());
	const auto& camera = scene.getViewport()->getCamera();
	EXPECT_EQ(camera.getElevationDegrees(), 90);
	EXPECT_EQ(camera.getAzimuthDegrees(), -90);
	const auto box = scene.getBoundingBox();
	const double seen = camera.getZoomDistance() * std::tan(M_PI / 8);
	ASSERT_GT(box.max.x - box.min.x, 1);
	EXPECT_GT(camera.getPointingAtY() + seen, box.max.y);
	EXPECT_LT(camera.getPointingAtY() - seen, box.min.y);
	EXPECT_GT(camera.getPointingAtX() + 1.25 * seen, box.max.x);
	EXPECT_LT(camera.getPointingAtX() - 1.25 * seen, box.min.x);
	EXPECT_LT(seen, box.max.x - box.min.x + box.max.y - box.min.y) << "too far away";
}

TEST_F(OutputFiles, chosenFormatsOnly)
{
	ASSERT_EQ(runBuild({dir / "map.ridgemap", "-o", dir / "made/few", "--formats", "svg,walls", "-q"}).code, 0);
	EXPECT_EQ(readFile(dir / "made/few_walls.csv"), readFile(dir / "map_walls.csv"));
	EXPECT_TRUE(std::filesystem::exists(dir / "made/few.svg"));
	EXPECT_FALSE(std::filesystem::exists(dir / "made/few.png"));
	EXPECT_FALSE(std::filesystem::exists(dir / "made/few_stats.json"));
}

TEST_F(OutputFiles, verticesOnDemand)
{
	ASSERT_EQ(runBuild({dir / "map.ridgemap", "-o", dir / "v", "--formats", "ridge_vertices,wall_vertices,svg", "-q",
						"--errors"})
				  .code,
			  0);
	const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
	EXPECT_EQ(lines(readFile(dir / "v_ridge_vertices.csv")), lines(readFile(dir / "map_ridges.csv")));
	EXPECT_EQ(lines(readFile(dir / "v_wall_vertices.csv")), lines(readFile(dir / "map_walls.csv")));
	EXPECT_NE(readFile(dir / "v.svg").find("standard error [mm]"), std::string::npos);
	EXPECT_EQ(readFile(dir / "map.svg").find("standard error [mm]"), std::string::npos);
}

TEST(Removed, isWhatRaysPassedThrough)
{
	const TempDir dir;
	std::string points;
	for (int scan = 0; scan < 20; scan++)
		for (int i = 0; i <= 100; i++)
		{
			// In two scans, something stands half-way.
			const double share = scan < 2 && i > 20 && i < 80 ? 0.5 : 1;
			points += std::to_string(1 + share * (0.03 * i - 1.5)) + " " + std::to_string(2 * share) + " 1 0\n";
		}
	writeFile(dir / "points.txt", points);
	ASSERT_EQ(
		runBuild({dir / "points.txt", "-o", dir / "r", "--formats", "walls,removed", "-q", "--sigma", "0.05"}).code, 0);
	const auto expectAllAt = [&](const std::string& file, double height)
	{
		std::istringstream in(readFile(dir / file));
		std::string line;
		std::getline(in, line);
		int nodes = 0, number = 0;
		for (double x, y; std::getline(in, line) && std::sscanf(line.c_str(), "%d,%lf,%lf", &number, &x, &y) == 3;
			 nodes++)
			EXPECT_NEAR(y, height, 0.02) << line;
		EXPECT_GE(nodes, 2) << file;
	};
	expectAllAt("r_walls.csv", 2);
	expectAllAt("r_removed.csv", 1);
}

TEST_F(OutputFiles, infoAgreesWithTheStatistics)
{
	const RunResult json = runInfo({dir / "map.ridgemap", "--json"});
	ASSERT_EQ(json.code, 0) << json.err;
	const auto info = mrpt::containers::yaml::FromText(json.out);
	const auto stats = mrpt::containers::yaml::FromText(readFile(dir / "map_stats.json"));
	for (const char* what : {"polylines", "nodes", "metres", "closed"})
		for (const char* kind : {"ridges", "walls"})
			EXPECT_EQ(info["map"][kind][what].as<double>(), stats["map"][kind][what].as<double>()) << kind << what;
	EXPECT_NEAR(info["map"]["boundingBox"]["maxX"].as<double>(), 8, 0.1);
	const RunResult text = runInfo({dir / "map.ridgemap"});
	ASSERT_EQ(text.code, 0) << text.err;
	for (const char* word : {"measurements", "walls", "ridges", "bounding box", "sigma", "maxRange              5\n"})
		EXPECT_NE(text.out.find(word), std::string::npos) << word << " in " << text.out;
}

TEST(DumpedConfig, isReadBackAndKeepsWhatTheUserSet)
{
	const TempDir dir;
	const RunResult dump =
		runBuild({"--dump-config", "--sigma", "0.125", "--set", "maxRange=7", "--set", "prune=false"});
	ASSERT_EQ(dump.code, 0) << dump.err;
	EXPECT_NE(dump.out.find("//"), std::string::npos) << "no comments";
	for (const std::string& key : MapOptions::keys()) EXPECT_NE(dump.out.find(key), std::string::npos) << key;
	writeFile(dir / "map.ini", dump.out);
	const RunResult again = runBuild({"--dump-config", "--config", dir / "map.ini"});
	EXPECT_EQ(again.out, dump.out);
	const RunResult set = runBuild({"--dump-config", "--config", dir / "map.ini", "--sigma", "0.05"});
	EXPECT_NE(set.out, dump.out);
	EXPECT_NE(dump.out, runBuild({"--dump-config"}).out);
}

TEST(Help, namesEveryOptionAndTellsWhyOrderDoesNotMatter)
{
	const RunResult help = runBuild({"--help"});
	EXPECT_EQ(help.code, 0);
	EXPECT_EQ(help.err, "");
	for (const char* word :
		 {"--config", "--sigma", "--eps", "--set", "--poses", "--odometry", "--shuffle", "--batch", "--threads",
		  "--every-scan", "--formats", "--errors", "--quiet", "--dump-config", "pure function"})
		EXPECT_NE(help.out.find(word), std::string::npos) << word;
	EXPECT_EQ(runBuild({"--version"}).code, 0);
	EXPECT_EQ(runInfo({"--help"}).code, 0);
}

}  // namespace ridgemap::test
