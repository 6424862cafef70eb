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

int LineGrid::slotOf(const LinePtr& line)
{
	const auto known = slotOfLine_.find(line.get());
	if (known != slotOfLine_.end()) return known->second;
	int slot = int(slots_.size());
	if (free_.empty())
		slots_.emplace_back();
	else
	{
		slot = free_.back();
		free_.pop_back();
	}
	Slot& s = slots_[std::size_t(slot)];
	s.line = line;
	s.keys = cellsOf(*line);
	for (const std::uint64_t k : s.keys) cells_[k].push_back(slot);
	slotOfLine_.emplace(line.get(), slot);
	forgetBeside(s.keys);
	return slot;
}

template <class Visit>
void LineGrid::visitAround(const std::vector<std::uint64_t>& keys, Visit visit) const
{
	for (const std::uint64_t k : keys)
	{
		const auto x = std::int64_t(std::int32_t(k >> 32)), y = std::int64_t(std::int32_t(k & 0xffffffffu));
		for (std::int64_t dy = -1; dy <= 1; dy++)
			for (std::int64_t dx = -1; dx <= 1; dx++)
			{
				const auto cell = cells_.find(cellKey(x + dx, y + dy));
				if (cell == cells_.end()) continue;
				for (const int slot : cell->second) visit(slot);
			}
	}
}

void LineGrid::forgetBeside(const std::vector<std::uint64_t>& keys)
{
	if (besideAsked_) visitAround(keys, [&](int slot) { slots_[std::size_t(slot)].besideKnown = false; });
}

const Lines& LineGrid::beside(int number)
{
	const int own = slotOfNumber_[std::size_t(number)];
	Slot& s = slots_[std::size_t(own)];
	if (s.besideKnown) return s.beside;
	std::vector<int> slots;
	visitAround(s.keys,
				[&](int slot)
				{
					if (slot != own) slots.push_back(slot);
				});
	std::sort(slots.begin(), slots.end());
	slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
	s.beside.clear();
	for (const int slot : slots) s.beside.push_back(slots_[std::size_t(slot)].line);
	s.besideKnown = besideAsked_ = true;
	return s.beside;
}

void LineGrid::release(int slot)
{
	Slot& s = slots_[std::size_t(slot)];
	forgetBeside(s.keys);
	for (const std::uint64_t k : s.keys)
	{
		const auto cell = cells_.find(k);
		cell->second.erase(std::find(cell->second.begin(), cell->second.end(), slot));
		if (cell->second.empty()) cells_.erase(cell);
	}
	slotOfLine_.erase(s.line.get());
	s = Slot();
	free_.push_back(slot);
}

void LineGrid::follow(const Lines& lines)
{
	for (Slot& s : slots_) s.present = false;
	slotOfNumber_.resize(lines.size());
	for (std::size_t i = 0; i < lines.size(); i++)
	{
		slotOfNumber_[i] = slotOf(lines[i]);
		Slot& s = slots_[std::size_t(slotOfNumber_[i])];
		s.number = int(i);
		s.present = true;
	}
	for (std::size_t slot = 0; slot < slots_.size(); slot++)
		if (slots_[slot].line && !slots_[slot].present) release(int(slot));
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
			for (const int slot : cell->second) result.push_back(slots_[std::size_t(slot)].number);
		}
	std::sort(result.begin(), result.end());
	result.erase(std::unique(result.begin(), result.end()), result.end());
	return result;
}

}  // namespace ridgemap
