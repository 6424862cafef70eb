// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace ridgemap
{
/** Calls fn(i, thread) for i in [0, n) on up to `threads` threads, numbered from 0; fn must not depend on the order.
 * Rethrows the first exception after all threads have ended. */
template <class Fn>
void parallelFor(std::size_t n, unsigned threads, Fn fn)
{
	constexpr std::size_t leastPerThread = 8;  // starting a thread costs about as much as this many tiles
	const std::size_t useful = std::min<std::size_t>(threads, n / leastPerThread);
	if (useful <= 1)
	{
		for (std::size_t i = 0; i < n; i++) fn(i, std::size_t(0));
		return;
	}
	std::atomic<std::size_t> next{0};
	std::exception_ptr error;
	std::mutex errorMutex;
	const auto work = [&](std::size_t thread)
	{
		try
		{
			for (std::size_t i; (i = next.fetch_add(1)) < n;) fn(i, thread);
		}
		catch (...)
		{
			const std::lock_guard<std::mutex> lock(errorMutex);
			if (!error) error = std::current_exception();
			next = n;
		}
	};
	std::vector<std::thread> pool;
	for (std::size_t t = 1; t < useful; t++) pool.emplace_back(work, t);
	work(0);
	for (std::thread& t : pool) t.join();
	if (error) std::rethrow_exception(error);
}

}  // namespace ridgemap
