// SPDX-License-Identifier: BSD-3-Clause
#include "candidate_cells.h"

#include <algorithm>

namespace ridgemap
{
CandidateCells::CandidateCells(const Point2& corner, double edge, std::int64_t columns, std::int64_t rows)
	: corner_(corner),
	  edge_(edge),
	  perMetre_(1 / edge),
	  columns_(columns),
	  rows_(rows),
	  blockColumns_(std::size_t(columns) / blockEdge + 1)
{
	const std::size_t blocks = blockColumns_ * (std::size_t(rows) / blockEdge + 1);
	blocks_ = std::make_unique<std::atomic<Block*>[]>(blocks);
	for (std::size_t i = 0; i < blocks; i++) blocks_[i].store(nullptr, std::memory_order_relaxed);
}

CandidateCells::~CandidateCells() = default;

const CellCandidate* CandidateCells::keep(std::size_t block, std::size_t cell, const std::vector<CellCandidate>& list)
{
	const std::lock_guard<std::mutex> lock(mutex_);
	Block* b = blocks_[block].load(std::memory_order_relaxed);
	if (!b)
	{
		b = &blockStore_.emplace_back();
		for (auto& c : *b) c.store(nullptr, std::memory_order_relaxed);
		blocks_[block].store(b, std::memory_order_release);
	}
	// Another thread may have made the same list meanwhile.
	if (const CellCandidate* known = (*b)[cell].load(std::memory_order_relaxed)) return known;
	constexpr std::size_t chunk = 4096;
	if (lists_.empty() || lists_.back().capacity() - lists_.back().size() < list.size())
		lists_.emplace_back().reserve(std::max(chunk, list.size()));
	auto& store = lists_.back();
	const CellCandidate* kept = store.data() + store.size();
	store.insert(store.end(), list.begin(), list.end());
	(*b)[cell].store(kept, std::memory_order_release);
	return kept;
}

}  // namespace ridgemap
