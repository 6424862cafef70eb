// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace ridgemap
{
/** Time since it was made. Told to the user; no result depends on it. */
class Stopwatch
{
 public:
	double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
	using Clock = std::chrono::steady_clock;
	Clock::time_point start_ = Clock::now();
};

}  // namespace ridgemap
