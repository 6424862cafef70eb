// SPDX-License-Identifier: BSD-3-Clause
// Every kind of bad input ends with one line that names cause and remedy, a non-zero code and no files.
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/serialization/CArchive.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "test_support.h"

namespace ridgemap::test
{
namespace
{
class BadInput : public ::testing::Test
{
 protected:
	const TempDir dir;
	const std::vector<PosedScan> drive = simulateDrive(6);
	std::string good;

	void SetUp() override
	{
		good = dir / "good.csv";
		writeFile(good, "0 0\n0.01 0\n0.02 0\n");
	}

	/** Runs ridgemap-build, adding an output prefix, and checks how it fails. */
	void expectFailure(std::vector<std::string> arguments, const std::vector<std::string>& words)
	{
		if (std::find(arguments.begin(), arguments.end(), "-o") == arguments.end())
			arguments.insert(arguments.end(), {"-o", dir / "result"});
		check(runBuild(arguments), "ridgemap-build: error: ", words);
	}

	void check(const RunResult& r, const std::string& start, const std::vector<std::string>& words)
	{
		EXPECT_EQ(r.code, 1) << r.err;
		EXPECT_EQ(r.out, "");
		EXPECT_EQ(r.err.compare(0, start.size(), start), 0) << r.err;
		EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
		EXPECT_NE(r.err.find("; "), std::string::npos) << "no remedy: " << r.err;
		EXPECT_EQ(r.err.find("MRPT exception"), std::string::npos) << r.err;
		for (const std::string& word : words) EXPECT_NE(r.err.find(word), std::string::npos) << word << " in " << r.err;
		for (const std::string& file : dir.files()) EXPECT_EQ(file.find("result"), std::string::npos) << file;
	}

	std::string file(const std::string& name, const std::string& content)
	{
		writeFile(dir / name, content);
		return dir / name;
	}

	/** A file cut off after a share of its bytes. */
	std::string cut(const std::string& path, const std::string& name, double share)
	{
		const std::string all = readFile(path);
		return file(name, all.substr(0, std::size_t(share * double(all.size()))));
	}
};

}  // namespace

TEST_F(BadInput, usage)
{
	expectFailure({}, {"no input", "--help"});
	expectFailure({good, "--bogus"}, {"unknown option '--bogus'", "--help"});
	expectFailure({good, "-o", dir / "result", "--sigma"}, {"sigma", "--help"});
	expectFailure({good, "--sigma", "0.1", "--sigma", "0.2"}, {"sigma"});
	expectFailure({good, "--formats", "png,gif"}, {"unknown format 'gif'", "3dscene"});
	expectFailure({good, "--formats", ""}, {"--formats"});
	expectFailure({good, "--shuffle", "-1"}, {"--shuffle", "'-1'"});
	expectFailure({good, "--batch", "0"}, {"--batch", "'0'"});
	expectFailure({good, "--threads", "two"}, {"--threads", "'two'"});
	expectFailure({good, "--poses", good, "--odometry"}, {"--poses and --odometry"});
	expectFailure({good, "--odometry"}, {"rawlog"});
	expectFailure({good, "--set", "sigma"}, {"--set KEY=VALUE"});
	check(runBuild({good}), "ridgemap-build: error: ", {"no output", "-o PREFIX"});
}

TEST_F(BadInput, options)
{
	expectFailure({good, "--sigma", "-0.1"}, {"sigma", "-0.1", "0.001"});
	expectFailure({good, "--sigma", "nan"}, {"sigma", "nan"});
	expectFailure({good, "--sigma", "5cm"}, {"sigma", "5cm"});
	expectFailure({good, "--eps", "1e9"}, {"eps"});
	expectFailure({good, "--set", "sigmma=0.1"}, {"sigmma", "sigma"});
	expectFailure({good, "--set", "stepRule=fast"}, {"stepRule", "fast", "error"});
	expectFailure({good, "--config", dir / "none.ini"}, {"none.ini", "No such file"});
	expectFailure({good, "--config", file("other.ini", "[other]\na=1\n")}, {"other.ini", "--dump-config"});
	expectFailure({good, "--config", file("key.ini", "[map_ridgeMap_00_creationOpts]\nsgima = 0.1\n")}, {"sgima"});
	expectFailure({good, "--config", file("value.ini", "[map_ridgeMap_00_creationOpts]\nsigma = big\n")}, {"big"});
}

TEST_F(BadInput, filesThatCannotBeRead)
{
	for (const char* extension : {".csv", ".simplemap", ".rawlog", ".ridgemap"})
	{
		const std::string none = dir / ("none" + std::string(extension));
		expectFailure({none}, {none, "No such file"});
		expectFailure({file("empty" + std::string(extension), "")}, {"is empty"});
		std::filesystem::create_directory(dir / ("directory" + std::string(extension)));
		expectFailure({dir / ("directory" + std::string(extension))}, {"is a directory"});
		expectFailure({good, none}, {none});
	}
	expectFailure({file("picture.jpg", "x")}, {"unknown kind", ".simplemap"});
	expectFailure({file("noextension", "x")}, {"unknown kind"});
	for (const char* extension : {".simplemap", ".rawlog", ".ridgemap"})
		expectFailure({file("garbage" + std::string(extension), "this is no such file, but a text")}, {"garbage"});
	expectFailure({file("only_header.csv", "x,y\n")}, {"holds no measurements"});
}

TEST_F(BadInput, lines)
{
	const auto points = [&](const std::string& line, const std::string& why) {
		expectFailure({file("p.csv", "x,y\n1,2\n" + line + "\n3,4\n")}, {"p.csv:3", why});
	};
	points("1", "2 or 4");
	points("1,2,3", "2 or 4");
	points("1,2,3,4,5", "2 or 4");
	points("1,", "'' is not a number");
	points("1,abc", "'abc' is not a number");
	points("1,2x", "'2x' is not a number");
	points("x,y", "'x' is not a number");
	points("1,nan", "'nan' is not finite");
	points("inf,2", "'inf' is not finite");
	points("1,1e7", "1e6");
}

TEST_F(BadInput, truncatedAndDamaged)
{
	writeActionRawlog(dir / "whole.rawlog", drive);
	writeSimplemap(dir / "whole.simplemap", drive);
	ASSERT_EQ(runBuild({good, "-o", dir / "whole", "--formats", "ridgemap", "-q"}).code, 0);
	for (const char* kind : {".rawlog", ".simplemap", ".ridgemap"})
		for (const double share : {0.05, 0.5, 0.9, 0.999})
		{
			SCOPED_TRACE(std::string(kind) + " " + std::to_string(share));
			expectFailure({cut(dir / ("whole" + std::string(kind)), "cut" + std::string(kind), share)}, {"cut"});
		}
	expectFailure({cut(dir / "whole.rawlog", "cut.rawlog", 0.6)}, {"is truncated"});
	for (const char* kind : {".rawlog", ".simplemap", ".ridgemap"})
	{
		std::string bytes = readFile(dir / ("whole" + std::string(kind)));
		bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 0x55);
		SCOPED_TRACE(kind);
		expectFailure({file("damaged" + std::string(kind), bytes)}, {"damaged"});
	}
}

TEST_F(BadInput, nothingUsable)
{
	{
		mrpt::io::CFileGZOutputStream out(dir / "odometry.rawlog");
		auto archive = mrpt::serialization::archiveFrom(out);
		mrpt::obs::CObservationOdometry odometry;
		archive << odometry << odometry;
	}
	expectFailure({dir / "odometry.rawlog"}, {"2 mrpt::obs::CObservationOdometry", "2-D scans"});
	writeObservationRawlog(dir / "scans.rawlog", drive, false);
	expectFailure({dir / "scans.rawlog", "--odometry"}, {"holds no odometry", "--poses"});
	for (const auto& d : drive)
		for (std::size_t i = 0; i < d.scan->getScanSize(); i++) d.scan->setScanRangeValidity(i, false);
	writeSimplemap(dir / "invalid.simplemap", drive);
	expectFailure({dir / "invalid.simplemap"}, {"6 mrpt::obs::CObservation2DRangeScan"});
}

TEST_F(BadInput, poses)
{
	writeObservationRawlog(dir / "scans.rawlog", drive, false);
	writePoses(dir / "late.txt", drive, 1000);
	const auto with = [&](const std::string& poses) -> std::vector<std::string> {
		return {dir / "scans.rawlog", "--poses", poses};
	};
	expectFailure(with(dir / "late.txt"), {"do not overlap"});
	expectFailure(with(dir / "none.txt"), {"none.txt", "No such file"});
	expectFailure(with(file("three.txt", "1 2 3\n")), {"three.txt:1", "4 or 8"});
	expectFailure(with(file("word.txt", "# t x y phi\n1 2 3 north\n")), {"word.txt:2", "'north'"});
	expectFailure(with(file("nan.txt", "1 2 3 nan\n")), {"nan.txt:1", "'nan'"});
	expectFailure(with(file("quaternion.txt", "1 2 3 0 0 0 0 0\n")), {"quaternion.txt:1", "quaternion"});
	expectFailure(with(file("comments.txt", "# nothing\n")), {"holds no poses"});
	auto lost = drive;
	lost[2].pose = {std::numeric_limits<double>::quiet_NaN(), 0, 0};
	writeSimplemap(dir / "lost.simplemap", lost);
	expectFailure({dir / "lost.simplemap"}, {"pose that is not finite"});
}

TEST_F(BadInput, mapsBuiltWithOtherOptions)
{
	ASSERT_EQ(runBuild({good, "-o", dir / "fine", "--formats", "ridgemap", "-q"}).code, 0);
	ASSERT_EQ(runBuild({good, "-o", dir / "coarse", "--formats", "ridgemap", "-q", "--sigma", "0.2"}).code, 0);
	expectFailure({dir / "fine.ridgemap", dir / "coarse.ridgemap"}, {"sigma", "0.2", "0.05"});
	expectFailure({dir / "coarse.ridgemap", "--sigma", "0.1"}, {"sigma", "0.2", "0.1"});
	// Options that agree, or are not given, are no error.
	EXPECT_EQ(runBuild({dir / "coarse.ridgemap", good, "--sigma", "0.2", "-o", dir / "a", "-q"}).code, 0);
	EXPECT_EQ(runBuild({dir / "coarse.ridgemap", good, "-o", dir / "b", "-q"}).code, 0);
	EXPECT_TRUE(readFile(dir / "a.ridgemap") == readFile(dir / "b.ridgemap"));
}

TEST_F(BadInput, outputs)
{
	expectFailure({good, "-o", dir / "none/below/result"}, {"none/below", "No such file"});
	expectFailure({good, "-o", dir / "x/"}, {"is a directory"});
	expectFailure({good, "-o", good + "/result"}, {"not a directory"});
	std::filesystem::create_directory(dir / "taken.png");
	expectFailure({good, "-o", dir / "taken"}, {"taken.png", "Is a directory"});
	if (geteuid() != 0)
	{
		std::filesystem::create_directory(dir / "locked");
		std::filesystem::permissions(dir / "locked", std::filesystem::perms::owner_read);
		expectFailure({good, "-o", dir / "locked/result"}, {"Permission denied"});
		std::filesystem::permissions(dir / "locked", std::filesystem::perms::owner_all);
	}
	expectFailure({good, "-o", "/proc/result"}, {"/proc/result"});
}

TEST_F(BadInput, directoryMadeForTheOutputIsRemovedAgain)
{
	expectFailure({file("bad.csv", "1,2\nbad\n"), "-o", dir / "made/result"}, {"bad.csv:2"});
	EXPECT_FALSE(std::filesystem::exists(dir / "made"));
}

TEST_F(BadInput, diskFull)
{
	// A limit on the size of files acts as a full disk does: the map is computed, then writing fails, at the end of the
	// file or, of a long one, on the way, within functions of MRPT.
	for (const double spacing : {0.001, 0.1})
	{
		std::string points;
		for (int i = 0; i < 20000; i++) points += std::to_string(spacing * i) + " 0\n";
		const std::string many = file("many.csv", points);
		const std::string program = RIDGEMAP_BUILD_PROGRAM;
		const RunResult r = run("/bin/sh", {"-c", "trap '' XFSZ; ulimit -f 64; exec \"$0\" \"$@\"", program, many, "-q",
											"-o", dir / "result"});
		check(r, "ridgemap-build: error: cannot write", {"result"});
	}
}

TEST_F(BadInput, info)
{
	check(runInfo({}), "ridgemap-info: error: ", {"no map"});
	check(runInfo({dir / "none.ridgemap"}), "ridgemap-info: error: ", {"No such file"});
	check(runInfo({good}), "ridgemap-info: error: ", {"good.csv"});
	check(runInfo({good, "--bogus"}), "ridgemap-info: error: ", {"--bogus"});
}

}  // namespace ridgemap::test
