// SPDX-License-Identifier: BSD-3-Clause
#include "field.h"

#include <algorithm>

namespace ridgemap
{
int TileField::haloBlocks(double cutoff)
{
	return int(std::ceil((margin + cutoff) / double(Frame::blockEdge)));
}

int TileField::haloOfNodes()
{
	return int(std::ceil((margin * nodesPerSigma + NodePatch::after) / double(nodesPerBlock)));
}

TileField::TileField(const TileStore& store, TileKey key, const Options& options)
	: compacts_(CellGrid(options).compacts()),
	  edge_(store.tileEdge()),
	  cutoff_(options.cutoff),
	  halo_(haloBlocks(options.cutoff))
{
	const int perEdge = store.blocksPerEdge();
	side_ = perEdge + 2 * halo_;
	blocks_.assign(std::size_t(side_) * std::size_t(side_), nullptr);
	if (compacts_)
	{
		patches_.resize(blocks_.size());
		looked_.assign(blocks_.size(), false);
	}
	else
		views_.reserve(blocks_.size());
	// The halo is narrower than a tile: the nine tiles around cover it.
	for (int ty = -1; ty <= 1; ty++)
		for (int tx = -1; tx <= 1; tx++)
		{
			const Tile* tile = store.find({key.x + tx, key.y + ty});
			if (!tile) continue;
			const int x0 = std::max(-halo_, tx * perEdge), x1 = std::min(perEdge + halo_, (tx + 1) * perEdge);
			const int y0 = std::max(-halo_, ty * perEdge), y1 = std::min(perEdge + halo_, (ty + 1) * perEdge);
			for (int by = y0; by < y1; by++)
				for (int bx = x0; bx < x1; bx++)
				{
					const Block& b = tile->blocks[std::size_t((by - ty * perEdge) * perEdge + bx - tx * perEdge)];
					if (b.nodes.empty() && b.cells.empty()) continue;
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

KernelSums TileField::sampleNodes(Vec2 p) const
{
	work_.evaluations++;
	const double u = p.x * nodesPerSigma, v = p.y * nodesPerSigma;
	const double column = std::floor(u), row = std::floor(v);
	const int bx = int(floorDiv(std::int64_t(column), nodesPerBlock)),
			  by = int(floorDiv(std::int64_t(row), nodesPerBlock));
	const int lx = int(column) - bx * nodesPerBlock, ly = int(row) - by * nodesPerBlock;
	// The blocks of the taps.
	look({bx - (lx < NodePatch::before), bx + (lx + NodePatch::after >= nodesPerBlock)},
		 {by - (ly < NodePatch::before), by + (ly + NodePatch::after >= nodesPerBlock)});
	const float* nodes = patch(bx, by);
	if (!nodes) return {};
	return interpolateNodes(nodes + ly * NodePatch::stride + lx, float(u - column), float(v - row));
}

const float* TileField::patch(int bx, int by) const
{
	const std::size_t index = std::size_t((by + halo_) * side_ + bx + halo_);
	if (!looked_[index])
	{
		looked_[index] = true;
		bool any = false;
		for (int y = by - 1; y <= by + 1; y++)
			for (int x = bx - 1; x <= bx + 1; x++) any = any || (block(x, y) && !block(x, y)->nodes.empty());
		if (any)
		{
			patches_[index].reset(new float[NodePatch::size]);
			copyNodes(bx, by, patches_[index].get());
		}
	}
	return patches_[index].get();
}

void TileField::copyNodes(int bx, int by, float* patch) const
{
	const int n = nodesPerBlock, last = n + NodePatch::after;
	for (int y = by - 1; y <= by + 1; y++)
		for (int x = bx - 1; x <= bx + 1; x++)
		{
			const Block* b = block(x, y);
			const int x0 = std::max(-NodePatch::before, (x - bx) * n), x1 = std::min(last, (x - bx + 1) * n);
			const int y0 = std::max(-NodePatch::before, (y - by) * n), y1 = std::min(last, (y - by + 1) * n);
			for (int row = y0; row < y1; row++)
			{
				float* to = patch + (row + NodePatch::before) * NodePatch::stride + NodePatch::before;
				if (!b || b->nodes.empty())
				{
					std::fill(to + x0, to + x1, 0.0f);
					continue;
				}
				const std::int64_t* from = b->nodes.data() + (row - (y - by) * n) * n - (x - bx) * n;
				for (int column = x0; column < x1; column++)
					to[column] = float(double(from[column]) * (1 / nodesPerKernel));
			}
		}
}

KernelSums TileField::sampleKernels(Vec2 p) const
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
			const KernelList& k = b->kernels;
			const float ox = std::max(0.0f, std::max(k.minX - dx, dx - k.maxX));
			const float oy = std::max(0.0f, std::max(k.minY - dy, dy - k.maxY));
			if (ox * ox + oy * oy > reach * reach) continue;
			views_.push_back({k.groups.data(), k.groups.size(), dx, dy});
			work_.kernels += k.count;
		}
	work_.evaluations++;
	return sumKernels(views_.data(), views_.size());
}

KernelSums sumOfCells(TileStore& store, const Options& options, Vec2 p)
{
	const CellGrid grid(options);
	const double block = double(Frame::blockEdge);
	const auto index = [&](double v) { return std::int64_t(std::floor(v / block)); };
	const int n = store.blocksPerEdge();
	std::vector<BlockView> views;
	for (std::int64_t by = index(p.y - options.cutoff); by <= index(p.y + options.cutoff); by++)
		for (std::int64_t bx = index(p.x - options.cutoff); bx <= index(p.x + options.cutoff); bx++)
		{
			const TileKey key = store.tileOfBlock(bx, by);
			Tile* tile = store.find(key);
			if (!tile) continue;
			Block& b = tile->blocks[std::size_t((by - std::int64_t(key.y) * n) * n + bx - std::int64_t(key.x) * n)];
			b.makeKernels(grid);
			views.push_back({b.kernels.groups.data(), b.kernels.groups.size(), float(p.x - (double(bx) + 0.5) * block),
							 float(p.y - (double(by) + 0.5) * block)});
		}
	return sumKernels(views.data(), views.size());
}

}  // namespace ridgemap
