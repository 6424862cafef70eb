// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

namespace ridgemap
{
/** Logarithms of the density of beam ends over square cells of the plane, each that of its centre, made when it is
 * first asked for. The particles of a filter ask for the same cells again and again.
 *
 * Thread-safe, without a lock but for the first query of a block: all threads make the same value. */
class LikelihoodTable
{
 public:
	/** What the values depend on but for the map. */
	using Settings = std::array<double, 8>;

	/** @param box beyond it, and for queries that are not finite, the value is `outside`. An empty box, or one so wide
	 * that the table would eat the memory, makes a table that cannot be used. @param pitch edge of a cell [m]. */
	LikelihoodTable(const Settings& settings, const Box2& box, double pitch, double outside);

	bool usable() const { return blocks_ != nullptr; }

	/** The value of the cell that a point lies in. O(1) if it has been made.
	 * @param make given the centre of the cell, returns a number.
	 * @param isFar given a point and a distance, whether `make` returns the value outside everywhere within it. Blocks
	 * of cells that are far from everything need no other query. */
	template <class Make, class IsFar>
	double at(const Point2& p, Make&& make, IsFar&& isFar)
	{
		const double u = (p.x - corner_.x) * perMetre_, v = (p.y - corner_.y) * perMetre_;
		if (!(u >= 0 && v >= 0 && u < columns_ && v < rows_)) return outside_;
		const auto x = std::uint32_t(u), y = std::uint32_t(v);
		std::atomic<Block*>& place = blocks_[std::size_t(y / blockEdge) * blockColumns_ + x / blockEdge];
		Block* block = place.load(std::memory_order_acquire);
		if (!block)
		{
			const auto middle = [&](std::uint32_t cell)
			{ return (double(cell / blockEdge * blockEdge) + 0.5 * blockEdge) * pitch_; };
			const double reach = 0.7072 * blockEdge * pitch_;
			const bool far = isFar(Point2{corner_.x + middle(x), corner_.y + middle(y)}, reach);
			block = addBlock(place, far ? float(outside_) : std::numeric_limits<float>::quiet_NaN());
		}
		std::atomic<float>& value = (*block)[y % blockEdge * blockEdge + x % blockEdge];
		const float known = value.load(std::memory_order_relaxed);
		if (!std::isnan(known)) return known;
		const auto made = float(make(Point2{corner_.x + (x + 0.5) * pitch_, corner_.y + (y + 0.5) * pitch_}));
		value.store(made, std::memory_order_relaxed);
		return made;
	}

	const Settings& settings() const { return settings_; }

 private:
	static constexpr std::uint32_t blockEdge = 32;
	using Block = std::array<std::atomic<float>, blockEdge * blockEdge>;

	Block* addBlock(std::atomic<Block*>& place, float value);

	Settings settings_;
	Point2 corner_;
	double pitch_, perMetre_, columns_ = 0, rows_ = 0, outside_;
	std::size_t blockColumns_ = 0;
	std::unique_ptr<std::atomic<Block*>[]> blocks_;
	std::mutex mutex_;  ///< guards what follows, and changes of blocks
	std::deque<Block> blockStore_;
};

}  // namespace ridgemap
