// SPDX-License-Identifier: BSD-3-Clause
// Stored maps with flipped bits, cut short, forged, or of other versions: an error or the whole map, never anything
// else, and never more memory than a small multiple of the data.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

#include "damage.h"
#include "memory_peak.h"
#include "stored_files.h"

using namespace ridgemap;
using namespace ridgemap::test;
namespace fs = std::filesystem;

namespace
{
CRidgeMap2D frozenRoom()
{
	CRidgeMap2D map = mapOfRoom();
	map.freeze();
	return map;
}

void write(const std::string& path, const Bytes& bytes)
{
	std::ofstream out(path, std::ios::binary | std::ios::trunc);
	out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

/** Memory for reading so many bytes. A cell of 24 bytes takes about 3 kB when it is alone in its tile; buffers of MRPT
 * and zlib come on top. */
std::size_t memoryBound(std::size_t bytes)
{
	return 200 * bytes + (std::size_t(3) << 20);
}

/** Reads into a map that holds something; true if it was taken. A map that refuses must stay as it was. */
bool take(const Bytes& bytes, CRidgeMap2D& target, const Bytes& before)
{
	try
	{
		readInto(target, bytes);
		return true;
	}
	catch (const std::exception&)
	{
		EXPECT_TRUE(bytesOf(target) == before) << "an error changed the map";
		return false;
	}
}

}  // namespace

TEST(DamagedFile, EveryFlippedBitIsNoticedOrHarmless)
{
	const Folder folder;
	const CRidgeMap2D map = mapOfRoom(40);
	const Bytes content = bytesOf(map);
	saveRidgeMap(folder / "a.ridgemap", map);
	const Bytes whole = contentOf(folder / "a.ridgemap");
	const int flips = repetitions("RIDGEMAP_FLIPS", 10000);
	const unsigned seed = unsigned(repetitions("RIDGEMAP_SEED", 1));
	std::mt19937 random(seed);
	int harmless = 0;
	for (int i = 0; i < flips; i++)
	{
		Bytes damaged = whole;
		const std::size_t bit = random() % (8 * whole.size());
		damaged[bit / 8] ^= std::uint8_t(1u << (bit % 8));
		write(folder / "b.ridgemap", damaged);
		const auto got = loaded(folder / "b.ridgemap");
		ASSERT_TRUE(!got || *got == content) << "bit " << bit << ", seed " << seed;
		harmless += got ? 1 : 0;
	}
	// Only the time stamp and such in the ten bytes of zlib's header, and what stands behind the map, may differ.
	EXPECT_LT(harmless, std::max(20, int(200.0 * flips / double(whole.size()))));
	std::printf("%d flips in %zu bytes: %d noticed, %d harmless, seed %u\n", flips, whole.size(), flips - harmless,
				harmless, seed);
}

TEST(DamagedFile, EveryFlippedBitOfTheContentIsNoticed)
{
	for (const CRidgeMap2D& map : {mapOfRoom(), frozenRoom()})
	{
		const Bytes whole = bytesOf(map);
		CRidgeMap2D target;
		target.insertMeasurements({{5, 5}});
		const Bytes before = bytesOf(target);
		const int flips = repetitions("RIDGEMAP_FLIPS", 10000);
		const unsigned seed = unsigned(repetitions("RIDGEMAP_SEED", 1));
		std::mt19937 random(seed);
		for (int i = 0; i < flips; i++)
		{
			Bytes damaged = whole;
			// From the version on: what stands before is of MRPT, as is the closing byte.
			const std::size_t first = 8 * (StoredMap::headerSize() - 1), last = 8 * (whole.size() - 1);
			const std::size_t bit = first + random() % (last - first);
			damaged[bit / 8] ^= std::uint8_t(1u << (bit % 8));
			ASSERT_FALSE(take(damaged, target, before)) << "bit " << bit << ", seed " << seed;
		}
	}
}

TEST(DamagedFile, TruncationAtEveryByteIsNoticedOrHarmless)
{
	const Folder folder;
	const CRidgeMap2D map = mapOfRoom(8);
	const Bytes content = bytesOf(map);
	saveRidgeMap(folder / "a.ridgemap", map);
	const Bytes whole = contentOf(folder / "a.ridgemap");
	for (std::size_t n = 0; n < whole.size(); n++)
	{
		write(folder / "b.ridgemap", Bytes(whole.begin(), whole.begin() + long(n)));
		const auto got = loaded(folder / "b.ridgemap");
		ASSERT_TRUE(!got || *got == content) << n << " of " << whole.size();
		// zlib's trailer of eight bytes comes behind the map; MRPT's closing byte may be the last one compressed.
		ASSERT_TRUE(!got || n + 12 >= whole.size()) << n << " of " << whole.size();
	}
}

TEST(ForgedMap, SealedAnewIsTheSame)
{
	for (const CRidgeMap2D& map : {mapOfRoom(), frozenRoom(), CRidgeMap2D()})
		EXPECT_TRUE(StoredMap::open(bytesOf(map)).sealed() == bytesOf(map));
}

TEST(ForgedMap, HugeAndNegativeNumbersAnywhere)
{
	std::size_t tried = 0, taken = 0, worst = 0;
	for (const CRidgeMap2D& map : {mapOfRoom(4), []
								   {
									   CRidgeMap2D m = mapOfRoom(100);
									   m.freeze();
									   return m;
								   }()})
	{
		const StoredMap original = StoredMap::open(bytesOf(map));
		const Bytes numbers[] = {varint(0),          varint(1),          varint(0x7fffffff),
								 varint(0xffffffff), varint(1ull << 32), varint(1ull << 40),
								 varint(~0ull >> 1), varint(~0ull),      Bytes(11, 0xff)};
		CRidgeMap2D target;
		target.insertMeasurements({{5, 5}});
		const Bytes before = bytesOf(target);
		for (std::size_t at = 0; at < original.content.size(); at++)
			for (const Bytes& number : numbers)
			{
				// The number that starts here, if one does, is replaced.
				StoredMap forged = original;
				std::size_t end = at;
				while (end + 1 < forged.content.size() && (forged.content[end] & 0x80) != 0) end++;
				forged.content.erase(forged.content.begin() + long(at), forged.content.begin() + long(end + 1));
				forged.content.insert(forged.content.begin() + long(at), number.begin(), number.end());
				const Bytes bytes = forged.sealed();
				restartMemoryPeak();
				const bool isTaken = take(bytes, target, before);
				worst = std::max(worst, memoryPeak());
				ASSERT_LT(memoryPeak(), memoryBound(bytes.size())) << "byte " << at;
				tried++;
				if (!isTaken) continue;
				taken++;
				// What is taken is a map like any other.
				const Bytes stored = bytesOf(target);
				target.ridges();
				CRidgeMap2D copy;
				readInto(copy, stored);
				ASSERT_TRUE(bytesOf(copy) == stored) << "byte " << at;
				readInto(target, before);
			}
	}
	std::printf("%zu forgeries, %zu of them maps; at most %.2f MB held\n", tried, taken, double(worst) / 1048576);
}

TEST(ForgedMap, CountsThatTheDataJustAllow)
{
	// As many cells as could be in so many bytes, each as small as can be, but the contents are wrong or missing.
	for (const std::uint8_t version : {0, 1, 2})
		for (const std::size_t size : {100000u, 1000000u})
		{
			CRidgeMap2D target;
			StoredMap forged = StoredMap::open(bytesOf(target));
			forged.version = version;
			forged.content.pop_back();  // the count of no cells
			for (const std::uint8_t b : varint(size / 9)) forged.content.push_back(b);
			forged.content.resize(forged.content.size() + size, 2);
			const Bytes bytes = forged.sealed(), before = bytesOf(target);
			restartMemoryPeak();
			EXPECT_FALSE(take(bytes, target, before));
			EXPECT_LT(memoryPeak(), memoryBound(bytes.size())) << int(version);
		}
}

TEST(ForgedMap, CellsFarApartTakeNoMoreThanTheirShare)
{
	// The least bytes for a cell, and every one in a tile of its own.
	std::vector<Measurement> far;
	for (int i = 0; i < 3000; i++) far.push_back({double(i % 60) * 40 - 1000, double(i / 60) * 40 - 1000});
	CRidgeMap2D map;
	map.insertMeasurements(far);
	const Bytes bytes = bytesOf(map);
	restartMemoryPeak();
	map = CRidgeMap2D();  // else the copy shares with it
	CRidgeMap2D target;
	restartMemoryPeak();
	readInto(target, bytes);
	std::printf("%zu bytes take %.1f times as much\n", bytes.size(), double(memoryPeak()) / double(bytes.size()));
	EXPECT_LT(memoryPeak(), memoryBound(bytes.size()));
}

TEST(Versions, AllOthersAreRefusedByNumber)
{
	StoredMap stored = StoredMap::open(bytesOf(mapOfRoom()));
	CRidgeMap2D target;
	const Bytes before = bytesOf(target);
	for (int version = 0; version < 256; version++)
	{
		if (version == 2) continue;  // it is one
		stored.version = std::uint8_t(version);
		try
		{
			readInto(target, stored.sealed());
			FAIL() << "version " << version << " was read";
		}
		catch (const std::exception& e)
		{
			if (version > 2)
			{
				EXPECT_NE(std::string(e.what()).find("version " + std::to_string(version)), std::string::npos)
					<< e.what();
			}
		}
		EXPECT_TRUE(bytesOf(target) == before);
	}
}

TEST(Versions, OlderOnesAreRead)
{
	// Version 0, as it was before there was free space, and with fewer options.
	CRidgeMap2D plain;
	plain.insertMeasurements(room(1.5, 1));
	StoredMap stored = StoredMap::open(bytesOf(plain));
	EXPECT_EQ(stored.version, 0);
	const std::string name = "freeSpaceTau";
	const auto at = std::search(stored.content.begin(), stored.content.end(), name.begin(), name.end());
	ASSERT_NE(at, stored.content.end());
	const auto value = at + long(name.size());
	stored.content.erase(at - 1, value + 1 + *value);
	stored.content[3]--;  // the number of options comes behind the three flags of MRPT
	CRidgeMap2D copy;
	readInto(copy, stored.sealed());
	EXPECT_TRUE(bytesOf(copy) == bytesOf(plain));
}

TEST(Versions, OptionsOfNewerOnesAreAnErrorThatNamesThem)
{
	StoredMap stored = StoredMap::open(bytesOf(CRidgeMap2D()));
	const std::string name = "freeSpaceTau";
	const auto at = std::search(stored.content.begin(), stored.content.end(), name.begin(), name.end());
	ASSERT_NE(at, stored.content.end());
	at[0] = 'X';
	CRidgeMap2D target;
	try
	{
		readInto(target, stored.sealed());
		FAIL() << "an unknown option was read";
	}
	catch (const std::exception& e)
	{
		EXPECT_NE(std::string(e.what()).find("XreeSpaceTau"), std::string::npos) << e.what();
	}
}
