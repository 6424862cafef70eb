// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace ridgemap
{
/** exp(-x) by the inverse of the series of exp(x) up to x^terms, in arithmetic that gives the same bits everywhere. */
template <int terms>
inline double expMinusBySeries(double x)
{
	double sum = 1, term = 1;
	for (int k = 1; k <= terms; k++)
	{
		term *= x / k;
		sum += term;
	}
	return 1 / sum;
}

/** exp(-x) for 0 <= x < 13 to ten digits, above that an upper bound. */
inline double expMinusSeries(double x)
{
	return expMinusBySeries<40>(x);
}

}  // namespace ridgemap
