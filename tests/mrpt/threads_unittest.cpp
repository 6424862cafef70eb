// SPDX-License-Identifier: BSD-3-Clause
// Queries of every kind from many threads while a map grows, as the contract allows it: on copies that share their
// state with the map that is changed, and on the map itself between changes. Every answer must be that of a map with
// the same scans that no other thread has touched.
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>

#include <atomic>
#include <mutex>
#include <thread>

#include "scenes.h"

using namespace ridgemap;
using namespace ridgemap::test;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

namespace
{
constexpr std::size_t scanCount = 8;
constexpr int readerCount = 4;

struct Step
{
	mrpt::obs::CObservation2DRangeScan scan;
	CPose3D pose;
};

std::vector<Step> drive()
{
	std::vector<Step> all;
	for (std::size_t i = 0; i < scanCount; i++)
	{
		const double x = -1 + 0.3 * double(i), y = 0.2 * std::sin(double(i)), phi = 0.1 * double(i);
		all.push_back({scanOfRoom(x, y, phi, 361), CPose3D(x, y, 0, phi, 0, 0)});
	}
	return all;
}

CRidgeMap2D emptyMap()
{
	CRidgeMap2D map;
	map.insertionOptions.keepScans = 5;
	return map;
}

/** What a map answers; equal maps give equal answers. */
struct Answers
{
	std::vector<double> numbers;
	std::vector<std::uint8_t> bytes;
	std::vector<Polyline> walls, ridges;
};

/** Asks in an order that differs from thread to thread, so that each kind of query is the first one of some thread. */
Answers ask(const CRidgeMap2D& map, const Step& at, const mrpt::maps::CSimplePointsMap& points, int first)
{
	constexpr int kinds = 10;
	Answers a;
	a.numbers.resize(kinds);
	for (int i = 0; i < kinds; i++)
	{
		const int kind = (first + i) % kinds;
		double& number = a.numbers[std::size_t(kind)];
		if (kind == 0) a.walls = map.walls();
		if (kind == 1) a.ridges = map.ridges();
		if (kind == 2) number = map.nearestWallPoint({1, 1}).value_or(NearestPoint()).distance;
		if (kind == 3) number = map.computeObservationLikelihood(at.scan, at.pose);
		if (kind == 4) number = map.core().occupancy({2.99, 0.1}).value;
		if (kind == 5) number = double(map.core().space({0.3, 0.2}).state) + map.core().passes({0.5, 0.5});
		if (kind == 6) a.bytes = bytesOf(map);
		if (kind == 7) number = double(map.getAsSimplePointsMap()->size()) + map.boundingBox().max.x;
		if (kind == 8)
		{
			mrpt::tfest::TMatchingPairList pairs;
			mrpt::maps::TMatchingExtraResults result;
			mrpt::maps::TMatchingParams parameters;
			parameters.maxDistForCorrespondence = 0.5;
			map.determineMatching2D(&points, CPose2D(0.01, 0.02, 0.01), pairs, parameters, result);
			number = double(pairs.size());
		}
		if (kind == 9)
		{
			CRidgeMap2D copy = map;
			copy.insertMeasurements({{0.1, 0.1}});  // the copy is this thread's own
			number = double(copy.core().statistics().measurements);
		}
	}
	return a;
}

bool same(const Answers& a, const Answers& b)
{
	return a.numbers == b.numbers && a.bytes == b.bytes && samePolylines(a.walls, b.walls) &&
		   samePolylines(a.ridges, b.ridges);
}

mrpt::maps::CSimplePointsMap pointsOf(const Step& step)
{
	mrpt::maps::CSimplePointsMap points;
	points.insertObservation(step.scan, step.pose);
	return points;
}

/** Answers after 0, 1, ... scans, of maps that only this thread knows. */
std::vector<Answers> expectedAnswers(const std::vector<Step>& steps)
{
	std::vector<Answers> all;
	const auto points = pointsOf(steps[0]);
	CRidgeMap2D map = emptyMap();
	for (std::size_t n = 0; n <= steps.size(); n++)
	{
		if (n > 0) map.insertObservation(steps[n - 1].scan, steps[n - 1].pose);
		all.push_back(ask(map, steps[0], points, 0));
	}
	return all;
}

/** Calls a function in several threads, with the number of the thread, while this one does something else. */
template <class Read, class Write>
void together(const Read& read, const Write& write)
{
	std::vector<std::thread> threads;
	for (int t = 0; t < readerCount; t++) threads.emplace_back([&read, t] { read(t); });
	write();
	for (std::thread& thread : threads) thread.join();
}

template <class Read>
void together(const Read& read)
{
	together(read, [] {});
}
}  // namespace

TEST(Threads, QueriesOfCopiesWhileTheMapGrows)
{
	const auto steps = drive();
	const auto expected = expectedAnswers(steps);
	CRidgeMap2D map = emptyMap(), published = map;
	std::size_t publishedScans = 0;
	std::mutex mutex;
	std::atomic<int> wrong{0}, asked{0};
	const auto readToTheEnd = [&](int reader)
	{
		for (std::size_t scans = 0, turn = std::size_t(reader); scans < scanCount; turn++)
		{
			std::unique_lock<std::mutex> lock(mutex);
			const CRidgeMap2D copy = published;
			scans = publishedScans;
			lock.unlock();
			wrong += !same(ask(copy, steps[0], pointsOf(steps[0]), int(turn)), expected[scans]);
			asked++;
		}
	};
	together(readToTheEnd,
			 [&]
			 {
				 for (std::size_t n = 1; n <= scanCount; n++)
				 {
					 map.insertObservation(steps[n - 1].scan, steps[n - 1].pose);
					 if (n % 3 == 0) map.update(2);
					 const std::lock_guard<std::mutex> lock(mutex);
					 published = map;
					 publishedScans = n;
				 }
			 });
	EXPECT_EQ(wrong, 0) << "of " << asked;
	EXPECT_GE(asked, readerCount);
}

TEST(Threads, QueriesOfOneMapBetweenInsertions)
{
	const auto steps = drive();
	const auto expected = expectedAnswers(steps);
	CRidgeMap2D map = emptyMap();
	map.setThreads(2);
	for (std::size_t n = 0; n <= scanCount; n++)
	{
		if (n > 0) map.insertObservation(steps[n - 1].scan, steps[n - 1].pose);
		std::atomic<int> wrong{0};
		together([&](int reader)
				 { wrong += !same(ask(map, steps[0], pointsOf(steps[0]), 3 * reader + int(n)), expected[n]); });
		ASSERT_EQ(wrong, 0) << n << " scans";
	}
}

TEST(Threads, QueriesOfOneFrozenMap)
{
	const auto steps = drive();
	CRidgeMap2D map;
	for (const Step& s : steps) map.insertObservation(s.scan, s.pose);
	map.freeze();
	const double likelihood = CRidgeMap2D(map).computeObservationLikelihood(steps[0].scan, steps[0].pose);
	const auto bytes = bytesOf(map);
	CRidgeMap2D fresh;
	readInto(fresh, bytes);
	std::atomic<int> wrong{0};
	together(
		[&](int)
		{
			wrong += fresh.computeObservationLikelihood(steps[0].scan, steps[0].pose) != likelihood;
			wrong += bytesOf(fresh) != bytes;
			wrong += !fresh.nearestWallPoint({1, 1}).has_value();
		});
	EXPECT_EQ(wrong, 0);
}
