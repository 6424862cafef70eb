// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/ridge_map.h>

#include <memory>

#include "query_cache.h"
#include "scan_window.h"

namespace ridgemap
{
/** What copies of a map share until one of them changes: the measurements with their polylines, and what queries have
 * built. MRPT's particle filters copy maps all the time, and tracing a large map anew takes as long as hundreds of
 * scans.
 *
 * Used through shared_ptr<MapState>. Const use by several maps in several threads is safe; before a change, own() makes
 * sure that nobody else sees it. */
struct MapState
{
	explicit MapState(const Options& options) : core(options) {}
	/** Copies the contents; what queries have built is left behind. */
	MapState(const MapState& o) : core(o.core), frozen(o.frozen), window(o.window) {}
	MapState& operator=(const MapState&) = delete;

	RidgeMap core;                                        ///< empty in a frozen map
	std::shared_ptr<const std::vector<Polyline>> frozen;  ///< the polylines of a frozen map; null: not frozen
	ScanWindow window;                                    ///< what a sliding window has to take out again
	QueryCache cache;
};

/** The state, for a change by the only map that holds it: copied first if others do. */
MapState& own(std::shared_ptr<MapState>& state);

/** CMultiMetricMap copies maps by serializing them. So that such a copy shares its state with the original, too,
 * archives remember where they came from as long as that map lives and does not change.
 * @param key anything that tells most contents apart; equality is checked cell by cell. */
void rememberState(std::uint64_t key, const std::shared_ptr<MapState>& state);

/** A living state with exactly these contents, or null. */
std::shared_ptr<MapState> findState(std::uint64_t key, const Options& options, const std::vector<CellRecord>& cells,
									const std::vector<FreeCellRecord>& freeCells, const ScanWindow& window);

/** A living frozen state with exactly these polylines, or null. */
std::shared_ptr<MapState> findFrozenState(std::uint64_t key, const Options& options,
										  const std::vector<Polyline>& lines);

}  // namespace ridgemap
