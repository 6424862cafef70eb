// SPDX-License-Identifier: BSD-3-Clause
// The files are a pure function of the measurements: order, batches, threads and merging leave no trace.
#include <gtest/gtest.h>

#include "test_support.h"

namespace ridgemap::test
{
namespace
{
const char* const sameFiles[] = {".ridgemap", "_ridges.csv", "_walls.csv", "_measurements.csv",
								 ".svg",      ".png",        ".3Dscene"};

class Equality : public ::testing::Test
{
 protected:
	const TempDir dir;
	const std::vector<PosedScan> drive = simulateDrive();

	void SetUp() override
	{
		writeSimplemap(dir / "drive.simplemap", drive);
		build({dir / "drive.simplemap", "-o", dir / "whole"});
	}

	static void build(std::vector<std::string> arguments)
	{
		arguments.push_back("-q");
		const RunResult r = runBuild(arguments);
		ASSERT_EQ(r.code, 0) << r.err;
		EXPECT_EQ(r.out + r.err, "");
	}

	void expectSame(const std::string& name) const
	{
		for (const char* suffix : sameFiles)
			EXPECT_TRUE(readFile(dir / ("whole" + std::string(suffix))) == readFile(dir / (name + suffix)))
				<< name << suffix;
	}
};

}  // namespace

TEST_F(Equality, anotherRun)
{
	build({dir / "drive.simplemap", "-o", dir / "again"});
	expectSame("again");
}

TEST_F(Equality, shuffled)
{
	for (const char* seed : {"0", "1", "18446744073709551615"})
	{
		build({dir / "drive.simplemap", "-o", dir / "shuffled", "--shuffle", seed});
		expectSame("shuffled");
	}
	build({dir / "drive.simplemap", "-o", dir / "shuffled", "--shuffle", "3", "--batch", "97"});
	expectSame("shuffled");
}

TEST_F(Equality, batches)
{
	for (const char* batch : {"13", "1000", "100000"})
	{
		build({dir / "drive.simplemap", "-o", dir / "batches", "--batch", batch});
		expectSame("batches");
	}
}

TEST_F(Equality, polylinesAfterEveryScan)
{
	build({dir / "drive.simplemap", "-o", dir / "every", "--every-scan"});
	expectSame("every");
	build({dir / "drive.simplemap", "-o", dir / "shuffled", "--every-scan", "--shuffle", "5", "--threads", "2"});
	expectSame("shuffled");
}

TEST_F(Equality, threads)
{
	build({dir / "drive.simplemap", "-o", dir / "threads", "--threads", "2"});
	expectSame("threads");
}

TEST_F(Equality, halvesMerged)
{
	const auto middle = drive.begin() + 11;
	writeSimplemap(dir / "first.simplemap", {drive.begin(), middle});
	writeSimplemap(dir / "second.simplemap", {middle, drive.end()});
	build({dir / "first.simplemap", "-o", dir / "first"});
	build({dir / "second.simplemap", "-o", dir / "second"});
	build({dir / "first.ridgemap", dir / "second.ridgemap", "-o", dir / "maps"});
	build({dir / "second.simplemap", dir / "first.ridgemap", "-o", dir / "mixed"});
	build({dir / "first.simplemap", dir / "second.simplemap", "-o", dir / "inputs"});
	for (const char* name : {"maps", "mixed", "inputs"})
		for (const char* suffix : {".ridgemap", "_ridges.csv", "_walls.csv"})
			EXPECT_TRUE(readFile(dir / ("whole" + std::string(suffix))) == readFile(dir / (name + std::string(suffix))))
				<< name << suffix;
	// Only what this run inserted is listed as its measurements.
	EXPECT_EQ(readFile(dir / "maps_measurements.csv"), "x,y,sensorX,sensorY\n");
	EXPECT_EQ(readFile(dir / "mixed_measurements.csv"), readFile(dir / "second_measurements.csv"));
	EXPECT_EQ(readFile(dir / "inputs_measurements.csv"), readFile(dir / "whole_measurements.csv"));
}

TEST_F(Equality, mapRewrittenInPlace)
{
	const std::string before = readFile(dir / "whole.ridgemap");
	build({dir / "whole.ridgemap", "-o", dir / "whole", "--formats", "ridgemap"});
	EXPECT_TRUE(readFile(dir / "whole.ridgemap") == before);
}

}  // namespace ridgemap::test
