// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPose3DPDF.h>
#include <mrpt/slam/CMetricMapBuilderICP.h>
#include <mrpt/system/datetime.h>

#include "pose_source.h"

namespace ridgemap::apps
{
namespace
{
/** Every scan is matched, with all its points, and only pairs that are nearest in both directions count: on the logs
 * tried, this gives far sharper maps than the settings of MRPT's icp-slam demo, which skip scans to save time. */
void setDefaults(mrpt::slam::CMetricMapBuilderICP& slam)
{
	auto& icp = slam.ICP_params;
	icp.maxIterations = 200;
	icp.thresholdDist = 1;
	icp.thresholdAng = mrpt::DEG2RAD(0.1);
	icp.ALFA = 0.8;
	icp.smallestThresholdDist = 0.05;
	icp.corresponding_points_decimation = 1;
	icp.onlyUniqueRobust = true;

	auto& options = slam.ICP_options;
	options.matchAgainstTheGrid = false;
	options.localizationLinDistance = 0;
	options.localizationAngDistance = 0;
	options.insertionLinDistance = 0.5;
	options.insertionAngDistance = mrpt::DEG2RAD(20.0);
	options.minICPgoodnessToAccept = 0.4;
}

void addPointsMap(mrpt::slam::CMetricMapBuilderICP& slam)
{
	mrpt::maps::CSimplePointsMap::TMapDefinition points;
	points.insertionOpts.minDistBetweenLaserPoints = 0.05f;
	points.insertionOpts.fuseWithExisting = false;
	points.insertionOpts.isPlanarMap = true;
	slam.ICP_options.mapInitializers.push_back(points);
}

void loadParameters(mrpt::slam::CMetricMapBuilderICP& slam, const mrpt::config::CConfigFileBase& config)
{
	if (config.sectionExists("ICP")) slam.ICP_params.loadFromConfigFile(config, "ICP");
	const std::string section = "MappingApplication";
	if (!config.sectionExists(section)) return;
	auto& o = slam.ICP_options;
	const auto length = [&](const char* key, double& value) { value = config.read_double(section, key, value); };
	const auto angle = [&](const char* key, double& value)
	{ value = mrpt::DEG2RAD(config.read_double(section, key, mrpt::RAD2DEG(value))); };
	length("localizationLinDistance", o.localizationLinDistance);
	angle("localizationAngDistance", o.localizationAngDistance);
	length("insertionLinDistance", o.insertionLinDistance);
	angle("insertionAngDistance", o.insertionAngDistance);
	length("minICPgoodnessToAccept", o.minICPgoodnessToAccept);
}

class IcpPoses : public PoseSource
{
 public:
	explicit IcpPoses(const mrpt::config::CConfigFileBase* config)
	{
		slam_.setMinLoggingLevel(mrpt::system::LVL_ERROR);
		slam_.options.alwaysInsertByClass.data.clear();
		setDefaults(slam_);
		if (config != nullptr) loadParameters(slam_, *config);
		addPointsMap(slam_);
		slam_.initialize();
	}

	void see(const mrpt::obs::CActionCollection::Ptr& action) override
	{
		action_ = action;
		for (std::size_t i = 0; i < action->size(); i++) addTime(*action->get(i));
	}

	void see(const mrpt::obs::CSensoryFrame::Ptr& frame) override
	{
		for (const auto& observation : *frame) addTime(*observation);
		mrpt::obs::CActionCollection none;
		slam_.processActionObservation(action_ ? *action_ : none, *frame);
		action_.reset();
		updatePose();
	}

	void see(const mrpt::obs::CObservation::Ptr& observation) override
	{
		addTime(*observation);
		slam_.processObservation(observation);
		updatePose();
	}

	std::optional<mrpt::poses::CPose3D> poseOf(const mrpt::obs::CObservation&) const override { return pose_; }
	std::string name() const override { return "ICP-SLAM"; }

 private:
	mrpt::slam::CMetricMapBuilderICP slam_;
	mrpt::obs::CActionCollection::Ptr action_;
	mrpt::poses::CPose3D pose_;
	double seconds_ = 0;  ///< time given to the last object without one

	/** ICP-SLAM insists on times, which simulated logs do not have. */
	template <class Timed>
	void addTime(Timed& object)
	{
		if (object.timestamp == INVALID_TIMESTAMP) object.timestamp = mrpt::Clock::fromDouble(++seconds_);
	}

	void updatePose()
	{
		if (const auto pdf = slam_.getCurrentPoseEstimation()) pose_ = pdf->getMeanVal();
	}
};

}  // namespace

std::unique_ptr<PoseSource> makeIcpPoses(const mrpt::config::CConfigFileBase* config)
{
	return std::make_unique<IcpPoses>(config);
}

}  // namespace ridgemap::apps
