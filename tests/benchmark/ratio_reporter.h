// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>

namespace ridgemap::benchmarks
{
/** Runs all registered benchmarks. Names are "group/contestant". Afterwards, a table in Markdown shows for every group
 * how many times as long each contestant takes as the first whose name begins with "ridge map", and further tables show
 * the counters. */
int runWithRatios(int argc, char** argv);

/** CPU time of this thread [s]: other programs on the machine disturb it least. */
inline double cpuSeconds()
{
	timespec t;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
	return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

}  // namespace ridgemap::benchmarks
