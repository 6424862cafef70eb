// SPDX-License-Identifier: BSD-3-Clause
// Makes a map of all frames of a simplemap but the middle one, and finds the pose of that one from a start that is off.
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/slam/CICP.h>
#include <ridgemap/CRidgePointsMap.h>

#include <iostream>

int main(int argc, char** argv)
{
	mrpt::maps::CSimpleMap frames;
	if (argc != 2 || !frames.loadFromFile(argv[1]) || frames.size() < 2)
	{
		std::cerr << "usage: match_scan FILE.simplemap[.gz], of two frames or more\n";
		return 1;
	}

	ridgemap::MapOptions options;
	options.creation.sigma = 0.05;           // 2.5 to 3 times the noise of the scanner [m]
	ridgemap::CRidgePointsMap map(options);  // to MRPT, a CSimplePointsMap
	mrpt::maps::CSimplePointsMap scan;       // the middle frame, as the robot sees it
	mrpt::poses::CPose2D truth;
	for (std::size_t i = 0; i < frames.size(); i++)
	{
		mrpt::poses::CPose3DPDF::Ptr pose;
		mrpt::obs::CSensoryFrame::Ptr observations;
		frames.get(i, pose, observations);
		if (i != frames.size() / 2)
			observations->insertObservationsInto(map, pose->getMeanVal());
		else
		{
			observations->insertObservationsInto(scan);
			truth = mrpt::poses::CPose2D(pose->getMeanVal());
		}
	}

	mrpt::slam::CICP icp;
	icp.options.thresholdDist = 1;  // [m]
	mrpt::slam::CICP::TReturnInfo info;
	const mrpt::poses::CPose2D start = truth + mrpt::poses::CPose2D(0.3, -0.2, 0.15);
	const mrpt::poses::CPose2D found = icp.Align(&map, &scan, start, info)->getMeanVal();
	std::cout << "the start is " << start.distanceTo(truth) << " m off, the pose found " << found.distanceTo(truth)
			  << " m\n";

	map.saveMetricMapRepresentationToFile("match_scan");
	for (const auto& [name, pose] : {std::pair("start", start), std::pair("found", found)})
	{
		mrpt::maps::CSimplePointsMap moved = scan;
		moved.changeCoordinatesReference(pose);
		moved.save2D_to_text_file(std::string("match_scan_") + name + ".txt");
	}
}
