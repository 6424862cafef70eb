// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/poses/CPose3DPDF.h>
#include <mrpt/slam/CMetricMapBuilderICP.h>
#include <mrpt/system/datetime.h>
#include <ridgemap/CRidgePointsMap.h>

#include "pose_source.h"

namespace ridgemap::apps
{
namespace
{
/** The settings of datasets/config/icp-slam/ridge-points.ini. */
void setDefaults(mrpt::slam::CMetricMapBuilderICP& slam)
{
	auto& icp = slam.ICP_params;
	icp.maxIterations = 80;
	icp.thresholdDist = 1;
	icp.thresholdAng = mrpt::DEG2RAD(10.0);
	icp.ALFA = 0.5;
	icp.smallestThresholdDist = 0.10;
	icp.corresponding_points_decimation = 1;

	auto& options = slam.ICP_options;
	options.matchAgainstTheGrid = false;
	options.localizationLinDistance = 0.01;
	options.localizationAngDistance = mrpt::DEG2RAD(0.5);
	options.insertionLinDistance = 0.5;
	options.insertionAngDistance = mrpt::DEG2RAD(15.0);
	options.minICPgoodnessToAccept = 0.15;
}

void addRidgeMap(mrpt::slam::CMetricMapBuilderICP& slam, const MapOptions& options)
{
	CRidgePointsMap::TMapDefinition ridges;
	ridges.map.options = options;
	slam.ICP_options.mapInitializers.push_back(ridges);
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
	IcpPoses(const MapOptions& map, const mrpt::config::CConfigFileBase* config)
	{
		slam_.setMinLoggingLevel(mrpt::system::LVL_ERROR);
		slam_.options.alwaysInsertByClass.data.clear();
		setDefaults(slam_);
		if (config != nullptr) loadParameters(slam_, *config);
		addRidgeMap(slam_, map);
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

std::unique_ptr<PoseSource> makeIcpPoses(const MapOptions& map, const mrpt::config::CConfigFileBase* config)
{
	return std::make_unique<IcpPoses>(map, config);
}

}  // namespace ridgemap::apps
