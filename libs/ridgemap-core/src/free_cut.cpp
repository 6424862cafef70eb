// SPDX-License-Identifier: BSD-3-Clause
#include "free_cut.h"

#include <algorithm>

#include "sampled_line.h"
#include "walls.h"

namespace ridgemap
{
namespace
{
constexpr double shortestCut = 2;  ///< shorter stretches between stretches that stay are kept [sigma]
constexpr double shortestEnd = 3;  ///< the same at the end of a line [sigma]

/** Lengths below which stretches are not cut [m]: between stretches that stay, and at the ends of a line. There the
 * density falls to half while rays pass beside a wall that ends at a door, and the ridge goes on beyond the surface:
 * where it ends is for trimEnds() to tell. An end that was led to another wall is no such place. */
struct ShortestCuts
{
	ShortestCuts(const Polyline& line, double sigma)
		: between(shortestCut * sigma),
		  front(line.info.front().origin == VertexOrigin::junction ? between : shortestEnd * sigma),
		  back(line.info.back().origin == VertexOrigin::junction ? between : shortestEnd * sigma)
	{
	}

	double between, front, back;
};

/** Gives back what is too short to be left out. On a closed line, runs go on over the seam. */
void keepShortRuns(std::vector<char>& stays, double step, const ShortestCuts& shortest, bool closed)
{
	const std::size_t n = stays.size();
	std::size_t first = 0;
	while (first < n && !stays[first]) first++;
	if (first == n) return;
	const std::size_t begin = closed ? first : 0, end = begin + n;
	for (std::size_t i = begin; i < end;)
	{
		std::size_t last = i;
		while (last < end && !stays[last % n]) last++;
		const bool atFront = !closed && i == 0, atBack = !closed && last == n;
		const double least = atFront ? shortest.front : atBack ? shortest.back : shortest.between;
		if (double(last - i) * step < least)
			for (std::size_t k = i; k < last; k++) stays[k % n] = 1;
		i = std::max(last, i + 1);
	}
}

/** Cuts a line half-way between places that stay and places that do not. */
void split(const Polyline& line, const SampledLine& samples, const std::vector<char>& stays,
		   std::vector<Polyline>& kept, std::vector<Polyline>* removed)
{
	const std::size_t n = stays.size();
	// A closed line is unrolled from its first change, so that no run is torn at its arbitrary beginning.
	std::size_t begin = 0;
	if (line.closed)
	{
		while (stays[begin] == stays[(begin + n - 1) % n]) begin++;
		if (begin == 0) begin = n;  // half a step before it lies before the seam
	}
	const std::size_t end = begin + n;
	for (std::size_t i = begin; i < end;)
	{
		std::size_t last = i;
		while (last + 1 < end && stays[(last + 1) % n] == stays[i % n]) last++;
		const bool atFront = !line.closed && i == 0, atBack = !line.closed && last + 1 == n;
		Polyline part = samples.stretch(atFront ? 0 : (double(i) - 0.5) * samples.step(),
										atBack ? samples.length() : (double(last) + 0.5) * samples.step());
		part.side = line.side;
		part.startReason = atFront ? line.startReason : StopReason::passedThrough;
		part.endReason = atBack ? line.endReason : StopReason::passedThrough;
		if (part.points.size() >= 2)
		{
			if (stays[i % n])
				kept.push_back(std::move(part));
			else if (removed)
				removed->push_back(std::move(part));
		}
		i = last + 1;
	}
}
}  // namespace

double passesAcross(const FreeSpace& space, Vec2 p, Vec2 tangent)
{
	const std::array<double, 3> s = space.interpolated(p);
	// The normal is the tangent turned by 90 degrees: cosine and sine of twice its angle change their signs.
	const double cos2 = tangent.y * tangent.y - tangent.x * tangent.x, sin2 = -2 * tangent.x * tangent.y;
	return 0.5 * (s[0] + (s[1] * cos2 + s[2] * sin2) / double(LatticeRay::directionScale));
}

namespace
{
/** Which samples of a line stay; empty if all do, or if the density is known nowhere on it. */
std::vector<char> decide(const Polyline& line, const SampledLine& samples, const Options& options)
{
	const int reach = int(options.freeSpaceWindow / SampledLine::spacing);
	std::vector<char> stays(samples.size(), 1);
	for (std::size_t i = 0; i < stays.size(); i++)
	{
		int count = 0;
		const Evidence e = samples.sum(i, reach, count);
		const bool seldom = e.passes < options.freeSpaceLeast * count;
		stays[i] = seldom || e.hits >= options.freeSpaceTau * (e.hits + e.passes);
	}
	const auto cut = [&] { return std::find(stays.begin(), stays.end(), 0) != stays.end(); };
	if (cut()) keepShortRuns(stays, samples.step(), ShortestCuts(line, options.sigma), line.closed);
	if (!cut()) stays.clear();
	return stays;
}

bool hasDensity(const Polyline& line)
{
	return std::any_of(line.info.begin(), line.info.end(), [](const VertexInfo& v) { return v.occupancy > 0; });
}

void cut(const Polyline& line, const SampledLine& samples, const std::vector<char>& stays, std::vector<Polyline>& kept,
		 std::vector<Polyline>* removed)
{
	if (std::find(stays.begin(), stays.end(), 1) != stays.end())
		split(line, samples, stays, kept, removed);
	else if (removed)
		removed->push_back(line);
}
}  // namespace

std::vector<Polyline> cutFree(const std::vector<Polyline>& lines, const FreeSpace& space, const Options& options,
							  std::vector<Polyline>* removed)
{
	if (!options.freeSpace || space.empty()) return lines;
	std::vector<Polyline> kept;
	kept.reserve(lines.size());
	for (const Polyline& line : lines)
	{
		if (!hasDensity(line))
		{
			kept.push_back(line);
			continue;
		}
		const SampledLine samples(line, space, options.sigma);
		const std::vector<char> stays = decide(line, samples, options);
		if (stays.empty())
			kept.push_back(line);
		else
			cut(line, samples, stays, kept, removed);
	}
	return kept;
}

Lines FreeCutter::cut(const Lines& lines, const FreeSpace& space, bool prune)
{
	if (!options_.freeSpace || space.empty()) return lines;
	Lines result;
	for (const LinePtr& line : lines)
	{
		if (!hasDensity(*line))
		{
			result.push_back(line);
			continue;
		}
		const SampledLine samples(*line, space, options_.sigma);
		const std::vector<char> stays = decide(*line, samples, options_);
		if (stays.empty())
		{
			result.push_back(line);
			continue;
		}
		const auto parts = [&]
		{
			std::vector<Polyline> kept;
			ridgemap::cut(*line, samples, stays, kept, nullptr);
			Lines all;
			for (Polyline& part : kept)
				if (!prune || !isShort(part, options_))
					all.push_back(std::make_shared<const Polyline>(std::move(part)));
			return all;
		};
		MemoKey key;
		key.add(line).add(stays[0] != 0);
		for (std::size_t i = 1; i < stays.size(); i++)
			if (stays[i] != stays[i - 1]) key.add(double(i));
		const Lines& made = parts_.get(std::move(key), parts);
		result.insert(result.end(), made.begin(), made.end());
	}
	parts_.forgetUnused();
	return result;
}

}  // namespace ridgemap
