// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace ridgemap
{
/** exp(-x) by the inverse of the series of exp(x), in arithmetic that gives the same bits everywhere: to ten digits for
 * 0 <= x < 13, above that an upper bound. */
inline double expMinusSeries(double x)
{
	double sum = 1, term = 1;
	for (int k = 1; k <= 40; k++)
	{
		term *= x / k;
		sum += term;
	}
	return 1 / sum;
}

}  // namespace ridgemap
