// SPDX-License-Identifier: BSD-3-Clause
#include "test_support.h"

#include <fcntl.h>
#include <mrpt/core/Clock.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/serialization/CArchive.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>

namespace ridgemap::test
{
namespace fs = std::filesystem;
using mrpt::obs::CObservation2DRangeScan;

namespace
{
constexpr double startTime = 1.6e9;
constexpr double pillarX = 5, pillarY = 4, pillarRadius = 0.4;

/** Distance from inside the room along a direction to the walls or the pillar. */
double castRay(double x, double y, double angle)
{
	const double dx = std::cos(angle), dy = std::sin(angle);
	double range = 1e9;
	if (dx != 0) range = std::min(range, ((dx > 0 ? 8.0 : 0.0) - x) / dx);
	if (dy != 0) range = std::min(range, ((dy > 0 ? 6.0 : 0.0) - y) / dy);
	const double along = (pillarX - x) * dx + (pillarY - y) * dy;
	const double beside = (pillarX - x) * dy - (pillarY - y) * dx;
	if (along > 0 && std::abs(beside) < pillarRadius)
		range = std::min(range, along - std::sqrt(pillarRadius * pillarRadius - beside * beside));
	return range;
}

CObservation2DRangeScan::Ptr simulateScan(const mrpt::poses::CPose2D& pose, double time, std::mt19937& random)
{
	constexpr int beams = 181;
	std::normal_distribution<double> noise(0, 0.01);
	auto scan = CObservation2DRangeScan::Create();
	scan->aperture = float(M_PI);
	scan->maxRange = 30;
	scan->timestamp = mrpt::Clock::fromDouble(time);
	scan->sensorLabel = "LASER";
	scan->resizeScan(beams);
	for (int i = 0; i < beams; i++)
	{
		const double angle = pose.phi() - M_PI / 2 + M_PI * i / (beams - 1);
		scan->setScanRange(std::size_t(i), float(castRay(pose.x(), pose.y(), angle) + noise(random)));
		scan->setScanRangeValidity(std::size_t(i), true);
	}
	return scan;
}

int redirect(const std::string& path)
{
	return open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
}

}  // namespace

TempDir::TempDir()
{
	std::string name = (fs::temp_directory_path() / "ridgemap-test-XXXXXX").string();
	if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot create a temporary directory");
	path_ = name;
}

TempDir::~TempDir()
{
	std::error_code ignored;
	fs::remove_all(path_, ignored);
}

std::vector<std::string> TempDir::files() const
{
	std::vector<std::string> names;
	for (const auto& entry : fs::directory_iterator(path_)) names.push_back(entry.path().filename().string());
	std::sort(names.begin(), names.end());
	return names;
}

RunResult run(const std::string& program, const std::vector<std::string>& arguments)
{
	const TempDir dir;
	std::vector<char*> argv{const_cast<char*>(program.c_str())};
	for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
	argv.push_back(nullptr);
	const std::string outPath = dir / "out", errPath = dir / "err";
	const pid_t child = fork();
	if (child == 0)
	{
		dup2(redirect(outPath), STDOUT_FILENO);
		dup2(redirect(errPath), STDERR_FILENO);
		execv(program.c_str(), argv.data());
		_exit(127);
	}
	int status = 0;
	waitpid(child, &status, 0);
	RunResult r;
	r.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
	r.out = readFile(outPath);
	r.err = readFile(errPath);
	return r;
}

RunResult runBuild(const std::vector<std::string>& arguments)
{
	return run(RIDGEMAP_BUILD_PROGRAM, arguments);
}
RunResult runInfo(const std::vector<std::string>& arguments)
{
	return run(RIDGEMAP_INFO_PROGRAM, arguments);
}

std::string readFile(const std::string& path)
{
	std::ifstream in(path, std::ios::binary);
	if (!in) throw std::runtime_error("cannot read " + path);
	return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void writeFile(const std::string& path, const std::string& content)
{
	std::ofstream out(path, std::ios::binary);
	out << content;
	if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

std::vector<PosedScan> simulateDrive(int count)
{
	std::mt19937 random(7);
	std::vector<PosedScan> drive;
	for (int i = 0; i < count; i++)
	{
		const double t = double(i) / count;
		const mrpt::poses::CPose2D pose(1.5 + 2.5 * t, 1.5 + 0.5 * std::sin(3 * t), 0.3 + 1.5 * t);
		drive.push_back({pose, simulateScan(pose, startTime + i, random)});
	}
	return drive;
}

void writeSimplemap(const std::string& path, const std::vector<PosedScan>& drive)
{
	mrpt::maps::CSimpleMap map;
	for (const PosedScan& d : drive)
	{
		auto frame = mrpt::obs::CSensoryFrame::Create();
		frame->insert(d.scan);
		map.insert(mrpt::poses::CPosePDFGaussian::Create(d.pose), frame);
	}
	if (!map.saveToFile(path)) throw std::runtime_error("cannot write " + path);
}

void writeActionRawlog(const std::string& path, const std::vector<PosedScan>& drive)
{
	mrpt::io::CFileGZOutputStream file(path);
	auto archive = mrpt::serialization::archiveFrom(file);
	mrpt::poses::CPose2D last;
	for (const PosedScan& d : drive)
	{
		mrpt::obs::CActionRobotMovement2D movement;
		movement.computeFromOdometry(d.pose - last, {});
		movement.timestamp = d.scan->timestamp;
		last = d.pose;
		mrpt::obs::CActionCollection actions;
		actions.insert(movement);
		mrpt::obs::CSensoryFrame frame;
		frame.insert(d.scan);
		archive << actions << frame;
	}
}

void writeObservationRawlog(const std::string& path, const std::vector<PosedScan>& drive, bool odometry)
{
	mrpt::io::CFileGZOutputStream file(path);
	auto archive = mrpt::serialization::archiveFrom(file);
	for (const PosedScan& d : drive)
	{
		mrpt::obs::CObservationOdometry pose;
		pose.timestamp = d.scan->timestamp;
		pose.odometry = d.pose;
		if (odometry) archive << pose;
		archive << *d.scan;
	}
}

void writePoses(const std::string& path, const std::vector<PosedScan>& drive, double offset)
{
	std::string text = "# t x y phi\n";
	for (const PosedScan& d : drive)
	{
		char line[200];
		std::snprintf(line, sizeof(line), "%.9f %.17g %.17g %.17g\n", mrpt::Clock::toDouble(d.scan->timestamp) + offset,
					  d.pose.x(), d.pose.y(), d.pose.phi());
		text += line;
	}
	writeFile(path, text);
}

}  // namespace ridgemap::test
