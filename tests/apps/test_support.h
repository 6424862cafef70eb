// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose2D.h>

#include <string>
#include <vector>

namespace ridgemap::test
{
/** A directory of its own that is removed with its contents. */
class TempDir
{
 public:
	TempDir();
	~TempDir();
	TempDir(const TempDir&) = delete;
	TempDir& operator=(const TempDir&) = delete;
	/** Path of a file in it. */
	std::string operator/(const std::string& name) const { return path_ + "/" + name; }
	/** Names of the files in it, sorted. */
	std::vector<std::string> files() const;

 private:
	std::string path_;
};

/** What a program printed and returned. */
struct RunResult
{
	int code = -1;
	std::string out, err;
};

/** Runs a program with stderr and stdout to files, as from a script. */
RunResult run(const std::string& program, const std::vector<std::string>& arguments);
RunResult runBuild(const std::vector<std::string>& arguments);
RunResult runInfo(const std::vector<std::string>& arguments);

std::string readFile(const std::string& path);
void writeFile(const std::string& path, const std::string& content);

/** One scan of a robot in a rectangular room of 8 m x 6 m with a pillar. */
struct PosedScan
{
	mrpt::poses::CPose2D pose;
	mrpt::obs::CObservation2DRangeScan::Ptr scan;
};

/** A drive of `count` scans through the room: exact poses, range noise of 1 cm, times one second apart. */
std::vector<PosedScan> simulateDrive(int count = 24);

void writeSimplemap(const std::string& path, const std::vector<PosedScan>& drive);
/** Actions with the exact increments and sensory frames in turn. */
void writeActionRawlog(const std::string& path, const std::vector<PosedScan>& drive);
/** CObservationOdometry with the exact pose and the scan, both at the same time, in turn. */
void writeObservationRawlog(const std::string& path, const std::vector<PosedScan>& drive, bool odometry = true);
/** Lines `t x y phi`, `offset` seconds later than the scans. */
void writePoses(const std::string& path, const std::vector<PosedScan>& drive, double offset = 0);

}  // namespace ridgemap::test
