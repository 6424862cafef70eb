// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

namespace ridgemap
{
/** A segment that may be the nearest one to a point of a cell. Small, for lists that miss the cache cost more than
 * distances. */
struct CellCandidate
{
	float leastSqr = 0;         ///< square of a lower bound on its distance from all points of the cell [m^2]
	std::uint32_t segment = 0;  ///< its number, or one of the two marks

	/** Marks the end of a list: there is no other segment. */
	static constexpr std::uint32_t end = 0xffffffffu;
	/** Marks the end of a list that may not be complete: segments beyond `leastSqr` are not in it. */
	static constexpr std::uint32_t beyond = 0xfffffffeu;
};

/** Square cells of the plane, each with the list of segments that can be nearest to one of its points, sorted by
 * leastSqr and ended by a mark. A list is made by the first query that falls into its cell.
 *
 * Thread-safe: lists that are there are read without a lock. */
class CandidateCells
{
 public:
	/** Cells of that edge [m] over columns x rows of them, from the lower left corner on. */
	CandidateCells(const Point2& corner, double edge, std::int64_t columns, std::int64_t rows);
	~CandidateCells();
	CandidateCells(const CandidateCells&) = delete;
	CandidateCells& operator=(const CandidateCells&) = delete;

	/** The list of the cell that a point lies in; null outside of the cells. O(1) if it has been made.
	 * @param make given the centre of the cell, returns the list as a vector. */
	template <class Make>
	const CellCandidate* at(const Point2& p, Make&& make)
	{
		const double u = (p.x - corner_.x) * perMetre_, v = (p.y - corner_.y) * perMetre_;
		if (!(u >= 0 && v >= 0 && u < double(columns_) && v < double(rows_))) return nullptr;
		const auto x = std::uint32_t(u), y = std::uint32_t(v);
		const std::size_t block = std::size_t(y / blockEdge) * blockColumns_ + x / blockEdge;
		const std::size_t cell = y % blockEdge * blockEdge + x % blockEdge;
		if (const Block* b = blocks_[block].load(std::memory_order_acquire))
			if (const CellCandidate* list = (*b)[cell].load(std::memory_order_acquire)) return list;
		const Point2 centre{corner_.x + (x + 0.5) * edge_, corner_.y + (y + 0.5) * edge_};
		return keep(block, cell, make(centre));
	}

	double edge() const { return edge_; }

 private:
	static constexpr std::uint32_t blockEdge = 16;
	using Block = std::array<std::atomic<const CellCandidate*>, blockEdge * blockEdge>;

	const CellCandidate* keep(std::size_t block, std::size_t cell, const std::vector<CellCandidate>& list);

	Point2 corner_;
	double edge_, perMetre_;
	std::int64_t columns_, rows_;
	std::size_t blockColumns_;
	std::unique_ptr<std::atomic<Block*>[]> blocks_;
	std::mutex mutex_;  ///< guards what follows, and changes of blocks
	std::deque<Block> blockStore_;
	std::deque<std::vector<CellCandidate>> lists_;  ///< many lists to a vector, which never grows beyond its capacity
};

}  // namespace ridgemap
