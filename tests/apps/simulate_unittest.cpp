// SPDX-License-Identifier: BSD-3-Clause
// ridgemap-simulate, ridgemap-eval and ridgemap-paper, run as a user runs them.
#include <gtest/gtest.h>
#include <mrpt/containers/yaml.h>

#include <algorithm>

#include "test_support.h"

namespace ridgemap::test
{
namespace
{
RunResult simulate(const std::vector<std::string>& arguments)
{
	return run(RIDGEMAP_SIMULATE_PROGRAM, arguments);
}
RunResult evaluate(const std::vector<std::string>& arguments)
{
	return run(RIDGEMAP_EVAL_PROGRAM, arguments);
}

const std::vector<std::string> suffixes{".rawlog", ".simplemap.gz", "_measurements.csv", "_poses.txt", "_truth.csv"};
}  // namespace

TEST(Simulate, sameSeedSameBytes)
{
	const TempDir dir;
	for (const char* sensor : {"paper", "lidar"})
	{
		for (const auto& [name, seed] : {std::pair("a", "5"), {"b", "5"}, {"c", "6"}})
		{
			const RunResult r = simulate({"corner", "--sensor", sensor, "--seed", seed, "--outliers", "0.1",
										  "--odometry-noise", "0.05", "-o", dir / name});
			ASSERT_EQ(r.code, 0) << r.err;
		}
		for (const std::string& s : suffixes) EXPECT_EQ(readFile(dir / ("a" + s)), readFile(dir / ("b" + s))) << s;
		EXPECT_NE(readFile(dir / "a_measurements.csv"), readFile(dir / "c_measurements.csv"));
	}
}

TEST(Simulate, mapsOfAllFilesFollowTheTruth)
{
	const TempDir dir;
	ASSERT_EQ(simulate({"hallway", "--rate", "80", "-o", dir / "h"}).code, 0);
	for (const std::vector<std::string>& input : {std::vector<std::string>{dir / "h.simplemap.gz"},
												  {dir / "h.rawlog", "--odometry"},
												  {dir / "h.rawlog", "--poses", dir / "h_poses.txt"},
												  {dir / "h_measurements.csv"}})
	{
		std::vector<std::string> arguments = input;
		for (const std::string& a : {std::string("--sigma"), std::string("0.1"), std::string("-q"),
									 std::string("--formats"), std::string("ridgemap"), std::string("-o"), dir / "m"})
			arguments.push_back(a);
		const RunResult built = runBuild(arguments);
		ASSERT_EQ(built.code, 0) << built.err;
		const RunResult r = evaluate({dir / "m.ridgemap", "--truth", dir / "h_truth.csv", "--json"});
		ASSERT_EQ(r.code, 0) << r.err;
		const auto json = mrpt::containers::yaml::FromText(r.out);
		EXPECT_GT(json["walls"]["completeness"].as<double>(), 0.97) << input[0];
		EXPECT_LT(json["walls"]["straight"]["rmsd"].as<double>(), 0.01);
		EXPECT_EQ(json["corners"].as<int>(), 2);
	}
	const RunResult table = evaluate({dir / "m.ridgemap", "--truth", dir / "h_truth.csv", "--polylines"});
	for (const char* word : {"RMSD", "complete", "duplicates", "fragments", "near corners", "52.00 m seen"})
		EXPECT_NE(table.out.find(word), std::string::npos) << word << " in " << table.out;
}

TEST(Simulate, scenesFromFiles)
{
	const TempDir dir;
	writeFile(
		dir / "scene.txt",
		"# a room with a pillar, and somebody who walks in it\nwall 0 0 6 0\nwall 6 0 6 4\nwall 6 4 0 4\nwall 0 4 0 "
		"0\narc 3 2 0.4 0 360\nmover 0.3 1 1 1 1 3\npath 2 1 4 1 # ends here\n");
	ASSERT_EQ(simulate({dir / "scene.txt", "--sensor", "lidar", "-o", dir / "s"}).code, 0);
	const std::string truth = readFile(dir / "s_truth.csv");
	EXPECT_GT(std::count(truth.begin(), truth.end(), '\n'), 100);  // chords of the pillar
	EXPECT_NE(truth.find(",0\n"), std::string::npos);              // its back was not seen
	EXPECT_NE(truth.find(",1\n"), std::string::npos);
}

TEST(Simulate, badInput)
{
	const TempDir dir;
	writeFile(dir / "bad.txt", "wall 0 0 1 0\narc 1 2 -3 0 90\n");
	writeFile(dir / "truth.csv", "x1,y1,x2,y2,seen\n1,2,3\n");
	ASSERT_EQ(simulate({"corner", "--rate", "20", "-o", dir / "c"}).code, 0);
	ASSERT_EQ(runBuild({dir / "c.simplemap.gz", "-q", "-o", dir / "c", "--formats", "ridgemap"}).code, 0);
	const auto expectError = [](const RunResult& r, const std::string& what)
	{
		EXPECT_NE(r.code, 0) << what;
		EXPECT_NE(r.err.find(what), std::string::npos) << what << " in " << r.err;
	};
	expectError(simulate({dir / "bad.txt", "-o", dir / "x"}), "bad.txt:2");
	expectError(simulate({"corner"}), "-o PREFIX");
	expectError(simulate({"corner", "--rate", "many", "-o", dir / "x"}), "--rate");
	expectError(simulate({"corner", "--noise", "1", "-o", dir / "x"}), "--noise");
	expectError(simulate({"corner", "--sensor", "sonar", "-o", dir / "x"}), "sonar");
	expectError(simulate({dir / "missing.txt", "-o", dir / "x"}), "missing.txt");
	expectError(evaluate({dir / "c.ridgemap"}), "--truth");
	expectError(evaluate({dir / "c.ridgemap", "--truth", dir / "truth.csv"}), "truth.csv:2");
	expectError(evaluate({dir / "c.ridgemap", "--truth", dir / "c_truth.csv", "--within", "-1"}), "--within");
	expectError(evaluate({"--truth", dir / "c_truth.csv"}), "one map");
}

TEST(Paper, experimentsWithoutCharts)
{
	const TempDir dir;
	const RunResult r =
		run(RIDGEMAP_PAPER_PROGRAM, {"fig2", "permutations", "corrections", "changes", "--quick", "-o", dir / "out"});
	ASSERT_EQ(r.code, 0) << r.err;
	const std::string page = readFile(dir / "out/index.html");
	EXPECT_EQ(page.find("not as in the paper"), std::string::npos) << r.out;
	EXPECT_NE(page.find("fig2.png"), std::string::npos);
	EXPECT_GT(readFile(dir / "out/fig2.png").size(), 10000u);
	const RunResult unknown = run(RIDGEMAP_PAPER_PROGRAM, {"fig7", "-o", dir / "out"});
	EXPECT_NE(unknown.code, 0);
	EXPECT_NE(unknown.err.find("fig7"), std::string::npos);
}

}  // namespace ridgemap::test
