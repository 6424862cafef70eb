// SPDX-License-Identifier: BSD-3-Clause
// A map with a sliding window is the map of the scans in the window alone, to the bit.
#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>

#include "scenes.h"

using namespace ridgemap;
using namespace ridgemap::test;

namespace
{
struct TimedScan
{
	mrpt::obs::CObservation2DRangeScan scan;
	mrpt::poses::CPose3D pose;
};

/** A drive through a room, four scans a second; some beams meet nothing. */
std::vector<TimedScan> drive(std::size_t count)
{
	std::vector<TimedScan> all;
	for (std::size_t i = 0; i < count; i++)
	{
		const double x = -2 + 0.1 * double(i), y = 0.3 * std::sin(0.4 * double(i)), phi = 0.05 * double(i);
		TimedScan s{scanOfRoom(x, y, phi, 181), mrpt::poses::CPose3D(x, y, 0, phi, 0, 0)};
		s.scan.timestamp = mrpt::Clock::fromDouble(1000 + 0.25 * double(i));
		s.scan.maxRange = 20;
		for (std::size_t k = i % 9; k < 181; k += 30)
		{
			s.scan.setScanRange(k, 20);
			s.scan.setScanRangeValidity(k, false);
		}
		all.push_back(s);
	}
	return all;
}

CRidgeMap2D emptyMap(unsigned keepScans, double keepSeconds)
{
	MapOptions o;
	o.insertion.keepScans = keepScans;
	o.insertion.keepSeconds = keepSeconds;
	o.insertion.freeRayRange = 5;
	return CRidgeMap2D(o);
}

void expectScansAlone(const CRidgeMap2D& map, const std::vector<TimedScan>& scans, std::size_t first, std::size_t last)
{
	CRidgeMap2D alone = emptyMap(0, 0);
	for (std::size_t i = first; i < last; i++) alone.insertObservation(scans[i].scan, scans[i].pose);
	EXPECT_TRUE(samePolylines(map.ridges(), alone.ridges()));
	EXPECT_TRUE(samePolylines(map.walls(), alone.walls()));
	EXPECT_TRUE(map.core().freeCells() == alone.core().freeCells());
	EXPECT_EQ(map.core().statistics().measurements, alone.core().statistics().measurements);
	EXPECT_EQ(map.core().cells().size(), alone.core().cells().size());
}
}  // namespace

TEST(ScanWindow, KeepsTheLastScans)
{
	const auto scans = drive(20);
	CRidgeMap2D map = emptyMap(6, 0);
	for (std::size_t i = 0; i < scans.size(); i++)
	{
		map.insertObservation(scans[i].scan, scans[i].pose);
		if (i % 7 == 4) expectScansAlone(map, scans, i < 6 ? 0 : i - 5, i + 1);
	}
	expectScansAlone(map, scans, 14, 20);
}

TEST(ScanWindow, KeepsTheLastSeconds)
{
	const auto scans = drive(20);
	CRidgeMap2D map = emptyMap(0, 2);
	for (const TimedScan& s : scans) map.insertObservation(s.scan, s.pose);
	expectScansAlone(map, scans, 11, 20);
}

TEST(ScanWindow, CopiesAndFilesGoOnForgetting)
{
	const auto scans = drive(16);
	std::vector<std::uint8_t> bytes;
	{
		CRidgeMap2D map = emptyMap(5, 0);
		for (std::size_t i = 0; i < 9; i++) map.insertObservation(scans[i].scan, scans[i].pose);
		bytes = bytesOf(map);
	}
	CRidgeMap2D loaded;
	readInto(loaded, bytes);
	EXPECT_TRUE(bytesOf(loaded) == bytes);
	CRidgeMap2D copy = loaded;
	for (std::size_t i = 9; i < 16; i++) loaded.insertObservation(scans[i].scan, scans[i].pose);
	expectScansAlone(loaded, scans, 11, 16);
	expectScansAlone(copy, scans, 4, 9);
	copy.clear();
	EXPECT_TRUE(copy.isEmpty());
}

TEST(ScanWindow, WhatIsErasedOrMovedByHandIsForgottenOnce)
{
	const auto scans = drive(14);
	CRidgeMap2D map = emptyMap(6, 0);
	for (std::size_t i = 0; i < 8; i++) map.insertObservation(scans[i].scan, scans[i].pose);
	EXPECT_TRUE(map.eraseObservation(scans[7].scan, scans[7].pose));
	EXPECT_THROW(map.eraseObservation(scans[0].scan, scans[0].pose), std::exception) << "it has gone by itself";
	const mrpt::poses::CPose3D moved(0.5, 0.1, 0, 0.2, 0, 0);
	EXPECT_TRUE(map.reanchor(scans[6].scan, scans[6].pose, moved));
	for (std::size_t i = 8; i < 14; i++) map.insertObservation(scans[i].scan, scans[i].pose);
	expectScansAlone(map, scans, 8, 14);
}

TEST(ScanWindow, AScanThatCannotBeTakenOutLeavesTheMapAsItWas)
{
	const auto scans = drive(8);
	CRidgeMap2D map = emptyMap(3, 0);
	for (std::size_t i = 0; i < 3; i++) map.insertObservation(scans[i].scan, scans[i].pose);
	// Of three scans that have to go, the last one is no longer there: as in a forged file, whose window is not
	// checked.
	map.eraseMeasurements(observationToMeasurements(scans[2].scan, scans[2].pose, map.insertionOptions));
	map.insertionOptions.keepScans = 1;
	const auto before = bytesOf(map);
	const auto ridges = map.ridges();
	for (int attempt = 0; attempt < 2; attempt++)
	{
		try
		{
			map.insertObservation(scans[3].scan, scans[3].pose);
			FAIL() << "a scan was taken out that is not there";
		}
		catch (const std::exception& e)
		{
			EXPECT_NE(std::string(e.what()).find("sliding window"), std::string::npos) << e.what();
		}
		EXPECT_TRUE(bytesOf(map) == before);
		EXPECT_TRUE(samePolylines(map.ridges(), ridges));
	}
	// The ways out that the message names.
	CRidgeMap2D open = map;
	open.insertionOptions.keepScans = 0;
	open.insertObservation(scans[3].scan, scans[3].pose);
	EXPECT_FALSE(open.isEmpty());
	map.clear();
	for (std::size_t i = 3; i < 6; i++) map.insertObservation(scans[i].scan, scans[i].pose);
	expectScansAlone(map, scans, 5, 6);
}

TEST(ScanWindow, AScanWithARayThatIsNotOnTheMapIsNotInsertedAtAll)
{
	for (const unsigned keepScans : {0u, 3u})
	{
		CRidgeMap2D map = emptyMap(keepScans, 0);
		map.insertScan({1, {{1, 2, 0, 0}}, {}});
		const auto before = bytesOf(map);
		EXPECT_THROW(map.insertScan({2, {{3, 4, 0, 0}}, {{0, 0, 1e7, 0}}}), std::exception);
		EXPECT_TRUE(bytesOf(map) == before);
	}
}

TEST(ScanWindow, AScanOlderThanTheWindowGoesAtOnce)
{
	const auto scans = drive(12);
	CRidgeMap2D map = emptyMap(0, 1);
	for (std::size_t i = 4; i < 12; i++) map.insertObservation(scans[i].scan, scans[i].pose);
	map.insertObservation(scans[0].scan, scans[0].pose);
	expectScansAlone(map, scans, 7, 12);
	map.insertionOptions.keepScans = 2;
	map.insertObservation(scans[6].scan, scans[6].pose);
	expectScansAlone(map, scans, 11, 12);
}

TEST(FreeRays, BeamsWithoutReturnAreFreeAsFarAsAsked)
{
	const auto scans = drive(1);
	CRidgeMap2D with = emptyMap(0, 0), without{Options()};
	with.insertObservation(scans[0].scan, scans[0].pose);
	without.insertObservation(scans[0].scan, scans[0].pose);
	const auto rays = observationToFreeRays(scans[0].scan, scans[0].pose, with.insertionOptions);
	ASSERT_EQ(rays.size(), 7u);
	for (const FreeRay& r : rays)
	{
		EXPECT_NEAR(std::hypot(r.x - r.sensorX, r.y - r.sensorY), 5, 1e-9);
		const Point2 far{r.sensorX + 0.95 * (r.x - r.sensorX), r.sensorY + 0.95 * (r.y - r.sensorY)};
		EXPECT_GT(with.core().passes(far), 0);
		EXPECT_EQ(without.core().passes(far), 0) << "outside of the room";
	}
	auto dark = scans[0].scan;
	for (std::size_t k = 0; k < dark.getScanSize(); k++) dark.setScanRange(k, k % 2 ? 0.f : std::nanf(""));
	EXPECT_TRUE(observationToFreeRays(dark, scans[0].pose, with.insertionOptions).empty());
	EXPECT_TRUE(observationToFreeRays(scans[0].scan, scans[0].pose, without.insertionOptions).empty());
	EXPECT_TRUE(with.eraseObservation(scans[0].scan, scans[0].pose));
	EXPECT_TRUE(with.isEmpty());
}
