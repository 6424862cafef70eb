// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_time.h"

#include <algorithm>
#include <ctime>

#include "field_nodes.h"  // of the core: what its updates call

namespace ridgemap::apps
{
double msOfThread()
{
	timespec t;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
	return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

double evaluationTime()
{
	constexpr int repeats = 20, count = 20000;
	float nodes[NodeTaps::count * NodeTaps::count];
	for (int i = 0; i < NodeTaps::count * NodeTaps::count; i++) nodes[i] = float(i % 7);
	double best = 1e9;
	volatile double kept = 0;  // so that nothing is left out
	for (int repeat = 0; repeat < repeats; repeat++)
	{
		const double start = msOfThread();
		double sum = 0;
		for (int i = 0; i < count; i++)
		{
			KernelSums sums;
			const NodeSquare square{nodes, &sums};
			const float t = float(i % 64) / 64;
			interpolateNodes(&square, 1, NodeTaps::count, t, 1 - t);
			sum += sums.value;
		}
		kept = kept + sum;
		best = std::min(best, (msOfThread() - start) / count);
	}
	return best;
}

}  // namespace ridgemap::apps
