// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/ridge_map.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "query_cache.h"
#include "scan_window.h"

namespace ridgemap
{
/** A map as archives hold it. */
struct StoredMap
{
	std::uint8_t version = 0;
	std::vector<std::uint8_t> bytes;

	bool operator==(const StoredMap& o) const { return version == o.version && bytes == o.bytes; }
};

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
	std::shared_ptr<const StoredMap> stored;  ///< what it was last written as, since it changed; see rememberState()
};

/** The state, for a change by the only map that holds it: copied first if others do. */
MapState& own(std::shared_ptr<MapState>& state);

/** CMultiMetricMap copies maps by serializing them. So that such a copy shares its state with the original, too, a
 * state remembers what it was written as as long as it lives and does not change.
 * @param key anything that tells most contents apart. */
void rememberState(std::uint64_t key, const std::shared_ptr<MapState>& state, std::shared_ptr<const StoredMap> stored);

/** What the state was last written as, or null. */
std::shared_ptr<const StoredMap> storedAs(const std::shared_ptr<MapState>& state);

/** A living state that was written as exactly this, or null. */
std::shared_ptr<MapState> findState(std::uint64_t key, const StoredMap& stored);

}  // namespace ridgemap
