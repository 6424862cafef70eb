// SPDX-License-Identifier: BSD-3-Clause
#include "walls.h"

#include <algorithm>

#include "free_cut.h"
#include "wall_maker.h"

namespace ridgemap
{
std::vector<Polyline> withoutVertices(const Polyline& line, const std::vector<bool>& leftOut, StopReason reason)
{
	std::vector<Polyline> result;
	const std::size_t n = line.points.size();
	const std::size_t first = std::size_t(std::find(leftOut.begin(), leftOut.end(), true) - leftOut.begin());
	if (first == n) return {line};
	// A closed line is cut at the first of these vertices, so that no run is torn at its arbitrary beginning.
	const std::size_t begin = line.closed ? first : 0, count = line.closed ? n - 1 : n;
	Polyline run;
	const auto start = [&](StopReason why)
	{
		run = Polyline();
		run.startReason = why;
		run.side = line.side;
	};
	const auto finish = [&](StopReason why)
	{
		run.endReason = why;
		if (run.points.size() >= 2) result.push_back(run);
		start(reason);
	};
	start(line.closed ? reason : line.startReason);
	for (std::size_t i = 0; i < count; i++)
	{
		const std::size_t k = line.closed ? (begin + i) % count : i;
		if (leftOut[k])
		{
			finish(reason);
			continue;
		}
		run.points.push_back(line.points[k]);
		run.info.push_back(line.info[k]);
	}
	finish(line.closed ? reason : line.endReason);
	return result;
}

std::vector<Polyline> cutWeak(const Polyline& line, const Options& options)
{
	std::vector<bool> weak;
	for (const VertexInfo& v : line.info) weak.push_back(v.curvature < float(options.minCurvature));
	return withoutVertices(line, weak, StopReason::notARidge);
}

bool isShort(const Polyline& line, const Options& options)
{
	return line.length() < options.pruneLength * options.sigma;
}

std::vector<Polyline> makeWalls(const std::vector<Polyline>& ridges, const FreeSpace& space, const Options& options)
{
	Lines lines;
	for (const Polyline& r : ridges) lines.push_back(std::make_shared<const Polyline>(r));
	return WallMaker(options).make(lines, space);
}

std::vector<Polyline> clearedFromWalls(const std::vector<Polyline>& ridges, const FreeSpace& space,
									   const Options& options)
{
	std::vector<Polyline> removed;
	for (const Polyline& ridge : ridges)
	{
		std::vector<Polyline> parts{ridge};
		if (options.minCurvature > 0) parts = cutWeak(ridge, options);
		for (const Polyline& part : parts)
			if (!options.prune || !isShort(part, options)) cutFree({part}, space, options, &removed);
	}
	return removed;
}

}  // namespace ridgemap
