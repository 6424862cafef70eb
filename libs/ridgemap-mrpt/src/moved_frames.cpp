// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDF.h>
#include <ridgemap/moved_frames.h>

#include <stdexcept>
#include <string>

namespace ridgemap
{
namespace
{
struct Frame
{
	mrpt::poses::CPose3D pose;
	mrpt::obs::CSensoryFrame::ConstPtr observations;

	std::size_t size() const { return observations ? observations->size() : 0; }
};

Frame frameOf(const mrpt::maps::CSimpleMap& map, std::size_t i)
{
	mrpt::poses::CPose3DPDF::ConstPtr pdf;
	Frame frame;
	map.get(i, pdf, frame.observations);
	if (pdf)
		frame.pose = pdf->getMeanVal();
	else
		frame.observations.reset();
	return frame;
}

bool samePose(const mrpt::poses::CPose3D& a, const mrpt::poses::CPose3D& b)
{
	const auto &p = a.getRotationMatrix(), &q = b.getRotationMatrix();
	bool same = a.x() == b.x() && a.y() == b.y() && a.z() == b.z();
	for (int row = 0; row < 3; row++)
		for (int column = 0; column < 3; column++) same = same && p(row, column) == q(row, column);
	return same;
}

void checkFrames(const mrpt::maps::CSimpleMap& before, const mrpt::maps::CSimpleMap& after)
{
	if (before.size() != after.size())
		throw std::invalid_argument("moveFrames: the maps hold " + std::to_string(before.size()) + " and " +
									std::to_string(after.size()) + " frames; give the same frames with other poses");
	for (std::size_t i = 0; i < before.size(); i++)
		if (frameOf(before, i).size() != frameOf(after, i).size())
			throw std::invalid_argument("moveFrames: frame " + std::to_string(i) +
										" holds another number of observations in the two maps");
}
}  // namespace

MovedFrames moveFrames(CRidgeMap2D& map, const mrpt::maps::CSimpleMap& before, const mrpt::maps::CSimpleMap& after)
{
	checkFrames(before, after);
	MovedFrames result;
	for (std::size_t i = 0; i < before.size(); i++)
	{
		const Frame from = frameOf(before, i), to = frameOf(after, i);
		if (samePose(from.pose, to.pose))
		{
			result.kept++;
			continue;
		}
		for (std::size_t k = 0; k < from.size(); k++)
			map.reanchor(*from.observations->getObservationByIndex(k), from.pose, to.pose);
		result.moved++;
	}
	return result;
}

}  // namespace ridgemap
