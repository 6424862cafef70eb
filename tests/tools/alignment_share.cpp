// SPDX-License-Identifier: BSD-3-Clause
// alignment-share SIMPLEMAP.gz ICP.ini [STARTS [SEED]]: how often MRPT's ICP goes wrong from perturbed starts.
// The even frames make a map; every odd frame is aligned with it, first from its own pose, which gives the reference,
// and then from STARTS poses (default 4) each that are off by 0.2 m and up to 5 degrees, and by 0.4 m and up to 20
// degrees. An alignment has failed where it ends more than 0.1 m or 2 degrees from the reference. Frames that MRPT's
// ICP leaves more than 0.2 m or 3 degrees from their pose with either map say nothing and are left out, for all maps
// alike. The ridge map is tried with the options of the INI file, and once more with shiftStarts and slideReach, for
// the map holds what can be seen.
#include <mrpt/config/CConfigFile.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3DPDF.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/slam/CICP.h>
#include <ridgemap/CRidgePointsMap.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
using mrpt::maps::CSimplePointsMap;
using mrpt::poses::CPose2D;

struct Frame
{
	mrpt::obs::CSensoryFrame::Ptr observations;
	CPose2D pose;
	CSimplePointsMap points;
};

struct Matcher
{
	const char* name;
	CSimplePointsMap::Ptr map;
	mrpt::slam::CICP icp;
	std::vector<CPose2D> references;
	double seconds = 0;
	std::size_t calls = 0;

	CPose2D align(const Frame& frame, const CPose2D& start)
	{
		const std::clock_t begin = std::clock();
		mrpt::slam::CICP::TReturnInfo info;
		const auto found = icp.AlignPDF(map.get(), &frame.points, mrpt::poses::CPosePDFGaussian(start), info);
		seconds += double(std::clock() - begin) / CLOCKS_PER_SEC;
		calls++;
		return found->getMeanVal();
	}
};

bool nearTo(const CPose2D& a, const CPose2D& b, double distance, double degrees)
{
	return std::hypot(a.x() - b.x(), a.y() - b.y()) <= distance &&
		   std::abs(std::remainder(a.phi() - b.phi(), 6.283185307179586)) <= mrpt::DEG2RAD(degrees);
}

std::vector<Frame> readFrames(const std::string& file)
{
	mrpt::maps::CSimpleMap map;
	if (!map.loadFromFile(file)) throw std::runtime_error("cannot read '" + file + "'");
	std::vector<Frame> frames;
	for (std::size_t i = 0; i < map.size(); i++)
	{
		mrpt::poses::CPose3DPDF::Ptr pose;
		Frame f;
		map.get(i, pose, f.observations);
		f.pose = CPose2D(pose->getMeanVal());
		f.points.insertionOptions.minDistBetweenLaserPoints = 0.02f;
		for (const auto& o : *f.observations) f.points.insertObservation(*o);
		frames.push_back(f);
	}
	return frames;
}

Matcher makeMatcher(const char* name, const CSimplePointsMap::Ptr& map, const std::vector<Frame>& frames,
					const mrpt::slam::CICP::TConfigParams& params)
{
	for (std::size_t i = 0; i < frames.size(); i += 2)
	{
		const mrpt::poses::CPose3D pose(frames[i].pose);
		for (const auto& o : *frames[i].observations) map->insertObservation(*o, pose);
	}
	Matcher m{name, map, mrpt::slam::CICP(params), {}};
	for (std::size_t i = 1; i < frames.size(); i += 2) m.references.push_back(m.align(frames[i], frames[i].pose));
	return m;
}

void report(std::vector<Matcher>& matchers, const std::vector<Frame>& frames, double distance, double degrees,
			unsigned starts, unsigned seed)
{
	for (auto& m : matchers)
	{
		std::mt19937 random(seed);
		std::uniform_real_distribution<double> unit(-1, 1);
		std::size_t failed = 0, tried = 0;
		m.seconds = 0;
		m.calls = 0;
		for (std::size_t k = 0; k < m.references.size(); k++)
		{
			const Frame& frame = frames[2 * k + 1];
			bool sound = true;
			for (const auto& other : matchers) sound = sound && nearTo(other.references[k], frame.pose, 0.2, 3);
			for (unsigned s = 0; s < starts; s++)
			{
				const double way = 3.141592653589793 * unit(random), turn = mrpt::DEG2RAD(degrees) * unit(random);
				if (!sound) continue;
				const CPose2D start(frame.pose.x() + distance * std::cos(way),
									frame.pose.y() + distance * std::sin(way), frame.pose.phi() + turn);
				tried++;
				failed += !nearTo(m.align(frame, start), m.references[k], 0.1, 2);
			}
		}
		std::printf("| %s | %.1f m, %g deg | %zu of %zu | %.2f %% | %.2f |\n", m.name, distance, degrees, failed, tried,
					100.0 * double(failed) / double(tried), 1e3 * m.seconds / double(m.calls));
	}
}
}  // namespace

int main(int argc, char** argv)
{
	try
	{
		if (argc < 3) throw std::runtime_error("usage: alignment-share SIMPLEMAP.gz ICP.ini [STARTS [SEED]]");
		const unsigned starts = argc > 3 ? unsigned(std::stoul(argv[3])) : 4;
		const unsigned seed = argc > 4 ? unsigned(std::stoul(argv[4])) : 1;
		const mrpt::config::CConfigFile config(argv[2]);
		mrpt::slam::CICP::TConfigParams params;
		params.loadFromConfigFile(config, "ICP");
		ridgemap::MapOptions options;
		options.loadFromConfigFile(config, "MappingApplication_ridgePoints_00");
		const auto frames = readFrames(argv[1]);
		const auto points = []
		{
			auto map = std::make_shared<CSimplePointsMap>();
			map->insertionOptions.minDistBetweenLaserPoints = 0.05f;
			return map;
		};
		auto levenberg = params;
		levenberg.ICP_algorithm = mrpt::slam::icpLevenbergMarquardt;
		std::vector<Matcher> matchers;
		const auto ridges = [&] { return std::make_shared<ridgemap::CRidgePointsMap>(options); };
		matchers.push_back(makeMatcher("ridge map", ridges(), frames, params));
		options.matching.shiftStarts = 2;
		options.matching.slideReach = 0.6;
		matchers.push_back(makeMatcher("ridge map, all places searched", ridges(), frames, params));
		matchers.push_back(makeMatcher("points map", points(), frames, params));
		matchers.push_back(makeMatcher("points map, Levenberg-Marquardt", points(), frames, levenberg));
		std::printf("| map | start off by up to | failed | share | time [ms] |\n|---|---|---|---|---|\n");
		report(matchers, frames, 0.2, 5, starts, seed);
		report(matchers, frames, 0.4, 20, starts, seed);
		return 0;
	}
	catch (const std::exception& e)
	{
		std::fprintf(stderr, "alignment-share: %s\n", e.what());
		return 1;
	}
}
