// SPDX-License-Identifier: BSD-3-Clause
#include "field.h"

#include <algorithm>
#include <limits>

namespace ridgemap
{
int TileField::haloBlocks(double cutoff)
{
	return int(std::ceil((margin + cutoff) / double(Frame::blockEdge)));
}

int TileField::haloOfNodes()
{
	return int(std::ceil((margin * nodesPerSigma + NodeTaps::after) / double(nodesPerBlock)));
}

TileField::TileField(const TileStore& store, TileKey key, const Options& options, FieldScratch* scratch)
	: compacts_(CellGrid(options).compacts()),
	  sided_(store.isSided()),
	  edge_(store.tileEdge()),
	  cutoff_(options.cutoff),
	  halo_(haloBlocks(options.cutoff)),
	  ownScratch_(scratch ? nullptr : std::make_unique<FieldScratch>()),
	  scratch_(scratch ? scratch : ownScratch_.get())
{
	const int perEdge = store.blocksPerEdge();
	side_ = perEdge + 2 * halo_;
	scratch_->blocks.assign(std::size_t(side_) * std::size_t(side_), nullptr);
	stride_ = side_ * nodesPerBlock + NodeTaps::count;  // rows that are a power of two apart share lines of the cache
	if (compacts_)
	{
		scratch_->bins.assign(scratch_->blocks.size(), 0);
		scratch_->planes.resize(sided_ ? directionBins : 1);
		for (FieldScratch::Plane& plane : scratch_->planes)
		{
			plane.nodes.resize(std::size_t(side_ * nodesPerBlock) * std::size_t(stride_));
			plane.hasCopied.assign(std::size_t(side_), 0);
		}
	}
	else
		scratch_->views.reserve(scratch_->blocks.size());
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
					if (b.layers.empty() && b.cells.empty()) continue;
					scratch_->blocks[index(bx, by)] = &b;
					for (const NodeLayer& l : b.layers) scratch_->bins[index(bx, by)] |= std::uint32_t(1) << l.bin;
					nonEmpty_++;
				}
		}
	reach_ = BlockMask(side_);
}

TileField::Range TileField::range(double coordinate, double radius) const
{
	const int first = roundDown((coordinate - radius) / double(Frame::blockEdge));
	const int last = roundDown((coordinate + radius) / double(Frame::blockEdge));
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

TileField::Taps TileField::tapsAt(Vec2 p) const
{
	const double u = p.x * nodesPerSigma, v = p.y * nodesPerSigma;
	const int column = roundDown(u), row = roundDown(v);
	// The first tap, counted from the corner of the halo.
	const int before = halo_ * nodesPerBlock - NodeTaps::before;
	const int i = column + before, j = row + before;
	Taps t{{i / nodesPerBlock - halo_, (i + NodeTaps::count - 1) / nodesPerBlock - halo_},
		   {j / nodesPerBlock - halo_, (j + NodeTaps::count - 1) / nodesPerBlock - halo_},
		   j * stride_ + i,
		   float(u - column),
		   float(v - row),
		   0};
	look(t.x, t.y);
	for (int by = t.y.first; by <= t.y.last; by++)
		for (int bx = t.x.first; bx <= t.x.last; bx++) t.bins |= scratch_->bins[index(bx, by)];
	return t;
}

KernelSums TileField::sample(Vec2 p) const
{
	if (!compacts_) return sampleKernels(p);
	if (sided_) return FieldPoint(*this, p).sum(SideWeights());
	const Taps t = tapsAt(p);
	KernelSums sum{};
	provideBins(t, t.bins, &sum);
	return sum;
}

double TileField::nearestNode(Vec2 p) const
{
	if (!compacts_) return std::numeric_limits<double>::infinity();
	const int column = roundDown(p.x * nodesPerSigma + 0.5) + halo_ * nodesPerBlock,
			  row = roundDown(p.y * nodesPerSigma + 0.5) + halo_ * nodesPerBlock;
	const int bx = column / nodesPerBlock - halo_, by = row / nodesPerBlock - halo_;
	look({bx, bx}, {by, by});
	const Block* b = block(bx, by);
	if (!b) return 0;
	std::int64_t sum = 0;
	for (const NodeLayer& layer : b->layers)
		if (!layer.nodes.empty())
			sum += layer.nodes.data()[row % nodesPerBlock * nodesPerBlock + column % nodesPerBlock];
	return double(sum) / nodesPerKernel;
}

void TileField::provideBins(const Taps& t, std::uint32_t mask, KernelSums* sums) const
{
	NodeSquare squares[directionBins];
	std::size_t count = 0;
	for (std::uint32_t bin = 0; mask >> bin != 0; bin++)
	{
		if (!(mask >> bin & 1)) continue;
		provideNodes(bin, t.x, t.y);
		squares[count++] = {scratch_->planes[bin].nodes.data() + t.corner, sums + bin};
	}
	if (count == 0) return;
	interpolateNodes(squares, count, stride_, t.tx, t.ty);
	work_.evaluations++;
}

std::uint32_t FieldPoint::provide(const double (&weights)[directionBins])
{
	std::uint32_t bins = 0;
	for (std::uint32_t bin = 0; bin < directionBins; bin++)
	{
		const bool weighs = weights[bin] != 0;  // GCC 12 with -fsanitize=undefined loses what is indexed within a shift
		bins |= std::uint32_t(weighs) << bin;
	}
	bins &= taps_.bins;
	const std::uint32_t missing = bins & ~known_;
	if (missing != 0) field_.provideBins(taps_, missing, sums_);
	known_ |= missing;
	return bins;
}

KernelSums FieldPoint::sum(const SideWeights& weights)
{
	const std::uint32_t bins = provide(weights.of);
	KernelSums sum{};
	for (std::uint32_t bin = 0; bins >> bin != 0; bin++)
		if (bins >> bin & 1) sum.add(sums_[bin], weights.of[bin]);
	return sum;
}

FieldTurn FieldPoint::turn(Vec2 normal)
{
	const Vec2 a = normal, b = leftNormal(normal);
	const SideSlopes slopes(normal);
	const std::uint32_t bins = provide(slopes.of);
	FieldTurn sum;
	for (std::uint32_t bin = 0; bins >> bin != 0; bin++)
		if (const KernelSums& s = sums_[bin]; bins >> bin & 1)
		{
			sum.slope += slopes.of[bin] * (s.gx * a.x + s.gy * a.y);
			sum.twist += slopes.of[bin] * (s.hxx * a.x * b.x + s.hxy * (a.x * b.y + a.y * b.x) + s.hyy * a.y * b.y);
		}
	return sum;
}

void TileField::provideNodes(std::uint32_t bin, Range x, Range y) const
{
	std::vector<std::uint32_t>& copied = scratch_->planes[bin].hasCopied;
	const std::uint32_t columns = BlockMask::columns(x.first + halo_, x.last + halo_);
	for (int by = y.first; by <= y.last; by++)
	{
		std::uint32_t& row = copied[std::size_t(by + halo_)];
		if ((row & columns) == columns) continue;
		for (int bx = x.first; bx <= x.last; bx++)
			if (!(row & BlockMask::columns(bx + halo_, bx + halo_))) copyBlock(bin, bx, by);
		row |= columns;
	}
}

void TileField::copyBlock(std::uint32_t bin, int bx, int by) const
{
	float* to =
		scratch_->planes[bin].nodes.data() + (by + halo_) * nodesPerBlock * stride_ + (bx + halo_) * nodesPerBlock;
	const Block* b = block(bx, by);
	if (const std::int64_t* nodes = b ? b->findNodes(bin) : nullptr) return copyNodes(nodes, to, stride_);
	for (int row = 0; row < nodesPerBlock; row++) std::fill_n(to + row * stride_, nodesPerBlock, 0.0f);
}

KernelSums TileField::sampleKernels(Vec2 p) const
{
	const Range x = range(p.x, cutoff_), y = range(p.y, cutoff_);
	const float reach = float(cutoff_);
	look(x, y);
	std::vector<BlockView>& views = scratch_->views;
	views.clear();
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
			views.push_back({k.groups.data(), k.groups.size(), dx, dy});
			work_.kernels += k.count;
		}
	work_.evaluations++;
	return sumKernels(views.data(), views.size());
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
			Tile* tile = store.own(key);  // the kernels are kept
			if (!tile) continue;
			Block& b = tile->blocks[std::size_t((by - std::int64_t(key.y) * n) * n + bx - std::int64_t(key.x) * n)];
			b.makeKernels(grid);
			views.push_back({b.kernels.groups.data(), b.kernels.groups.size(), float(p.x - (double(bx) + 0.5) * block),
							 float(p.y - (double(by) + 0.5) * block)});
		}
	return sumKernels(views.data(), views.size());
}

}  // namespace ridgemap
