// SPDX-License-Identifier: BSD-3-Clause
#include "likelihood_table.h"

namespace ridgemap
{
LikelihoodTable::LikelihoodTable(const Settings& settings, const Box2& box, double pitch, double outside)
	: settings_(settings),
	  corner_(box.min),
	  pitch_(pitch),
	  perMetre_(1 / pitch),
	  outside_(float(outside))  // as cells give it, so that it does not matter on which side of the border a beam ends
{
	constexpr double mostBlocks = 1 << 22;
	const double columns = std::ceil((box.max.x - box.min.x) / pitch),
				 rows = std::ceil((box.max.y - box.min.y) / pitch);
	if (box.empty() || !((columns / blockEdge + 1) * (rows / blockEdge + 1) <= mostBlocks)) return;
	columns_ = columns;
	rows_ = rows;
	blockColumns_ = std::size_t(columns) / blockEdge + 1;
	// Null pointers, for the array is value-initialized.
	blocks_ = std::make_unique<std::atomic<Block*>[]>(blockColumns_ * (std::size_t(rows) / blockEdge + 1));
}

LikelihoodTable::Block* LikelihoodTable::addBlock(std::atomic<Block*>& place, float initial)
{
	const std::lock_guard<std::mutex> lock(mutex_);
	Block* block = place.load(std::memory_order_relaxed);
	if (block) return block;  // of another thread
	block = &blockStore_.emplace_back();
	for (auto& value : *block) value.store(initial, std::memory_order_relaxed);
	place.store(block, std::memory_order_release);
	return block;
}

}  // namespace ridgemap
