// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ridgemap::apps
{
/** Random numbers that are the same for the same seed, whatever the standard library (SplitMix64). */
class Random
{
 public:
	/** Seeds are scattered: the states of a generator follow each other in even steps, so that even seeds would give
	 * the same numbers, shifted. */
	explicit Random(std::uint64_t seed) : state_(scatter(scatter(seed + 0x1234567u) ^ 0x6a09e667f3bcc909u)) {}

	std::uint64_t bits() { return scatter(state_ += 0x9e3779b97f4a7c15u); }
	/** Uniform in [0, 1). */
	double uniform() { return double(bits() >> 11) * 0x1p-53; }
	double uniform(double from, double to) { return from + (to - from) * uniform(); }
	std::size_t below(std::size_t n) { return std::size_t(bits() % n); }
	bool chance(double probability) { return uniform() < probability; }

	/** Normal with mean 0 and standard deviation 1. */
	double normal()
	{
		const double radius = std::sqrt(-2 * std::log(1 - uniform()));
		return radius * std::cos(2 * 3.14159265358979323846 * uniform());
	}

	/** Number of events of a Poisson process: waiting times are added up to the mean. O(mean). */
	std::size_t poisson(double mean)
	{
		std::size_t count = 0;
		for (double t = -std::log(1 - uniform()); t < mean; t -= std::log(1 - uniform())) count++;
		return count;
	}

	template <class T>
	void shuffle(std::vector<T>& v)
	{
		for (std::size_t i = v.size(); i > 1; i--) std::swap(v[i - 1], v[below(i)]);
	}

 private:
	static std::uint64_t scatter(std::uint64_t z)
	{
		z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
		z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
		return z ^ (z >> 31);
	}

	std::uint64_t state_;
};

}  // namespace ridgemap::apps
