// SPDX-License-Identifier: BSD-3-Clause
#include "line_grid.h"

#include <algorithm>
#include <cmath>

namespace ridgemap
{
namespace
{
std::uint64_t cellKey(std::int64_t x, std::int64_t y)
{
	return (std::uint64_t(x) << 32) ^ (std::uint64_t(y) & 0xffffffffu);
}
}  // namespace

std::uint64_t LineGrid::key(double x, double y) const
{
	return cellKey(std::int64_t(std::floor(x / cell_)), std::int64_t(std::floor(y / cell_)));
}

/** Cells of places at most half a cell apart along the line. */
std::vector<std::uint64_t> LineGrid::cellsOf(const Polyline& line) const
{
	std::vector<std::uint64_t> keys;
	for (std::size_t k = 1; k < line.points.size(); k++)
	{
		const Vec2 a{line.points[k - 1].x, line.points[k - 1].y}, b{line.points[k].x, line.points[k].y};
		const int n = int(norm(b - a) / (0.5 * cell_)) + 1;
		for (int i = 0; i <= n; i++)
		{
			const Vec2 p = a + (double(i) / n) * (b - a);
			keys.push_back(key(p.x, p.y));
		}
	}
	std::sort(keys.begin(), keys.end());
	keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
	return keys;
}

void LineGrid::follow(const Lines& lines)
{
	for (auto& entry : lines_) entry.second.present = false;
	for (std::size_t i = 0; i < lines.size(); i++)
	{
		Cells& c = lines_[lines[i].get()];
		if (!c.line)
		{
			c.line = lines[i];
			c.keys = cellsOf(*lines[i]);
			for (const std::uint64_t k : c.keys) cells_[k].push_back(lines[i].get());
		}
		c.number = int(i);
		c.present = true;
	}
	for (auto it = lines_.begin(); it != lines_.end();)
	{
		if (it->second.present)
		{
			++it;
			continue;
		}
		for (const std::uint64_t k : it->second.keys)
		{
			std::vector<const Polyline*>& in = cells_[k];
			in.erase(std::find(in.begin(), in.end(), it->first));
			if (in.empty()) cells_.erase(k);
		}
		it = lines_.erase(it);
	}
}

std::vector<int> LineGrid::near(const Point2& p, double distance) const
{
	std::vector<int> result;
	const double reach = distance + 0.5 * cell_;
	const auto index = [&](double v) { return std::int64_t(std::floor(v / cell_)); };
	for (std::int64_t y = index(p.y - reach); y <= index(p.y + reach); y++)
		for (std::int64_t x = index(p.x - reach); x <= index(p.x + reach); x++)
		{
			const auto cell = cells_.find(cellKey(x, y));
			if (cell == cells_.end()) continue;
			for (const Polyline* line : cell->second) result.push_back(lines_.at(line).number);
		}
	std::sort(result.begin(), result.end());
	result.erase(std::unique(result.begin(), result.end()), result.end());
	return result;
}

}  // namespace ridgemap
