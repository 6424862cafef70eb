// SPDX-License-Identifier: BSD-3-Clause
#include "pose_track.h"

#include <mrpt/math/CQuaternion.h>
#include <mrpt/math/slerp.h>

#include <algorithm>
#include <cmath>

#include "../common/gz_input.h"
#include "../common/number_line.h"
#include "../common/user_error.h"

namespace ridgemap::apps
{
namespace
{
/** The pose on a line without its time; nothing if the quaternion is none. */
std::optional<mrpt::poses::CPose3D> poseFrom(const std::vector<double>& v)
{
	if (v.size() == 4) return mrpt::poses::CPose3D(v[1], v[2], 0, v[3], 0, 0);
	const double norm = std::sqrt(v[4] * v[4] + v[5] * v[5] + v[6] * v[6] + v[7] * v[7]);
	if (!(std::abs(norm - 1) < 0.01)) return std::nullopt;
	const mrpt::math::CQuaternionDouble q(v[7] / norm, v[4] / norm, v[5] / norm, v[6] / norm);
	return mrpt::poses::CPose3D(q, v[1], v[2], v[3]);
}

}  // namespace

void PoseTrack::finish()
{
	std::stable_sort(poses_.begin(), poses_.end(),
					 [](const TimedPose& a, const TimedPose& b) { return a.time < b.time; });
	poses_.erase(std::unique(poses_.begin(), poses_.end(),
							 [](const TimedPose& a, const TimedPose& b) { return a.time == b.time; }),
				 poses_.end());
}

std::optional<mrpt::poses::CPose3D> PoseTrack::at(double time) const
{
	const auto after =
		std::lower_bound(poses_.begin(), poses_.end(), time, [](const TimedPose& p, double t) { return p.time < t; });
	if (after == poses_.end()) return std::nullopt;
	if (after->time == time) return after->pose;
	if (after == poses_.begin()) return std::nullopt;
	const auto before = after - 1;
	mrpt::math::TPose3D between;
	mrpt::math::slerp(before->pose.asTPose(), after->pose.asTPose(),
					  (time - before->time) / (after->time - before->time), between);
	return mrpt::poses::CPose3D(between);
}

PoseTrack readPoseTrack(const std::string& path)
{
	GzInput input(path);
	PoseTrack track;
	std::string text;
	for (std::size_t line = 1; input.readLine(text); line++)
	{
		const auto fail = [&](const std::string& why)
		{
			throw UserError(path + ":" + std::to_string(line) + ": " + why,
							"give 't x y phi' or TUM's 't x y z qx qy qz qw' on every line");
		};
		const auto fields = splitFields(text);
		if (fields.empty()) continue;
		if (fields.size() != 4 && fields.size() != 8)
			fail("expected 4 or 8 numbers, found " + std::to_string(fields.size()));
		std::vector<double> values;
		for (const std::string& f : fields)
		{
			const auto v = parseNumber(f);
			if (!v || !std::isfinite(*v)) fail("'" + f.substr(0, 40) + "' is not a finite number");
			values.push_back(*v);
		}
		const auto pose = poseFrom(values);
		if (!pose) fail("the quaternion does not have length 1");
		track.add(values[0], *pose);
	}
	if (track.empty()) throw UserError("'" + path + "' holds no poses", "give 't x y phi' on every line");
	track.finish();
	return track;
}

}  // namespace ridgemap::apps
