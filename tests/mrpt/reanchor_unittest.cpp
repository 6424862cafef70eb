// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <ridgemap/moved_frames.h>

#include "scenes.h"

using namespace ridgemap;
using namespace ridgemap::test;
using mrpt::poses::CPose3D;

namespace
{
/** Scans of a room from several places, each pose turned by `drift` times its number. */
mrpt::maps::CSimpleMap drive(double drift, int frames = 8, int movedFrom = 0)
{
	mrpt::maps::CSimpleMap map;
	for (int i = 0; i < frames; i++)
	{
		const double x = -1 + 0.25 * i, y = 0.1 * i, phi = 0.2 * i, off = i < movedFrom ? 0 : drift * i;
		auto frame = mrpt::obs::CSensoryFrame::Create();
		frame->insert(mrpt::obs::CObservation2DRangeScan::Create(scanOfRoom(x, y, phi, 721)));
		auto pdf = mrpt::poses::CPose3DPDFGaussian::Create();
		pdf->mean = CPose3D(x + off, y - off, 0, phi + off, 0, 0);
		map.insert(pdf, frame);
	}
	return map;
}

CRidgeMap2D built(const mrpt::maps::CSimpleMap& frames)
{
	CRidgeMap2D map;
	map.loadFromProbabilisticPosesAndObservations(frames);
	return map;
}

bool sameMap(const CRidgeMap2D& a, const CRidgeMap2D& b)
{
	return samePolylines(a.ridges(), b.ridges()) && samePolylines(a.walls(), b.walls()) && bytesOf(a) == bytesOf(b);
}
}  // namespace

TEST(Reanchor, EqualsAMapBuiltAtTheNewPose)
{
	const auto scan = scanOfRoom(0.4, 0.2, -0.5, 2000);
	const CPose3D wrong(0.5, 0.3, 0, -0.45, 0, 0), right(0.4, 0.2, 0, -0.5, 0, 0);
	CRidgeMap2D moved, expected;
	moved.insertObservation(scan, wrong);
	moved.walls();
	expected.insertObservation(scan, right);
	EXPECT_FALSE(sameMap(moved, expected));
	EXPECT_TRUE(moved.reanchor(scan, wrong, right));
	EXPECT_TRUE(sameMap(moved, expected));
	EXPECT_ANY_THROW(moved.reanchor(scan, wrong, right));
	EXPECT_TRUE(sameMap(moved, expected)) << "the map is as before";
}

TEST(Reanchor, AnInsertionThatFailsLeavesTheMapAsItWas)
{
	const auto scan = scanOfRoom(0.4, 0.2, -0.5, 2000);
	const CPose3D pose(0.4, 0.2, 0, -0.5, 0, 0);
	CRidgeMap2D map, expected;
	map.insertObservation(scan, pose);
	expected.insertObservation(scan, pose);
	EXPECT_ANY_THROW(map.reanchor(scan, pose, CPose3D(1e9, 0, 0, 0, 0, 0)));
	EXPECT_TRUE(sameMap(map, expected));
}

TEST(MovedFrames, EqualTheMapBuiltFromScratch)
{
	const auto before = drive(0.02), after = drive(0);
	CRidgeMap2D map = built(before);
	map.walls();
	EXPECT_FALSE(sameMap(map, built(after)));
	const MovedFrames result = moveFrames(map, before, after);
	EXPECT_EQ(result.moved, 7u);
	EXPECT_EQ(result.kept, 1u);
	EXPECT_TRUE(sameMap(map, built(after)));
}

TEST(MovedFrames, OnlyThoseThatMovedAreTouched)
{
	const auto before = drive(0.02, 8, 6), after = drive(0);
	CRidgeMap2D map = built(before);
	EXPECT_EQ(moveFrames(map, before, after).moved, 2u);
	EXPECT_TRUE(sameMap(map, built(after)));
	EXPECT_EQ(moveFrames(map, after, after).moved, 0u);
}

TEST(MovedFrames, OtherFramesAreRefused)
{
	CRidgeMap2D map = built(drive(0));
	EXPECT_THROW(moveFrames(map, drive(0), drive(0, 7)), std::invalid_argument);
	EXPECT_TRUE(sameMap(map, built(drive(0))));
}
