// SPDX-License-Identifier: BSD-3-Clause
// Rawlogs and simplemaps that are cut off, have holes, wrong classes or times that run backwards are errors, or with
// --keep-going are used as far as they go, with a count of what was left out. RIDGEMAP_CUTS=N cuts at N places.
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "test_support.h"

namespace ridgemap::test
{
namespace
{
using mrpt::serialization::CArchive;

class KeepGoing : public ::testing::Test
{
 protected:
	const TempDir dir;
	const std::vector<PosedScan> drive = simulateDrive(8);

	void SetUp() override { writePoses(dir / "poses.txt", drive); }

	RunResult build(const std::string& file, const std::string& prefix, bool keepGoing)
	{
		std::vector<std::string> arguments{dir / file, "-o", dir / prefix, "--formats", "ridgemap"};
		if (file.find(".rawlog") != std::string::npos)
			arguments.insert(arguments.end(), {"--poses", dir / "poses.txt"});
		if (keepGoing) arguments.emplace_back("--keep-going");
		return runBuild(arguments);
	}

	template <class Write>
	void rawlog(const std::string& name, Write write)
	{
		mrpt::io::CFileGZOutputStream file(dir / name);
		auto archive = mrpt::serialization::archiveFrom(file);
		write(archive);
	}

	/** The file is an error; what --keep-going makes of it is the same as of the scans alone, and it says `what`. */
	void expectSkipped(const std::string& file, const std::vector<PosedScan>& rest, const std::string& what)
	{
		const RunResult refused = build(file, "refused", false);
		EXPECT_EQ(refused.code, 1) << what;
		EXPECT_NE(refused.err.find("--keep-going"), std::string::npos) << refused.err;
		const RunResult used = build(file, "used", true);
		ASSERT_EQ(used.code, 0) << used.err;
		EXPECT_NE(used.out.find(what), std::string::npos) << what << " in " << used.out;
		rawlog("rest.rawlog",
			   [&](CArchive& out)
			   {
				   for (const auto& d : rest) out << *d.scan;
			   });
		ASSERT_EQ(build("rest.rawlog", "rest", false).code, 0);
		EXPECT_TRUE(readFile(dir / "used.ridgemap") == readFile(dir / "rest.ridgemap"));
	}
};
}  // namespace

TEST_F(KeepGoing, wrongClasses)
{
	rawlog("wrong.rawlog",
		   [&](CArchive& out)
		   {
			   for (const auto& d : drive) out << *d.scan << mrpt::poses::CPose3D(1, 2, 3);
		   });
	expectSkipped("wrong.rawlog", drive, "8 objects of the class mrpt::poses::CPose3D");
}

TEST_F(KeepGoing, holes)
{
	rawlog("holes.rawlog",
		   [&](CArchive& out)
		   {
			   for (const auto& d : drive) out << *d.scan << mrpt::serialization::CSerializable::Ptr();
		   });
	expectSkipped("holes.rawlog", drive, "8 places without an object");
}

TEST_F(KeepGoing, timeRunningBackwards)
{
	auto mixed = drive;
	std::swap(mixed[3], mixed[4]);
	rawlog("mixed.rawlog",
		   [&](CArchive& out)
		   {
			   for (const auto& d : mixed) out << *d.scan;
		   });
	auto rest = drive;
	rest.erase(rest.begin() + 3);
	expectSkipped("mixed.rawlog", rest, "1 observations with times that run backwards");
}

TEST_F(KeepGoing, timesOfSeveralSensorsMayInterleave)
{
	rawlog("two.rawlog",
		   [&](CArchive& out)
		   {
			   for (std::size_t i = 1; i < drive.size(); i++)
			   {
				   mrpt::obs::CObservationOdometry earlier;
				   earlier.timestamp = drive[i - 1].scan->timestamp;
				   out << *drive[i].scan << earlier;
			   }
		   });
	EXPECT_EQ(build("two.rawlog", "two", false).code, 0);
}

TEST_F(KeepGoing, cutAtAnyByte)
{
	writeSimplemap(dir / "whole.simplemap", drive);
	rawlog("whole.rawlog",
		   [&](CArchive& out)
		   {
			   for (const auto& d : drive) out << *d.scan;
		   });
	for (const char* kind : {".rawlog", ".simplemap"})
	{
		const std::string all = readFile(dir / ("whole" + std::string(kind))), name = "cut" + std::string(kind);
		const char* wanted = std::getenv("RIDGEMAP_CUTS");
		const std::size_t cuts = wanted ? std::size_t(std::atol(wanted)) : 15;
		std::size_t used = 0, tried = 0;
		for (std::size_t n = 0; n < all.size(); n += 1 + all.size() / cuts, tried++)
		{
			writeFile(dir / name, all.substr(0, n));
			EXPECT_EQ(build(name, "cut", false).code, 1) << n << " of " << all.size() << " bytes of " << kind;
			const RunResult r = build(name, "cut", true);
			EXPECT_TRUE(r.code == 0 || r.code == 1) << r.code;
			if (r.code != 0) continue;
			EXPECT_NE(r.out.find("left out"), std::string::npos) << r.out;
			used++;
		}
		std::printf("%s: %zu cuts, %zu of them gave something to use\n", kind, tried, used);
		EXPECT_GT(used, tried / 3);
	}
}

TEST_F(KeepGoing, simplemapThatSaysItHoldsFarTooMuch)
{
	writeSimplemap(dir / "whole.simplemap", drive);
	mrpt::maps::CSimpleMap map;
	{
		// MRPT takes 32 bytes for each of the frames that a file says it holds: here 137 GB.
		mrpt::io::CFileGZOutputStream file(dir / "forged.simplemap");
		auto archive = mrpt::serialization::archiveFrom(file);
		const std::string name = "mrpt::maps::CSimpleMap";
		archive << std::uint8_t(0x80 | name.size());
		archive.WriteBuffer(name.data(), name.size());
		archive << std::uint8_t(1) << std::uint32_t(0xffffffff);
	}
	for (const bool keepGoing : {false, true})
	{
		const RunResult r = build("forged.simplemap", "forged", keepGoing);
		EXPECT_EQ(r.code, 1);
		EXPECT_NE(r.err.find("more frames than fit"), std::string::npos) << r.err;
	}
}

}  // namespace ridgemap::test
