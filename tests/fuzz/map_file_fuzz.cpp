// SPDX-License-Identifier: BSD-3-Clause
// Stored maps: the first byte chooses version and whether size and checksum are made to fit.
#include "../mrpt/damage.h"
#include "../mrpt/scenes.h"
#include "fuzz_target.h"

using namespace ridgemap;
using namespace ridgemap::test;

namespace ridgemap::fuzz
{
std::vector<Bytes> seeds()
{
	std::vector<Bytes> all;
	const auto add = [&](const CRidgeMap2D& map)
	{
		const StoredMap stored = StoredMap::open(bytesOf(map));
		all.push_back({stored.version});
		all.back().insert(all.back().end(), stored.content.begin(), stored.content.end());
	};
	CRidgeMap2D map;
	add(map);
	map.insertMeasurements(room(1.5, 1, 4));
	add(map);
	map.insertFreeRays({{0, 0, 1, 1}, {0.1, 0.2, -3, 1}});
	add(map);
	map.insertionOptions.keepScans = 2;
	map.insertScan({1, {{1, 2}, {1.1, 2}}, {{0, 0, 1, 1}}});
	add(map);
	CRidgeMap2D frozen;
	frozen.insertMeasurements(room(1.5, 1, 200));
	frozen.freeze();
	add(frozen);
	return all;
}
}  // namespace ridgemap::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
	if (size == 0) return 0;
	Bytes bytes(data + 1, data + size);
	const bool isContent = data[0] < 0x80;
	if (isContent) bytes = StoredMap{std::uint8_t(data[0] % 4), bytes}.sealed();
	CRidgeMap2D map;
	map.insertMeasurements({{5, 5}});
	const Bytes before = bytesOf(map);
	try
	{
		readInto(map, bytes);
	}
	catch (const std::exception&)
	{
		fuzz::require(bytesOf(map) == before, "an error leaves the map as it was");
		return 0;
	}
	const Bytes stored = bytesOf(map);
	for (const Polyline& line : map.walls()) fuzz::require(line.points.size() >= 2, "walls are lines");
	CRidgeMap2D copy;
	readInto(copy, stored);
	fuzz::require(bytesOf(copy) == stored, "what was read is stored and read alike");
	return 0;
}
