// SPDX-License-Identifier: BSD-3-Clause
#include "field.h"

#include <algorithm>

namespace ridgemap
{
int TileField::haloBlocks(double cutoff)
{
	return int(std::ceil((margin + cutoff) / double(Frame::blockEdge)));
}

TileField::TileField(const TileStore& store, TileKey key, const Options& options)
	: edge_(store.tileEdge()), cutoff_(options.cutoff), halo_(haloBlocks(options.cutoff))
{
	const int perEdge = store.blocksPerEdge();
	side_ = perEdge + 2 * halo_;
	blocks_.assign(std::size_t(side_) * std::size_t(side_), nullptr);
	views_.reserve(blocks_.size());
	// The halo is narrower than a tile: the nine tiles around cover it.
	for (int ty = -1; ty <= 1; ty++)
		for (int tx = -1; tx <= 1; tx++)
		{
			const Tile* tile = store.find({key.x + tx, key.y + ty});
			if (!tile || tile->cellCount == 0) continue;
			const int x0 = std::max(-halo_, tx * perEdge), x1 = std::min(perEdge + halo_, (tx + 1) * perEdge);
			const int y0 = std::max(-halo_, ty * perEdge), y1 = std::min(perEdge + halo_, (ty + 1) * perEdge);
			for (int by = y0; by < y1; by++)
				for (int bx = x0; bx < x1; bx++)
				{
					const Block& b = tile->blocks[std::size_t((by - ty * perEdge) * perEdge + bx - tx * perEdge)];
					if (b.kernels.empty()) continue;
					blocks_[std::size_t((by + halo_) * side_ + bx + halo_)] = &b;
					nonEmpty_++;
				}
		}
	reach_ = BlockMask(side_);
}

TileField::Range TileField::range(double coordinate, double radius) const
{
	const int first = int(std::floor((coordinate - radius) / double(Frame::blockEdge)));
	const int last = int(std::floor((coordinate + radius) / double(Frame::blockEdge)));
	return {std::max(first, -halo_), std::min(last, side_ - halo_ - 1)};
}

double TileField::weightNear(Vec2 p, double radius) const
{
	const Range x = range(p.x, radius), y = range(p.y, radius);
	look(x, y);
	double sum = 0;
	for (int by = y.first; by <= y.last; by++)
		for (int bx = x.first; bx <= x.last; bx++)
			if (const Block* b = block(bx, by)) sum += b->weight;
	return sum;
}

KernelSums TileField::sample(Vec2 p) const
{
	const Range x = range(p.x, cutoff_), y = range(p.y, cutoff_);
	const float reach = float(cutoff_);
	look(x, y);
	views_.clear();
	for (int by = y.first; by <= y.last; by++)
		for (int bx = x.first; bx <= x.last; bx++)
		{
			const Block* b = block(bx, by);
			if (!b) continue;
			const Vec2 c = centre(bx, by);
			const float dx = float(p.x - c.x), dy = float(p.y - c.y);
			const float ox = std::max(0.0f, std::max(b->minX - dx, dx - b->maxX));
			const float oy = std::max(0.0f, std::max(b->minY - dy, dy - b->maxY));
			if (ox * ox + oy * oy > reach * reach) continue;
			views_.push_back({b->kernels.data(), b->kernels.size(), dx, dy});
			work_.kernels += b->kernelCount;
		}
	work_.evaluations++;
	return sumKernels(views_.data(), views_.size());
}

}  // namespace ridgemap
