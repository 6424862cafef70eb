// SPDX-License-Identifier: BSD-3-Clause
#include "free_space.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "ray_counter.h"

namespace ridgemap
{
namespace
{
constexpr const char* notHeld =
	"ridge map: the map does not hold all rays that are to be taken out; give the sensor positions as they were "
	"inserted. It was left as it was";

/** Sums that some number of rays can have: each adds a vector of length 128, rounded. */
bool isPossible(const PassSums& s)
{
	if (s.n < 0 || s.n > std::int64_t(maxPassesPerCell)) return false;
	const double most = (LatticeRay::directionScale + 1.0) * double(s.n);
	const double a = double(s.a), b = double(s.b);
	return a * a + b * b <= most * most;
}
}  // namespace

FreeSpace::FreeSpace(const Options& options)
	: frame_(options.sigma), margin_(options.freeSpaceMargin), counting_(options.freeSpace)
{
}

std::vector<LatticeRay> FreeSpace::raysOf(const std::vector<Measurement>& measurements) const
{
	std::vector<LatticeRay> rays;
	if (!counting_) return rays;
	rays.reserve(measurements.size());
	RayMaker maker(frame_, margin_);
	for (const Measurement& m : measurements)
		if (const auto ray = maker.make({m.sensorX, m.sensorY, m.x, m.y})) rays.push_back(*ray);
	return rays;
}

std::vector<LatticeRay> FreeSpace::raysOf(const std::vector<FreeRay>& free) const
{
	std::vector<LatticeRay> rays;
	if (!counting_) return rays;
	rays.reserve(free.size());
	RayMaker maker(frame_, 0);
	for (const FreeRay& r : free)
		if (const auto ray = maker.make(r)) rays.push_back(*ray);
	return rays;
}

std::vector<TileKey> FreeSpace::apply(const std::vector<LatticeRay>& rays, int sign)
{
	RayCounter counter(tiles_);
	counter.count(rays, sign);
	return counter.touched();
}

bool FreeSpace::possible(const std::vector<TileKey>& keys) const
{
	for (const TileKey& key : keys)
	{
		const CounterTile& t = *tiles_.at(key);
		for (std::size_t i = 0; i < CounterTile::cells; i++)
			if (!isPossible(t.sums(i))) return false;
	}
	return true;
}

void FreeSpace::dropEmpty(const std::vector<TileKey>& keys)
{
	for (const TileKey& key : keys)
		if (tiles_.at(key)->used() == 0) tiles_.erase(key);
}

void FreeSpace::change(const std::vector<LatticeRay>& rays, int sign)
{
	std::vector<TileKey> touched = apply(rays, sign);
	if (sign > 0) return;
	std::sort(touched.begin(), touched.end());
	touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
	const bool held = possible(touched);
	if (!held) apply(rays, -sign);
	dropEmpty(touched);
	if (!held) throw std::invalid_argument(notHeld);
}

void FreeSpace::change(const std::vector<FreeCellRecord>& cells, int sign)
{
	for (const FreeCellRecord& c : cells)
	{
		const PassSums s = at(c.cx, c.cy);
		const PassSums after{s.n + sign * std::int64_t(c.n), s.a + sign * c.a, s.b + sign * c.b};
		if (isPossible(after)) continue;
		if (sign < 0) throw std::invalid_argument(notHeld);
		throw std::overflow_error("ridge map: more than 2^48 rays through one cell; nothing was added");
	}
	std::vector<TileKey> touched;
	for (const FreeCellRecord& c : cells)
	{
		const TileKey key = CounterTile::keyOf(c.cx, c.cy);
		CounterTile& t = tileAt(tiles_, key);
		const std::size_t i = CounterTile::slot(c.cx, c.cy);
		const PassSums s = t.sums(i);
		t.set(i, {s.n + sign * std::int64_t(c.n), s.a + sign * c.a, s.b + sign * c.b});
		if (sign < 0 && (touched.empty() || touched.back() != key)) touched.push_back(key);
	}
	std::sort(touched.begin(), touched.end());
	touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
	dropEmpty(touched);
}

void FreeSpace::insertCells(const std::vector<FreeCellRecord>& cells)
{
	if (!counting_ && !cells.empty())
		throw std::invalid_argument("ridge map: stored free-space cells need a map with the option freeSpace");
	// Twice the largest coordinate leaves room for the rotation and the offset of the frame.
	const double largest = 2 * frame_.largestCoordinate() / double(LatticeRay::cellSigmas);
	for (std::size_t i = 0; i < cells.size(); i++)
	{
		const FreeCellRecord& c = cells[i];
		if (c.n == 0 || c.n > maxPassesPerCell || !isPossible({std::int64_t(c.n), c.a, c.b}))
			throw std::invalid_argument("ridge map: a stored free-space cell has impossible sums");
		if (std::abs(double(c.cx)) > largest || std::abs(double(c.cy)) > largest)
			throw std::invalid_argument("ridge map: a stored free-space cell lies beyond the largest coordinate");
		if (i > 0 && !(cells[i - 1].cy < c.cy || (cells[i - 1].cy == c.cy && cells[i - 1].cx < c.cx)))
			throw std::invalid_argument("ridge map: stored free-space cells are not in their order");
	}
	change(cells, +1);
}

std::vector<FreeCellRecord> FreeSpace::cells() const
{
	std::vector<TileKey> keys;
	for (const auto& entry : tiles_) keys.push_back(entry.first);
	std::sort(keys.begin(), keys.end());
	std::vector<FreeCellRecord> result;
	for (auto first = keys.begin(), last = first; first != keys.end(); first = last)
	{
		last = std::find_if(first, keys.end(), [&](TileKey k) { return k.y != first->y; });
		std::vector<const CounterTile*> row;
		for (auto k = first; k != last; ++k) row.push_back(tiles_.at(*k).get());
		for (std::int64_t y = 0; y < CounterTile::edge; y++)
			for (std::size_t i = 0; i < row.size(); i++)
				for (std::int64_t x = 0; x < CounterTile::edge; x++)
				{
					const PassSums s = row[i]->sums(CounterTile::slot(x, y));
					if (s.n == 0) continue;
					result.push_back({first[std::ptrdiff_t(i)].x * CounterTile::edge + x,
									  first->y * CounterTile::edge + y, std::uint64_t(s.n), s.a, s.b});
				}
	}
	return result;
}

std::size_t FreeSpace::cellCount() const
{
	std::size_t count = 0;
	for (const auto& entry : tiles_) count += entry.second->used();
	return count;
}

std::size_t FreeSpace::memoryBytes() const
{
	std::size_t bytes = 0;
	for (const auto& entry : tiles_) bytes += entry.second->memoryBytes();
	return bytes;
}

PassSums FreeSpace::at(std::int64_t cx, std::int64_t cy) const
{
	const auto found = tiles_.find(CounterTile::keyOf(cx, cy));
	return found == tiles_.end() ? PassSums{} : found->second->sums(CounterTile::slot(cx, cy));
}

std::array<double, 3> FreeSpace::interpolated(Vec2 p) const
{
	const double x = p.x / double(LatticeRay::cellSigmas) - 0.5, y = p.y / double(LatticeRay::cellSigmas) - 0.5;
	const double fx = std::floor(x), fy = std::floor(y), tx = x - fx, ty = y - fy;
	const std::int64_t cx = std::int64_t(fx), cy = std::int64_t(fy);
	const PassSums s00 = at(cx, cy), s10 = at(cx + 1, cy), s01 = at(cx, cy + 1), s11 = at(cx + 1, cy + 1);
	const auto mix = [&](std::int64_t v00, std::int64_t v10, std::int64_t v01, std::int64_t v11) {
		return (1 - ty) * ((1 - tx) * double(v00) + tx * double(v10)) +
			   ty * ((1 - tx) * double(v01) + tx * double(v11));
	};
	return {mix(s00.n, s10.n, s01.n, s11.n), mix(s00.a, s10.a, s01.a, s11.a), mix(s00.b, s10.b, s01.b, s11.b)};
}

}  // namespace ridgemap
