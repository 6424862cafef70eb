// SPDX-License-Identifier: BSD-3-Clause
#include "runs.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ridgemap
{
namespace
{
constexpr double farthest = 3;      ///< samples of a run are nearer to its curve than this [standard errors]
constexpr double significant = 4;   ///< a curvature above this many standard errors is no line's
constexpr double muchLonger = 1.5;  ///< an arc must reach this much farther than a line
constexpr std::size_t stride = 4;   ///< from one attempt to start a run to the next [samples]
constexpr std::size_t search = 16;  ///< farthest that a boundary between two runs is moved [samples]

constexpr std::size_t excessWindow = 64;  ///< samples to which a parabola is fitted
constexpr double expectedSquare = 0.3;  ///< of their residuals, in variances, when these are right; found by simulation
constexpr double largestExcess = 10;

class RunFinder
{
 public:
	RunFinder(const std::vector<WallSample>& samples, const RunRules& rules) : samples_(samples), rules_(rules) {}

	std::vector<Run> run()
	{
		if (rules_.bounded && samples_.size() >= rules_.leastWhole && samples_.size() < rules_.least)
			if (const auto whole = fit(WallShape::line, 0, samples_.size())) return {*whole};
		grow();
		for (int round = 0; round < 2; round++)
		{
			mergeNeighbours();
			settleBoundaries();
		}
		return runs_;
	}

 private:
	SampleRange range(std::size_t from, std::size_t to) const { return {samples_.data() + from, samples_.data() + to}; }

	bool isNear(const FittedCurve& curve, const WallSample& s) const
	{
		const double d = curve.distance(s.p);
		return d * d <= farthest * farthest * s.variance;
	}

	/** The run of a shape over [from, to), if the samples support it. */
	std::optional<Run> fit(WallShape shape, std::size_t from, std::size_t to) const
	{
		const SampleRange r = range(from, to);
		Run run{shape, from, to, {}};
		if (shape == WallShape::line)
		{
			run.curve = fitStraight(r);
			if (!allNear(run)) return std::nullopt;
			const std::optional<FittedCurve> bent = r.size() > 8 ? bendOf(run.curve, r) : std::nullopt;
			if (bent && isBent(*bent)) return std::nullopt;
			return run;
		}
		const std::optional<FittedCurve> arc = fitArc(r);
		if (!arc || !isBent(*arc) || std::abs(arc->curvature) > rules_.largestCurvature) return std::nullopt;
		run.curve = *arc;
		if (!allNear(run)) return std::nullopt;
		return run;
	}

	bool isBent(const FittedCurve& arc) const
	{
		return arc.curvature * arc.curvature > significant * significant * samplesPerIndependent * arc.covariance[5];
	}

	bool allNear(const Run& run) const
	{
		return std::all_of(samples_.data() + run.from, samples_.data() + run.to,
						   [&](const WallSample& s) { return isNear(run.curve, s); });
	}

	/** The longest run of a shape from here on, if it is not shorter than `least`. */
	std::optional<Run> longest(WallShape shape, std::size_t from, std::size_t least) const
	{
		if (from + least > samples_.size()) return std::nullopt;
		std::optional<Run> best = fit(shape, from, from + least);
		if (!best) return std::nullopt;
		std::size_t bad = samples_.size() + 1;
		while (best->to + 1 < bad)
		{
			const std::size_t twice = from + 2 * (best->to - from);
			const std::size_t to = bad > samples_.size() ? std::min(twice, samples_.size()) : (best->to + bad) / 2;
			if (to == best->to) break;
			if (const auto longer = fit(shape, from, to))
				best = longer;
			else
				bad = to;
		}
		return best;
	}

	void addFree(std::size_t from, std::size_t to)
	{
		if (from >= to) return;
		if (!runs_.empty() && runs_.back().shape == WallShape::curve)
			runs_.back().to = to;
		else
			runs_.push_back({WallShape::curve, from, to, {}});
	}

	/** Runs as long as they get, from the beginning on. */
	void grow()
	{
		std::size_t i = 0;
		while (i < samples_.size())
		{
			const std::optional<Run> line = longest(WallShape::line, i, rules_.least);
			const std::size_t least = line ? std::size_t(muchLonger * double(line->to - i)) + 1 : rules_.least;
			const std::optional<Run> arc = longest(WallShape::arc, i, least);
			if (arc || line)
			{
				runs_.push_back(arc ? *arc : *line);
				i = runs_.back().to;
				continue;
			}
			const std::size_t next = std::min(i + stride, samples_.size());
			addFree(i, next);
			i = next;
		}
	}

	/** Two runs that one line or arc explains become one, and so do runs with a short free stretch between them. */
	void mergeNeighbours()
	{
		for (std::size_t k = 0; k + 1 < runs_.size();)
		{
			bool merged = false;
			for (const std::size_t last : {k + 2, k + 1})
			{
				if (last >= runs_.size() || runs_[k].shape == WallShape::curve) continue;
				if (last == k + 2 ? runs_[k + 2].shape == WallShape::curve : false) continue;
				for (const WallShape shape : {WallShape::line, WallShape::arc})
				{
					const auto whole = merged ? std::nullopt : fit(shape, runs_[k].from, runs_[last].to);
					if (!whole) continue;
					runs_[k] = *whole;
					runs_.erase(runs_.begin() + std::ptrdiff_t(k) + 1, runs_.begin() + std::ptrdiff_t(last) + 1);
					merged = true;
				}
				if (merged) break;
			}
			if (merged)
				k = k > 1 ? k - 2 : 0;
			else
				k++;
		}
	}

	/** Moves the boundaries to where the sample fits both sides alike, and fits anew. */
	void settleBoundaries()
	{
		for (std::size_t k = 0; k + 1 < runs_.size(); k++)
		{
			Run &a = runs_[k], &b = runs_[k + 1];
			std::size_t at = a.to;
			if (a.shape != WallShape::curve && b.shape != WallShape::curve)
				at = bestBoundary(a, b);
			else if (a.shape != WallShape::curve)
				while (at + 1 < b.to && isNear(a.curve, samples_[at])) at++;
			else if (b.shape != WallShape::curve)
				while (at > a.from + 1 && isNear(b.curve, samples_[at - 1])) at--;
			a.to = b.from = at;
		}
		for (Run& r : runs_)
			if (r.shape != WallShape::curve)
				if (const auto again = fit(r.shape, r.from, r.to)) r = *again;
	}

	/** The boundary with the least sum of squares on both sides. */
	std::size_t bestBoundary(const Run& a, const Run& b) const
	{
		const std::size_t low = std::max(a.from + rules_.least / 2, a.to > search ? a.to - search : 0);
		const std::size_t high = std::min(b.to > rules_.least / 2 ? b.to - rules_.least / 2 : 0, a.to + search);
		if (low >= high) return a.to;
		const auto square = [&](const Run& r, std::size_t i)
		{
			const double d = r.curve.distance(samples_[i].p);
			return d * d / samples_[i].variance;
		};
		double sum = 0, best = 0;
		std::size_t at = low;
		for (std::size_t i = low; i < high; i++)
		{
			sum += square(a, i) - square(b, i);
			if (sum < best)
			{
				best = sum;
				at = i + 1;
			}
		}
		return at;
	}

	const std::vector<WallSample>& samples_;
	const RunRules& rules_;
	std::vector<Run> runs_;
};
}  // namespace

double excessError(const std::vector<WallSample>& samples)
{
	std::vector<double> ratios;
	for (std::size_t from = 0; from + excessWindow <= samples.size(); from += excessWindow / 4)
	{
		const SampleRange r{samples.data() + from, samples.data() + from + excessWindow};
		const std::optional<FittedCurve> arc = bendOf(fitStraight(r), r);
		if (!arc) continue;
		double square = 0;
		for (const WallSample* i = r.first; i != r.last; i++)
		{
			const double d = arc->distance(i->p);
			square += d * d / i->variance / double(excessWindow);
		}
		ratios.push_back(square);
	}
	if (ratios.empty()) return 1;
	// A low quantile, as recesses and bends of the surface are no excess.
	const auto quantile = ratios.begin() + std::ptrdiff_t(2 * ratios.size() / 5);
	std::nth_element(ratios.begin(), quantile, ratios.end());
	return std::min(largestExcess, std::max(1.0, std::sqrt(*quantile / expectedSquare)));
}

std::vector<Run> findRuns(const std::vector<WallSample>& samples, const RunRules& rules)
{
	return RunFinder(samples, rules).run();
}

}  // namespace ridgemap
