// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/ridge_map.h>

#include <array>
#include <vector>

#include "free_ray.h"
#include "free_tile.h"

namespace ridgemap
{
/** Counts the rays through cells of 2 sigma, in the frame of the measurement lattice: a pure function of the multiset
 * of rays. Const functions may be called from several threads at once. */
class FreeSpace
{
 public:
	explicit FreeSpace(const Options& options);

	const Frame& frame() const { return frame_; }

	/** Rays of measurements; O(cells crossed). Throws std::invalid_argument, with the counters as before, for sensors
	 * beyond +-1e6 m and when rays are taken out that were not put in, as far as the sums can tell. */
	void insert(const std::vector<Measurement>& m) { change(raysOf(m), +1); }
	void erase(const std::vector<Measurement>& m) { change(raysOf(m), -1); }
	void insert(const std::vector<FreeRay>& r) { change(raysOf(r), +1); }
	void erase(const std::vector<FreeRay>& r) { change(raysOf(r), -1); }
	/** Throws std::overflow_error if a cell would exceed maxPassesPerCell. */
	void merge(const FreeSpace& o) { change(o.cells(), +1); }
	void subtract(const FreeSpace& o) { change(o.cells(), -1); }
	void insertCells(const std::vector<FreeCellRecord>& cells);
	void clear() { tiles_.clear(); }

	bool empty() const { return tiles_.empty(); }
	/** All cells that rays passed, canonical order: row by row. */
	std::vector<FreeCellRecord> cells() const;
	std::size_t cellCount() const;
	std::size_t memoryBytes() const;

	PassSums at(std::int64_t cx, std::int64_t cy) const;
	/** The sums at a point of the lattice frame [sigma], bilinear between the centres of four cells. */
	std::array<double, 3> interpolated(Vec2 p) const;

 private:
	std::vector<LatticeRay> raysOf(const std::vector<Measurement>& m) const;
	std::vector<LatticeRay> raysOf(const std::vector<FreeRay>& r) const;
	void change(const std::vector<LatticeRay>& rays, int sign);
	void change(const std::vector<FreeCellRecord>& cells, int sign);
	std::vector<TileKey> apply(const std::vector<LatticeRay>& rays, int sign);
	bool possible(const std::vector<TileKey>& tiles) const;
	void dropEmpty(const std::vector<TileKey>& tiles);

	Frame frame_;
	double margin_;
	bool counting_;
	CounterTiles tiles_;
};

}  // namespace ridgemap
