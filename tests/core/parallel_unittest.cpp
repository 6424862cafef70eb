// SPDX-License-Identifier: BSD-3-Clause
// The loop that updates run in several threads.
#include "parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace ridgemap::test
{
TEST(ParallelFor, CallsEveryIndexOnce)
{
	for (const unsigned threads : {1u, 2u, 5u})
		for (const std::size_t n : {0u, 1u, 15u, 16u, 1000u})
		{
			std::vector<std::atomic<int>> calls(n);
			std::atomic<std::size_t> greatestThread{0};
			parallelFor(n, threads,
						[&](std::size_t i, std::size_t thread)
						{
							calls[i]++;
							for (std::size_t g = greatestThread;
								 thread > g && !greatestThread.compare_exchange_weak(g, thread);)
							{
							}
						});
			for (const auto& c : calls) ASSERT_EQ(c, 1) << n << " with " << threads << " threads";
			EXPECT_LT(greatestThread, threads);
			if (n < 16)
			{
				EXPECT_EQ(greatestThread, 0u) << "a thread costs more than these few";
			}
		}
}

TEST(ParallelFor, ThrowsWhatACallThrewAfterAllThreadsHaveEnded)
{
	for (const unsigned threads : {1u, 4u})
	{
		std::atomic<int> running{0}, calls{0};
		const auto call = [&](std::size_t i, std::size_t)
		{
			running++;
			calls++;
			if (i == 20)
			{
				running--;
				throw std::runtime_error("number 20");
			}
			std::this_thread::sleep_for(std::chrono::microseconds(50));
			running--;
		};
		try
		{
			parallelFor(100000, threads, call);
			FAIL() << "nothing was thrown";
		}
		catch (const std::runtime_error& e)
		{
			EXPECT_STREQ(e.what(), "number 20");
		}
		EXPECT_EQ(running, 0);
		EXPECT_GE(calls, 21);
		EXPECT_LT(calls, 100000) << "the rest is not called any more";
	}
}

}  // namespace ridgemap::test
