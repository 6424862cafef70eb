// SPDX-License-Identifier: BSD-3-Clause
#include "localization.h"

#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <cmath>

#include "../common/random.h"
#include "quantile.h"

namespace ridgemap::apps
{
namespace
{
using mrpt::poses::CPose2D;

constexpr double degree = 3.14159265358979323846 / 180;

/** Standard deviations of an odometry step over the distance d [m] and [rad]. */
double positionNoise(double d)
{
	return 0.01 + 0.02 * d;
}
double headingNoise(double d)
{
	return (0.3 + 0.3 * d) * degree;
}

/** The step as a robot's odometry would have it, with the same noise in the model that the filter draws from. */
mrpt::obs::CActionRobotMovement2D odometry(const CPose2D& step, Random& random)
{
	const double d = step.norm(), position = positionNoise(d), heading = headingNoise(d);
	mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
	model.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
	model.gaussianModel = {0, 0, 0, 0, float(position), float(heading)};
	const double dx = position * random.normal(), dy = position * random.normal(), dphi = heading * random.normal();
	mrpt::obs::CActionRobotMovement2D movement;
	movement.computeFromOdometry({step.x() + dx, step.y() + dy, step.phi() + dphi}, model);
	return movement;
}

struct Errors
{
	std::vector<double> position, heading;  ///< [m], [rad]
};

void follow(const mrpt::maps::CMetricMap& map, const std::vector<PosedScan>& pass, const FilterSettings& settings,
			std::uint32_t seed, Errors& errors)
{
	mrpt::random::getRandomGenerator().randomize(seed);
	Random noise(seed);
	mrpt::slam::CMonteCarloLocalization2D filter(settings.particles);
	// The map outlives the filter, which wants a shared pointer.
	filter.options.metricMap = mrpt::maps::CMetricMap::ConstPtr(&map, [](const mrpt::maps::CMetricMap*) {});
	const CPose2D first(pass.front().pose);
	const double angle = settings.startAngle * degree;
	filter.resetUniform(first.x() - settings.start, first.x() + settings.start, first.y() - settings.start,
						first.y() + settings.start, first.phi() - angle, first.phi() + angle, int(settings.particles));
	mrpt::bayes::CParticleFilter steps;
	steps.m_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
	steps.m_options.resamplingMethod = mrpt::bayes::CParticleFilter::prSystematic;
	steps.m_options.adaptiveSampleSize = false;
	for (std::size_t i = 0; i < pass.size(); i++)
	{
		const CPose2D truth(pass[i].pose);
		const CPose2D step = i > 0 ? truth - CPose2D(pass[i - 1].pose) : CPose2D();
		mrpt::obs::CActionCollection action;
		auto movement = odometry(step, noise);
		action.insert(movement);
		mrpt::obs::CSensoryFrame frame;
		frame.insert(thinned(*pass[i].scan, settings.beams));
		steps.executeOn(filter, &action, &frame);
		if (i < settings.settling) continue;
		const CPose2D error = filter.getMeanVal() - truth;
		errors.position.push_back(error.norm());
		errors.heading.push_back(std::abs(error.phi()));
	}
}
}  // namespace

Localization localise(const mrpt::maps::CMetricMap& map, const std::vector<PosedScan>& secondPass,
					  const FilterSettings& settings)
{
	Errors errors;
	for (std::size_t run = 0; run < settings.runs && !secondPass.empty(); run++)
		follow(map, secondPass, settings, std::uint32_t(run + 1), errors);
	Localization l;
	l.count = errors.position.size();
	l.median = quantile(errors.position, 0.5);
	l.p99 = quantile(errors.position, 0.99);
	l.heading = quantile(errors.heading, 0.5) / degree;
	for (const double e : errors.position) l.lost += e > settings.lost ? 1.0 / double(l.count) : 0;
	return l;
}

}  // namespace ridgemap::apps
