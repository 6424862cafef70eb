// SPDX-License-Identifier: BSD-3-Clause
#include "map_state.h"

#include <atomic>
#include <map>
#include <mutex>
#include <utility>

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
}  // namespace

MapState& own(std::shared_ptr<MapState>& state)
{
	bool shared;
	{
		// Once it is forgotten here, nobody can find the state any more: a count of one stays one.
		const std::lock_guard<std::mutex> lock(registry().mutex);
		forget(registry(), state.get());
		if (state.use_count() == 1) state->stored.reset();
		shared = state.use_count() > 1;
	}
	// Pairs with the release of the last other holder, whose queries may have built polylines.
	std::atomic_thread_fence(std::memory_order_acquire);
	if (shared) state = std::make_shared<MapState>(*state);
	return *state;
}

void rememberState(std::uint64_t key, const std::shared_ptr<MapState>& state, std::shared_ptr<const StoredMap> stored)
{
	const std::lock_guard<std::mutex> lock(registry().mutex);
	forget(registry(), state.get());
	registry().states[key] = state;
	state->stored = std::move(stored);
}

std::shared_ptr<const StoredMap> storedAs(const std::shared_ptr<MapState>& state)
{
	const std::lock_guard<std::mutex> lock(registry().mutex);
	return state->stored;
}

std::shared_ptr<MapState> findState(std::uint64_t key, const StoredMap& stored)
{
	const std::lock_guard<std::mutex> lock(registry().mutex);
	const auto it = registry().states.find(key);
	auto found = it != registry().states.end() ? it->second.lock() : nullptr;
	return found && found->stored && *found->stored == stored ? found : nullptr;
}

}  // namespace ridgemap
