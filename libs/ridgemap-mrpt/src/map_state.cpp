// SPDX-License-Identifier: BSD-3-Clause
#include "map_state.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>

#include "frozen_polylines.h"

namespace ridgemap
{
namespace
{
struct Registry
{
	std::mutex mutex;
	std::map<std::uint64_t, std::weak_ptr<MapState>> states;
};

Registry& registry()
{
	static Registry* const all = new Registry;  // never destroyed: maps may outlive static objects
	return *all;
}

void forget(Registry& all, const MapState* state)
{
	for (auto it = all.states.begin(); it != all.states.end();)
	{
		const auto alive = it->second.lock();
		it = !alive || alive.get() == state ? all.states.erase(it) : std::next(it);
	}
}

bool sameCell(const CellRecord& a, const CellRecord& b)
{
	return a.cx == b.cx && a.cy == b.cy && a.bin == b.bin && a.n == b.n && a.sx == b.sx && a.sy == b.sy &&
		   a.sxx == b.sxx && a.sxy == b.sxy && a.syy == b.syy;
}
}  // namespace

MapState& own(std::shared_ptr<MapState>& state)
{
	bool shared;
	{
		// Once it is forgotten here, nobody can find the state any more: a count of one stays one.
		const std::lock_guard<std::mutex> lock(registry().mutex);
		forget(registry(), state.get());
		shared = state.use_count() > 1;
	}
	// Pairs with the release of the last other holder, whose queries may have built polylines.
	std::atomic_thread_fence(std::memory_order_acquire);
	if (shared) state = std::make_shared<MapState>(*state);
	return *state;
}

void rememberState(std::uint64_t key, const std::shared_ptr<MapState>& state)
{
	const std::lock_guard<std::mutex> lock(registry().mutex);
	forget(registry(), state.get());
	registry().states[key] = state;
}

namespace
{
std::shared_ptr<MapState> findByKey(std::uint64_t key, const Options& options)
{
	const std::lock_guard<std::mutex> lock(registry().mutex);
	const auto it = registry().states.find(key);
	auto found = it != registry().states.end() ? it->second.lock() : nullptr;
	return found && found->core.options() == options ? found : nullptr;
}
}  // namespace

std::shared_ptr<MapState> findFrozenState(std::uint64_t key, const Options& options, const std::vector<Polyline>& lines)
{
	auto found = findByKey(key, options);
	return found && found->frozen && samePolylines(*found->frozen, lines) ? found : nullptr;
}

std::shared_ptr<MapState> findState(std::uint64_t key, const Options& options, const std::vector<CellRecord>& cells,
									const std::vector<FreeCellRecord>& freeCells, const ScanWindow& window)
{
	auto found = findByKey(key, options);
	if (!found || found->frozen) return nullptr;
	const auto held = found->core.cells();
	if (held.size() != cells.size() || !std::equal(held.begin(), held.end(), cells.begin(), sameCell)) return nullptr;
	return found->core.freeCells() == freeCells && found->window == window ? found : nullptr;
}

}  // namespace ridgemap
