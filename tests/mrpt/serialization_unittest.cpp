// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "scenes.h"

using namespace ridgemap;
using namespace ridgemap::test;

namespace
{
CRidgeMap2D sampleMap()
{
	MapOptions o;
	o.creation.sigma = 0.06;
	o.insertion.maxRange = 33;
	o.likelihood.decimation = 3;
	o.render.showRidges = true;
	CRidgeMap2D map(o);
	map.genericMapParams.enableObservationLikelihood = false;
	map.insertMeasurements(room(1.5, 1));
	return map;
}
}  // namespace

TEST(Serialization, RoundTripKeepsContentAndBytes)
{
	const CRidgeMap2D map = sampleMap();
	ASSERT_FALSE(map.ridges().empty());
	const auto bytes = bytesOf(map);
	CRidgeMap2D copy;
	readInto(copy, bytes);
	EXPECT_TRUE(bytesOf(copy) == bytes);
	EXPECT_TRUE(copy.options() == map.options());
	for (const auto& key : MapOptions::keys())
		EXPECT_EQ(copy.mapOptions().getOption(key), map.mapOptions().getOption(key)) << key;
	EXPECT_FALSE(copy.genericMapParams.enableObservationLikelihood);
	EXPECT_TRUE(copy.genericMapParams.enableObservationInsertion);
	EXPECT_TRUE(samePolylines(copy.ridges(), map.ridges()));
	EXPECT_TRUE(samePolylines(copy.walls(), map.walls()));
}

TEST(Serialization, FreeSpaceIsKept)
{
	auto measurements = room(1.5, 1);
	for (std::size_t i = 0; i < measurements.size(); i++) measurements[i].sensorX = 0.1, measurements[i].sensorY = 0.2;
	std::vector<std::uint8_t> bytes, blind;
	std::vector<FreeCellRecord> cells;
	std::vector<Polyline> walls;
	{
		CRidgeMap2D map;
		map.insertMeasurements(measurements);
		map.insertFreeRays({{0.1, 0.2, 9, 0.3}, {0.1, 0.2, 0.3, 9}});
		bytes = bytesOf(map);
		cells = map.core().freeCells();
		walls = map.walls();
	}
	ASSERT_GT(cells.size(), 100u);
	CRidgeMap2D copy;
	readInto(copy, bytes);
	EXPECT_TRUE(copy.core().freeCells() == cells);
	EXPECT_TRUE(samePolylines(copy.walls(), walls));
	EXPECT_TRUE(bytesOf(copy) == bytes);
	copy.eraseMeasurements(measurements);
	copy.eraseFreeRays({{0.1, 0.2, 9, 0.3}, {0.1, 0.2, 0.3, 9}});
	EXPECT_TRUE(copy.isEmpty());
	EXPECT_TRUE(bytesOf(copy) == bytesOf(CRidgeMap2D()));
}

TEST(Serialization, EqualMapsGiveEqualBytes)
{
	auto measurements = room(1.5, 1);
	CRidgeMap2D a, b;
	a.insertMeasurements(measurements);
	a.ridges();  // what queries have built must not show
	a.getAsSimplePointsMap();
	std::shuffle(measurements.begin(), measurements.end(), std::mt19937(5));
	for (std::size_t i = 0; i < measurements.size(); i += 97)
		b.insertMeasurements(
			{measurements.begin() + long(i), measurements.begin() + long(std::min(i + 97, measurements.size()))});
	EXPECT_TRUE(bytesOf(a) == bytesOf(b));
	EXPECT_TRUE(samePolylines(a.ridges(), b.ridges()));
}

TEST(Serialization, WhatWasWrittenBeforeIsNotWrittenAgain)
{
	const auto all = room(1.5, 1);
	const std::vector<Measurement> some(all.begin(), all.begin() + 100);
	CRidgeMap2D map;
	const auto fresh = [&](const std::vector<Measurement>& measurements)
	{
		CRidgeMap2D other(map.mapOptions());
		other.genericMapParams = map.genericMapParams;
		if (!measurements.empty()) other.insertMeasurements(measurements);
		return bytesOf(other);
	};
	EXPECT_TRUE(bytesOf(map) == fresh({}));
	map.insertMeasurements(all);
	EXPECT_TRUE(bytesOf(map) == fresh(all));
	EXPECT_TRUE(bytesOf(map) == fresh(all));
	map.likelihoodOptions.decimation = 7;
	EXPECT_TRUE(bytesOf(map) == fresh(all));
	map.genericMapParams.enableObservationInsertion = false;
	EXPECT_TRUE(bytesOf(map) == fresh(all));
	const CRidgeMap2D copy = map;
	map.eraseMeasurements(some);
	EXPECT_TRUE(bytesOf(map) == fresh({all.begin() + 100, all.end()}));
	EXPECT_TRUE(bytesOf(copy) == fresh(all));
	map.insertMeasurements(some);
	EXPECT_TRUE(bytesOf(map) == fresh(all));
	map.insertFreeRays({{0.1, 0.2, 9, 0.3}});
	EXPECT_FALSE(bytesOf(map) == fresh(all));
	map.clear();
	EXPECT_TRUE(bytesOf(map) == fresh({}));
	map.freeze();
	EXPECT_FALSE(bytesOf(map) == fresh({}));
}

TEST(Serialization, EmptyMap)
{
	CRidgeMap2D map = sampleMap();
	readInto(map, bytesOf(CRidgeMap2D()));
	EXPECT_TRUE(map.isEmpty());
	EXPECT_TRUE(map.walls().empty());
	EXPECT_EQ(map.options().sigma, Options().sigma);
}

TEST(Serialization, TruncationAtEveryLengthThrowsAndChangesNothing)
{
	CRidgeMap2D small;
	small.insertMeasurements({{1, 2}, {1.01, 2.3}, {-4, 1e3}});
	const auto bytes = bytesOf(small);
	CRidgeMap2D target = sampleMap();
	const auto before = bytesOf(target);
	for (std::size_t n = 0; n < bytes.size(); n++)
	{
		EXPECT_ANY_THROW(readInto(target, {bytes.begin(), bytes.begin() + long(n)})) << n << " of " << bytes.size();
		// MRPT reads its closing byte only after the object is done: there the content is complete.
		if (n + 1 == bytes.size()) break;
		ASSERT_TRUE(bytesOf(target) == before) << n;
	}
}

TEST(Serialization, FlippedBitsAreNoticed)
{
	const auto large = bytesOf(sampleMap());
	CRidgeMap2D map;
	map.insertMeasurements({{1, 2}, {1.01, 2.3}});
	const auto small = bytesOf(map);
	CRidgeMap2D target;
	target.insertMeasurements({{5, 5}});
	const auto before = bytesOf(target);
	// MRPT itself writes one byte before and one behind the content, and the name of the class, which it does not
	// compare: a flip there may pass, but then the content is whole.
	const std::size_t header = 2 + std::string("ridgemap::CRidgeMap2D").size();
	const auto expectNoticed = [&](std::vector<std::uint8_t> damaged, std::size_t bit)
	{
		const auto original = damaged;
		damaged[bit / 8] ^= std::uint8_t(1u << (bit % 8));
		bool thrown = false;
		try
		{
			readInto(target, damaged);
		}
		catch (const std::exception&)
		{
			thrown = true;
		}
		const bool ofMrpt = bit / 8 < header || bit / 8 + 1 == damaged.size();
		ASSERT_TRUE(thrown || ofMrpt) << "bit " << bit;
		const auto after = bytesOf(target);
		ASSERT_TRUE(after == before || (ofMrpt && after == original)) << "bit " << bit;
		readInto(target, before);
	};
	for (std::size_t bit = 0; bit < 8 * small.size(); bit++) expectNoticed(small, bit);
	std::mt19937 random(3);
	for (int i = 0; i < 500; i++) expectNoticed(large, random() % (8 * large.size()));
}

TEST(Serialization, ForgedSizeTakesNoMemory)
{
	auto bytes = bytesOf(CRidgeMap2D());
	// The size follows the header of MRPT: length, class name, version.
	const std::size_t at = bytes.size() - 1 - 4;
	std::size_t header = 0;
	for (std::size_t i = 0; i + 8 < at; i++)
	{
		std::uint64_t v = 0;
		for (std::size_t k = 0; k < 8; k++) v |= std::uint64_t(bytes[i + k]) << (8 * k);
		if (v == at - i - 8) header = i;
	}
	ASSERT_GT(header, 0u);
	for (std::size_t k = 0; k < 8; k++) bytes[header + k] = 0x7f;
	CRidgeMap2D target;
	EXPECT_ANY_THROW(readInto(target, bytes));
}

TEST(Serialization, NewerVersionIsRefused)
{
	auto bytes = bytesOf(CRidgeMap2D());
	const std::string name = "CRidgeMap2D";
	auto at = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
	ASSERT_NE(at, bytes.end());
	at[long(name.size())] = 99;
	CRidgeMap2D target;
	try
	{
		readInto(target, bytes);
		FAIL() << "version 99 was read";
	}
	catch (const std::exception& e)
	{
		EXPECT_NE(std::string(e.what()).find("99"), std::string::npos) << e.what();
	}
}

TEST(Serialization, ByClassName)
{
	const CRidgeMap2D map = sampleMap();
	const auto bytes = bytesOf(map);
	mrpt::io::CMemoryStream stream;
	stream.assignMemoryNotOwn(bytes.data(), bytes.size());
	auto archive = mrpt::serialization::archiveFrom(stream);
	const auto object = std::dynamic_pointer_cast<CRidgeMap2D>(archive.ReadObject());
	ASSERT_TRUE(object);
	EXPECT_TRUE(bytesOf(*object) == bytes);
}

TEST(Serialization, Files)
{
	const auto folder = std::filesystem::temp_directory_path() / ("ridgemap_files_" + std::to_string(::getpid()));
	std::filesystem::create_directories(folder);
	const std::string path = (folder / "a.ridgemap").string();
	const CRidgeMap2D map = sampleMap();
	saveRidgeMap(path, map);
	EXPECT_TRUE(bytesOf(loadRidgeMap(path)) == bytesOf(map));
	const auto message = [](const std::string& p)
	{
		try
		{
			loadRidgeMap(p);
		}
		catch (const std::exception& e)
		{
			return std::string(e.what());
		}
		return std::string();
	};
	EXPECT_NE(message((folder / "none").string()).find("none"), std::string::npos);
	std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
	EXPECT_NE(message(path).find("a.ridgemap"), std::string::npos);
	std::ofstream(path) << "no archive at all, just some text that is longer than the header";
	EXPECT_NE(message(path).find("a.ridgemap"), std::string::npos);
	EXPECT_EQ(message(path).find('\n'), std::string::npos);
	std::ofstream(path, std::ios::trunc);
	EXPECT_FALSE(message(path).empty());
	EXPECT_ANY_THROW(saveRidgeMap((folder / "no" / "b").string(), map));
	std::filesystem::remove_all(folder);
}
