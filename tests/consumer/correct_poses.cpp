// SPDX-License-Identifier: BSD-3-Clause
// A map of all frames of a simplemap, after poses of some of them were corrected: moved, or made from scratch.
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <ridgemap/moved_frames.h>

#include <iostream>

namespace
{
ridgemap::CRidgeMap2D mapOf(const mrpt::maps::CSimpleMap& frames)
{
	ridgemap::CRidgeMap2D map;
	map.loadFromSimpleMap(frames);
	return map;
}
}  // namespace

int main(int argc, char** argv)
{
	mrpt::maps::CSimpleMap before;
	if (argc != 2 || !before.loadFromFile(argv[1]))
	{
		std::cerr << "usage: correct_poses FILE.simplemap[.gz]\n";
		return 1;
	}

	// Say, a loop was closed, and the last tenth of the frames turned out to lie 5 cm further left.
	mrpt::maps::CSimpleMap after = before;
	for (std::size_t i = before.size() - before.size() / 10; i < before.size(); i++)
	{
		mrpt::poses::CPose3DPDF::Ptr pose;
		mrpt::obs::CSensoryFrame::Ptr observations;
		before.get(i, pose, observations);
		const mrpt::poses::CPose3D corrected = pose->getMeanVal() + mrpt::poses::CPose3D(0, 0.05, 0);
		after.set(i, mrpt::poses::CPose3DPDFGaussian::Create(corrected), observations);
	}

	ridgemap::CRidgeMap2D map = mapOf(before);
	const ridgemap::MovedFrames result = ridgemap::moveFrames(map, before, after);
	std::cout << result.moved << " frames moved, " << result.kept << " kept\n";

	const auto ridges = map.ridges(), fromScratch = mapOf(after).ridges();
	bool same = ridges.size() == fromScratch.size();
	for (std::size_t i = 0; same && i < ridges.size(); i++) same = ridges[i].points == fromScratch[i].points;
	std::cout << (same ? "the same ridges" : "other ridges") << " as from scratch\n";
	return same ? 0 : 1;
}
