// SPDX-License-Identifier: BSD-3-Clause
#include "gap_closer.h"

#include <algorithm>
#include <cmath>

#include "wall_path.h"

namespace ridgemap
{
namespace
{
constexpr double widestGap = 1.5;  ///< [sigma]
constexpr double touching = 1e-9;  ///< [sigma]

bool mayHaveGap(const Polyline& line, bool back)
{
	return !line.closed && reasonAt(line, back) != StopReason::passedThrough;
}
}  // namespace

Lines GapCloser::close(const Lines& lines)
{
	grid_.follow(lines);
	Lines result;
	for (const LinePtr& line : lines)
	{
		LineGrid::NearEnds near =
			grid_.nearEnds(line, widestGap * sigma_, lines, [&](bool back) { return mayHaveGap(*line, back); });
		const auto isOther = [&](int i) { return lines[std::size_t(i)] != line; };
		const auto hasOther = [&](const std::vector<int>& n) { return std::any_of(n.begin(), n.end(), isOther); };
		if (hasOther(near.numbers[0]) || hasOther(near.numbers[1]))
			result.push_back(memo_.get(std::move(near.key), [&] { return closed(line, near.numbers, lines); }));
		else
			result.push_back(line);
	}
	memo_.forgetUnused();
	return result;
}

LinePtr GapCloser::closed(const LinePtr& line, const std::array<std::vector<int>, 2>& near, const Lines& lines) const
{
	Polyline p = *line;
	bool changed = false;
	for (const bool back : {true, false})
	{
		const Vec2 tip{endOf(*line, back).x, endOf(*line, back).y};
		double best = widestGap * sigma_;
		Vec2 foot;
		bool touches = false;
		for (const int i : near[back])
		{
			const LinePtr& other = lines[std::size_t(i)];
			const Path path(*other);
			for (std::size_t k = 1; k < other->points.size(); k++)
			{
				const Vec2 a = vertexAt(*other, k - 1), b = vertexAt(*other, k);
				const SegmentFoot f = footOnSegment(a, b, tip);
				const double arc = path.arc(k - 1) + f.t * norm(b - a), end = back ? path.length() : 0;
				if (other == line && std::abs(arc - end) <= 2 * widestGap * sigma_) continue;
				touches = touches || f.distance <= touching * sigma_;
				if (other == line || f.distance >= best) continue;
				best = f.distance;
				foot = a + f.t * (b - a);
			}
		}
		if (touches || best >= widestGap * sigma_) continue;
		changed = true;
		p.points.insert(back ? p.points.end() : p.points.begin(), {foot.x, foot.y});
		p.info.insert(back ? p.info.end() : p.info.begin(), madeVertex(VertexOrigin::junction));
	}
	return changed ? std::make_shared<const Polyline>(std::move(p)) : line;
}

}  // namespace ridgemap
