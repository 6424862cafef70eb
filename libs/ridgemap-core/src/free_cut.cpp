// SPDX-License-Identifier: BSD-3-Clause
#include "free_cut.h"

#include <algorithm>
#include <cmath>

#include "wall_path.h"
#include "walls.h"

namespace ridgemap
{
namespace
{
constexpr double spacing = 0.5;    ///< of samples along a line, at most [sigma]
constexpr double shortestCut = 2;  ///< shorter stretches between stretches that stay are kept [sigma]
constexpr double shortestEnd = 3;  ///< the same at the end of a line [sigma]

/** Hits and passes at one place of a line. */
struct Evidence
{
	double hits = 0, passes = 0;
};

/** A line with places at even distances along it. */
class SampledLine
{
 public:
	SampledLine(const Polyline& line, const FreeSpace& space, double sigma) : line_(line), path_(line)
	{
		fillOccupancies();
		const double length = path_.length();
		const int pieces = std::max(1, int(std::ceil(length / (spacing * sigma))));
		step_ = length / pieces;
		// The last place of a closed line is its first.
		const int count = line.closed ? pieces : pieces + 1;
		std::size_t node = 1;
		for (int i = 0; i < count; i++) evidence_.push_back(evidenceAt(i * step_, node, space, sigma));
	}

	std::size_t size() const { return evidence_.size(); }
	double step() const { return step_; }
	double length() const { return path_.length(); }

	/** Sums over the places within `reach` places of place i, and how many these are. */
	Evidence sum(std::size_t i, int reach, int& count) const
	{
		Evidence total;
		count = 0;
		const int n = int(size());
		if (line_.closed) reach = std::min(reach, (n - 1) / 2);
		for (int k = int(i) - reach; k <= int(i) + reach; k++)
		{
			if (!line_.closed && (k < 0 || k >= n)) continue;
			const Evidence& e = evidence_[std::size_t((k + n) % n)];
			total.hits += e.hits;
			total.passes += e.passes;
			count++;
		}
		return total;
	}

	/** The stretch from arc length a to b as a line of its own; over the seam of a closed line if b is beyond its
	 * length. */
	Polyline stretch(double a, double b) const
	{
		Polyline part;
		const auto add = [&](Vec2 p, const VertexInfo& info)
		{
			if (!part.points.empty() && part.points.back() == Point2{p.x, p.y}) return;
			part.points.push_back({p.x, p.y});
			part.info.push_back(info);
		};
		add(path_.at(a), infoAt(a));
		const std::size_t nodes = line_.points.size();
		for (const double turn : {0.0, path_.length()})
		{
			if (turn > 0 && b <= path_.length()) break;
			for (std::size_t k = turn > 0 ? 1 : 0; k < nodes; k++)
				if (turn + path_.arc(k) > a && turn + path_.arc(k) < b)
					add({line_.points[k].x, line_.points[k].y}, line_.info[k]);
		}
		add(path_.at(b), infoAt(b));
		return part;
	}

 private:
	Evidence evidenceAt(double s, std::size_t& node, const FreeSpace& space, double sigma) const
	{
		const Vec2 p = path_.at(s), before = behind(s - spacing * sigma), after = behind(s + spacing * sigma);
		while (node + 1 < line_.points.size() && path_.arc(node) < s) node++;
		Evidence e;
		e.hits = hitsOf(occupancyBetween(node, s));
		e.passes =
			passesAcross(space, space.frame().toLattice({p.x, p.y}), unit(Frame::rotateToLattice(after - before)));
		return e;
	}

	/** Vertices that wall passes have added lie on no ridge: their density is that of the ridge beside them. */
	void fillOccupancies()
	{
		const std::size_t n = line_.points.size();
		std::size_t last = n;  // the last vertex on a ridge, n: none yet
		for (std::size_t k = 0; k < n; k++)
		{
			const double here = double(line_.info[k].occupancy);
			occupancies_.push_back(here);
			if (!(here > 0)) continue;
			for (std::size_t i = last == n ? 0 : last + 1; i < k; i++)
			{
				const double before = last == n ? here : occupancies_[last];
				const double d = last == n ? 0 : path_.arc(k) - path_.arc(last);
				const double t = d > 0 ? (path_.arc(i) - path_.arc(last)) / d : 0;
				occupancies_[i] = before + t * (here - before);
			}
			last = k;
		}
		for (std::size_t i = last == n ? n : last + 1; i < n; i++) occupancies_[i] = occupancies_[last];
	}

	/** Place at an arc length that may lie beyond the ends of an open line. */
	Vec2 behind(double s) const { return path_.at(line_.closed ? s : std::max(0.0, std::min(path_.length(), s))); }

	/** Density between node - 1 and node. */
	double occupancyBetween(std::size_t node, double s) const
	{
		const double a = path_.arc(node - 1), d = path_.arc(node) - a, t = d > 0 ? (s - a) / d : 0;
		return (1 - t) * occupancies_[node - 1] + t * occupancies_[node];
	}

	VertexInfo infoAt(double s) const
	{
		if (s >= path_.length() && line_.closed) s -= path_.length();
		std::size_t node = 1;
		while (node + 1 < line_.points.size() && path_.arc(node) < s) node++;
		const double a = path_.arc(node - 1), d = path_.arc(node) - a, t = d > 0 ? (s - a) / d : 0;
		const VertexInfo &u = line_.info[node - 1], &v = line_.info[node];
		const double curvature = (1 - t) * double(u.curvature) + t * double(v.curvature);
		VertexInfo info;
		info.occupancy = float(occupancyBetween(node, s));
		info.curvature = float(curvature);
		info.standardError = std::max(u.standardError, v.standardError);
		return info;
	}

	const Polyline& line_;
	Path path_;
	double step_ = 0;
	std::vector<double> occupancies_;  ///< of the vertices
	std::vector<Evidence> evidence_;
};

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
	const int reach = int(options.freeSpaceWindow / spacing);
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
