// SPDX-License-Identifier: BSD-3-Clause
// A map and a list of what is in it go through the same random changes; at the end and on the way, the map must be the
// one that is made from the list at once: equal sums, equal polylines, to the bit.
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "fuzz_target.h"

namespace ridgemap::fuzz
{
namespace
{
struct Model
{
	std::vector<Measurement> measurements;
	std::vector<FreeRay> rays;

	RidgeMap rebuilt() const
	{
		RidgeMap map;
		map.insert(measurements);
		map.insertFreeRays(rays);
		return map;
	}
};

bool sameCells(const std::vector<CellRecord>& a, const std::vector<CellRecord>& b)
{
	return std::equal(a.begin(), a.end(), b.begin(), b.end(),
					  [](const CellRecord& x, const CellRecord& y)
					  {
						  return x.cx == y.cx && x.cy == y.cy && x.bin == y.bin && x.n == y.n && x.sx == y.sx &&
								 x.sy == y.sy && x.sxx == y.sxx && x.sxy == y.sxy && x.syy == y.syy;
					  });
}

bool sameLines(const std::vector<Polyline>& a, const std::vector<Polyline>& b)
{
	return std::equal(a.begin(), a.end(), b.begin(), b.end(),
					  [](const Polyline& x, const Polyline& y)
					  { return x.points == y.points && x.info == y.info && x.closed == y.closed; });
}

void compare(const RidgeMap& map, const Model& model)
{
	const RidgeMap fresh = model.rebuilt();
	require(sameCells(map.cells(), fresh.cells()), "sums are those of the rebuilt map");
	require(map.freeCells() == fresh.freeCells(), "counters of rays are those of the rebuilt map");
	require(map.empty() == fresh.empty() && (!model.measurements.empty() || map.cells().empty()), "empty is empty");
	for (const FreeCellRecord& c : map.freeCells())
		require(c.n > 0 && std::abs(double(c.a)) <= 128.0 * double(c.n), "no counter is negative");
	for (const CellRecord& c : map.cells()) require(c.n > 0 && c.sxx >= 0 && c.syy >= 0, "no sum is negative");
	require(sameLines(map.ridges(), fresh.ridges()), "ridges are those of the rebuilt map");
	require(sameLines(map.walls(), fresh.walls()), "walls are those of the rebuilt map");
}

/** Some geometry: a stretch of wall, a blob or single points, on a coarse grid so that places coincide. */
std::vector<Measurement> someMeasurements(Input& in)
{
	std::vector<Measurement> all;
	const double x = 0.05 * (in.byte() - 128), y = 0.05 * (in.byte() - 128), angle = 0.1 * in.byte();
	const bool seen = in.byte() % 2 == 0;
	std::mt19937 random(in.byte());
	for (int i = in.byte() % 64; i >= 0; i--)
	{
		Measurement m;
		m.x = x + 0.01 * i * std::cos(angle) + 0.001 * double(random() % 32);
		m.y = y + 0.01 * i * std::sin(angle) + 0.001 * double(random() % 32);
		if (seen) m.sensorX = 0.5, m.sensorY = -0.25;
		all.push_back(m);
	}
	return all;
}

/** Takes a random stretch out of a list. */
template <class T>
std::vector<T> takeSome(std::vector<T>& from, Input& in)
{
	if (from.empty()) return {};
	const std::size_t a = in.word() % from.size(), n = std::min<std::size_t>(1 + in.byte(), from.size() - a);
	const std::vector<T> out(from.begin() + long(a), from.begin() + long(a + n));
	from.erase(from.begin() + long(a), from.begin() + long(a + n));
	return out;
}

void eraseWhatIsNotThere(RidgeMap& map)
{
	const auto cells = map.cells();
	try
	{
		map.erase({{777, 777}});
		require(false, "what is not there cannot be erased");
	}
	catch (const std::invalid_argument&)
	{
		require(sameCells(map.cells(), cells), "an error leaves the sums as they were");
	}
}

void step(RidgeMap& map, Model& model, Input& in)
{
	switch (in.byte() % 10)
	{
		case 0:
		case 1:
		{
			const auto all = someMeasurements(in);
			map.insert(all);
			model.measurements.insert(model.measurements.end(), all.begin(), all.end());
			break;
		}
		case 2:
			map.erase(takeSome(model.measurements, in));
			break;
		case 3:
		{
			RidgeMap other;
			const auto all = someMeasurements(in);
			other.insert(all);
			if (in.byte() % 2 == 0) other.update();
			map.merge(other);
			model.measurements.insert(model.measurements.end(), all.begin(), all.end());
			break;
		}
		case 4:
		{
			RidgeMap other;
			other.insert(takeSome(model.measurements, in));
			map.subtract(other);
			break;
		}
		case 5:
		{
			const FreeRay ray{0.01 * in.byte(), 0.01 * in.byte(), 0.1 * in.byte() - 12, 0.1 * in.byte() - 12};
			map.insertFreeRays({ray});
			model.rays.push_back(ray);
			break;
		}
		case 6:
			map.eraseFreeRays(takeSome(model.rays, in));
			break;
		case 7:
		{
			// What is stored of a map, and a map made of it.
			RidgeMap stored;
			stored.insertCells(map.cells());
			stored.insertFreeCells(map.freeCells());
			if (in.byte() % 2 == 0)
				map = stored;
			else
				map = RidgeMap(map);
			break;
		}
		case 8:
			map.update(1 + in.byte() % 3);
			map.walls();
			break;
		default:
			eraseWhatIsNotThere(map);
			map.space({0.1, 0.2});
			map.occupancy({0.3, 0.4});
	}
}
}  // namespace

std::vector<std::vector<std::uint8_t>> seeds()
{
	std::vector<std::vector<std::uint8_t>> all;
	for (unsigned seed = 0; seed < 20; seed++)
	{
		std::mt19937 random(seed);
		all.emplace_back();
		for (int i = 0; i < 200; i++) all.back().push_back(std::uint8_t(random()));
	}
	return all;
}
}  // namespace ridgemap::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
	using namespace ridgemap;
	fuzz::Input in(data, std::min<std::size_t>(size, 600));
	RidgeMap map;
	fuzz::Model model;
	for (int steps = 1; !in.empty(); steps++)
	{
		fuzz::step(map, model, in);
		if (steps % 16 == 0) fuzz::compare(map, model);
	}
	fuzz::compare(map, model);
	map.erase(model.measurements);
	map.eraseFreeRays(model.rays);
	fuzz::require(map.empty() && map.cells().empty() && map.freeCells().empty() && map.ridges().empty(),
				  "what was inserted and erased leaves nothing");
	return 0;
}
