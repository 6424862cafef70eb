// SPDX-License-Identifier: BSD-3-Clause
#include "one_loop.h"

#include <mrpt/config/CConfigFile.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDF.h>
#include <mrpt/slam/CMetricMapBuilderICP.h>
#include <ridgemap/CRidgeMap2D.h>

#include <filesystem>

namespace ridgemap::benchmarks
{
namespace
{
const char* const rawlogFile = "/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";

std::vector<SeenScan> replay()
{
	registerMapClasses();
	const mrpt::config::CConfigFile config(RIDGEMAP_CONFIG "/icp-slam/ridge-points.ini");
	mrpt::slam::CMetricMapBuilderICP slam;
	slam.setMinLoggingLevel(mrpt::system::LVL_ERROR);
	slam.ICP_params.loadFromConfigFile(config, "ICP");
	slam.ICP_options.loadFromConfigFile(config, "MappingApplication");
	slam.initialize();
	mrpt::obs::CRawlog rawlog;
	rawlog.loadFromRawLogFile(rawlogFile);
	std::vector<SeenScan> seen;
	mrpt::obs::CActionCollection::Ptr action;
	mrpt::obs::CSensoryFrame::Ptr frame;
	for (std::size_t at = 0; rawlog.getActionObservationPair(action, frame, at);)
	{
		slam.processActionObservation(*action, *frame);
		SeenScan next;
		next.scan = frame->getObservationByClass<mrpt::obs::CObservation2DRangeScan>();
		if (!next.scan) continue;
		next.pose = slam.getCurrentPoseEstimation()->getMeanVal();
		next.points.insertionOptions.minDistBetweenLaserPoints = 0;
		next.points.insertObservation(*next.scan);
		seen.push_back(next);
	}
	return seen;
}

}  // namespace

bool hasOneLoop()
{
	return std::filesystem::exists(rawlogFile);
}

const std::vector<SeenScan>& oneLoop()
{
	static const std::vector<SeenScan> all = replay();
	return all;
}

}  // namespace ridgemap::benchmarks
