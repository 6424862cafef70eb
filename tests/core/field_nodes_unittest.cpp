// SPDX-License-Identifier: BSD-3-Clause
// The occupancy at nodes and between them: against the sum over all cells, one variant against another, and what is
// taken away against what was added.
#include "field_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iostream>
#include <map>

#include "field.h"
#include "kernel_sum_impl.h"
#include "lattice.h"
#include "random.h"
#include "scenes.h"

namespace ridgemap
{
#ifdef RIDGEMAP_HAVE_AVX2_UNIT
void copyNodesAvx2(const std::int64_t* nodes, float* to, int stride);
void makeProfileAvx2(const KernelShape& shape, const KernelReach& reach, KernelProfile& profile);
void addChangesAvx2(const NodeChanges& to, Magnitude magnitude, const KernelReach& reach, const KernelProfile* after,
					const KernelProfile* before);
bool areChangedAvx2(const NodeChanges& changes, bool wide);
bool applyChangesAvx2(const NodeChanges& changes, bool wide, std::int64_t* nodes);
void interpolateNodesAvx2(const NodeSquare* squares, std::size_t count, int stride, float tx, float ty);
#endif
}  // namespace ridgemap

namespace ridgemap::test
{
namespace
{
using Nodes = std::vector<std::int64_t>;
/** Nodes of the blocks around that of the cells. */
using BlockNodes = std::map<std::pair<int, int>, Nodes>;
constexpr std::size_t nodeCount = std::size_t(nodesPerBlock * nodesPerBlock);

/** What spreading asks for nodes. */
auto nodesIn(BlockNodes& blocks)
{
	return [&](int bx, int by) -> Nodes& {
		return blocks[{bx, by}];
	};
}

CellSums sumOf(const CellSums& a, const CellSums& b)
{
	return {a.n + b.n, a.sx + b.sx, a.sy + b.sy, a.sxx + b.sxx, a.sxy + b.sxy, a.syy + b.syy};
}

/** The sums of so many measurements in the same places. */
CellSums times(std::int64_t k, const CellSums& s)
{
	return {std::uint32_t(k * s.n), k * s.sx, k * s.sy, k * s.sxx, k * s.sxy, k * s.syy};
}

CellSums randomMeasurement(Random& random, const CellGrid& grid, CellKey key)
{
	const auto place = [&](std::int64_t index)
	{ return index * grid.edge() + std::int64_t(random.below(std::size_t(grid.edge()))); };
	const std::int64_t u = place(cellColumn(key));
	return grid.single({u, place(cellRow(key))});
}

/** A cell somewhere in its block with some measurements. */
Cell randomCell(Random& random, const CellGrid& grid)
{
	const std::int64_t side = grid.cellsPerBlock();
	Cell cell;
	const auto column = std::int64_t(random.below(std::size_t(side))),
			   row = std::int64_t(random.below(std::size_t(side)));
	cell.key = makeCellKey(0, column, row);
	for (std::size_t n = 1 + random.below(5); n > 0; n--)
		cell.sums = sumOf(cell.sums, randomMeasurement(random, grid, cell.key));
	return cell;
}

std::array<double, 10> jet(const KernelSums& s)
{
	return {s.value, s.gx, s.gy, s.hxx, s.hxy, s.hyy, s.txxx, s.txxy, s.txyy, s.tyyy};
}
}  // namespace

TEST(FieldNodes, HoldTheSumOfTheKernels)
{
	for (const double edge : {1.0, 0.5, 0.25, 0.125})
	{
		Options o;
		o.cell = edge;
		const CellGrid grid(o);
		const KernelSpreader spreader(grid, o.cutoff);
		Random random(std::uint64_t(8 / edge));
		for (int trial = 0; trial < 50; trial++)
		{
			const Cell cell = randomCell(random, grid);
			std::map<std::pair<int, int>, Nodes> blocks;
			const auto nodesOf = [&](int bx, int by) -> Nodes&
			{
				EXPECT_LE(std::max(std::abs(bx), std::abs(by)), spreader.reach());
				return blocks[{bx, by}];
			};
			SpreadScratch scratch;
			spreader.spread(cell.key, {}, cell.sums, scratch, nodesOf);
			spreader.finish(scratch, nodesOf);
			const CellMoments m = momentsOf(cell, grid);
			for (int trialNode = 0; trialNode < 200; trialNode++)
			{
				const int i = int(random.below(60)) - 22, j = int(random.below(60)) - 22;
				const int bx = int(floorDiv(i, nodesPerBlock)), by = int(floorDiv(j, nodesPerBlock));
				const auto block = blocks.find({bx, by});
				const std::int64_t value =
					block == blocks.end() || block->second.empty()
						? 0
						: block->second[std::size_t((j - by * nodesPerBlock) * nodesPerBlock + i - bx * nodesPerBlock)];
				const double dx = 0.25 * i - 2 - m.mean.x, dy = 0.25 * j - 2 - m.mean.y;
				// A normal density with the cell's covariance added.
				const double vx = 1 + m.xx, vy = 1 + m.yy, det = vx * vy - m.xy * m.xy;
				const double truth =
					m.n / std::sqrt(det) * std::exp(-0.5 * (vy * dx * dx - 2 * m.xy * dx * dy + vx * dy * dy) / det);
				const double tilt = m.n * m.xy * m.xy;  // covariance enters to first order
				const double cut = dx * dx + dy * dy > o.cutoff * o.cutoff ? m.n * 4e-6 : 0;
				EXPECT_NEAR(double(value) / nodesPerKernel, truth, 1e-6 + tilt + cut) << "edge " << edge;
			}
		}
	}
}

TEST(FieldNodes, TakeAwayExactlyWhatTheyAddedHoweverMuchThatIs)
{
	const CellGrid grid{Options()};
	const KernelSpreader spreader(grid, 5);
	Random random(2);
	BlockNodes blocks, direct;
	SpreadScratch scratch;
	const auto nodesOf = nodesIn(blocks);
	const auto directNodes = nodesIn(direct);
	std::map<CellKey, CellSums> cells;
	for (int i = 0; i < 60; i++)
	{
		const Cell c = randomCell(random, grid);
		cells[c.key] = c.sums;
	}
	// Step by step to counts beyond what 32 bits hold, and at once: small and large counts meet in the same nodes.
	std::map<CellKey, CellSums> now;
	for (int step = 0; step < 10; step++)
	{
		for (const auto& [key, s] : cells)
		{
			if (random.below(3) == 0) continue;
			const std::int64_t k = std::int64_t(1) << random.below(29);
			const CellSums next = times(k, s);
			spreader.spread(key, now[key], next, scratch, nodesOf);
			now[key] = next;
		}
		spreader.finish(scratch, nodesOf);
	}
	for (const auto& [key, s] : now)
	{
		spreader.spread(key, {}, s, scratch, directNodes);
		spreader.finish(scratch, directNodes);
	}
	const auto withoutEmpty = [](BlockNodes& m)
	{
		for (auto it = m.begin(); it != m.end();) it = it->second.empty() ? m.erase(it) : std::next(it);
	};
	withoutEmpty(blocks);
	withoutEmpty(direct);
	EXPECT_EQ(blocks, direct);
	EXPECT_GT(*std::max_element(blocks[{0, 0}].begin(), blocks[{0, 0}].end()), std::int64_t(1) << 40);
	for (const auto& [key, s] : now) spreader.spread(key, s, {}, scratch, nodesOf);
	spreader.finish(scratch, nodesOf);
	withoutEmpty(blocks);
	EXPECT_TRUE(blocks.empty());
}

TEST(FieldNodes, ASmallChangeOfALargeCountIsExact)
{
	const CellGrid grid{Options()};
	const KernelSpreader spreader(grid, 5);
	Random random(3);
	BlockNodes blocks, direct;
	SpreadScratch scratch;
	for (int i = 0; i < 20; i++)
	{
		const Cell c = randomCell(random, grid);
		const auto nodesOf = nodesIn(blocks);
		const auto directNodes = nodesIn(direct);
		const std::int64_t many = (1 << 20) + i;
		for (const auto& [before, after] : {std::pair<std::int64_t, std::int64_t>{0, many}, {many, many - 1}})
		{
			spreader.spread(c.key, before ? times(before, c.sums) : CellSums{}, times(after, c.sums), scratch, nodesOf);
			spreader.finish(scratch, nodesOf);
		}
		spreader.spread(c.key, {}, times(many - 1, c.sums), scratch, directNodes);
		spreader.finish(scratch, directNodes);
	}
	EXPECT_FALSE(direct.empty());
	EXPECT_EQ(blocks, direct);
}

TEST(FieldNodes, ManySmallChangesOfLargeCountsAddUpExactly)
{
	const CellGrid grid{Options()};
	const KernelSpreader spreader(grid, 5);
	Random random(5);
	for (const std::int64_t many : {100, 400, 10000, 100000000})
	{
		BlockNodes blocks, direct;
		SpreadScratch scratch;
		const auto nodesOf = nodesIn(blocks);
		const auto directNodes = nodesIn(direct);
		std::map<CellKey, CellSums> cells;
		for (int i = 0; i < 20; i++)
		{
			const Cell c = randomCell(random, grid);
			cells[c.key] = times(many, c.sums);
		}
		for (const auto& [key, sums] : cells) spreader.spread(key, {}, sums, scratch, nodesOf);
		spreader.finish(scratch, nodesOf);
		for (int i = 0; i < 2000; i++)
		{
			auto& [key, sums] = *std::next(cells.begin(), std::ptrdiff_t(random.below(cells.size())));
			const CellSums next = sumOf(sums, randomMeasurement(random, grid, key));
			spreader.spread(key, sums, next, scratch, nodesOf);
			sums = next;
		}
		spreader.finish(scratch, nodesOf);
		for (const auto& [key, sums] : cells)
		{
			spreader.spread(key, {}, sums, scratch, directNodes);
			spreader.finish(scratch, directNodes);
		}
		EXPECT_FALSE(direct.empty());
		EXPECT_EQ(blocks, direct) << "cells of " << many;
	}
}

TEST(FieldNodes, InterpolationAgreesWithTheSumOfAllCells)
{
	std::array<double, 4> worst{};
	constexpr std::array<std::size_t, 10> orderOf{0, 1, 1, 2, 2, 2, 3, 3, 3, 3};
	for (std::uint64_t seed = 500; seed < 510; seed++)
	{
		const RandomScene scene = randomScene(seed, 2);
		Options o = scene.options();
		o.cutoff = 8;  // so that only the interpolation is seen
		Lattice lattice(o);
		lattice.insert(scene.measurements);
		lattice.refresh();
		Random random(seed);
		for (int trial = 0; trial < 300; trial++)
		{
			const Measurement& m = scene.measurements[random.below(scene.measurements.size())];
			Vec2 p = lattice.frame().toLattice({m.x, m.y});
			p = p + 2 * Vec2{random.normal(), random.normal()};
			p = {std::round(p.x * 1024) / 1024, std::round(p.y * 1024) / 1024};
			const double edge = lattice.tiles().tileEdge();
			const TileKey key{std::int32_t(std::floor(p.x / edge)), std::int32_t(std::floor(p.y / edge))};
			const Vec2 corner{key.x * edge, key.y * edge};
			const auto truth = jet(sumOfCells(lattice.tiles(), o, p));
			const auto got = jet(TileField(lattice.tiles(), key, o).sample(p - corner));
			// The scale of the derivatives grows with the distance from where the measurements are.
			double scale = 0;
			for (double dx = -1; dx <= 1; dx++)
				for (double dy = -1; dy <= 1; dy++)
					scale = std::max(scale, sumOfCells(lattice.tiles(), o, p + Vec2{dx, dy}).value);
			if (scale < 0.5) continue;
			for (std::size_t i = 0; i < truth.size(); i++)
				worst[orderOf[i]] = std::max(worst[orderOf[i]], std::abs(got[i] - truth[i]) / scale);
		}
	}
	std::cout << "seeds 500-509: relative errors of interpolation " << worst[0] << ", " << worst[1] << ", " << worst[2]
			  << ", " << worst[3] << "\n";
	EXPECT_LT(worst[0], 5e-5);
	EXPECT_LT(worst[1], 1e-4);
	EXPECT_LT(worst[2], 1e-3);
	EXPECT_LT(worst[3], 1e-2);
}

TEST(FieldNodes, TheSamePointHasTheSameBitsInEveryTile)
{
	const RandomScene scene = randomScene(520, 3);
	Options o = scene.options();
	Lattice lattice(o);
	lattice.insert(scene.measurements);
	lattice.refresh();
	Random random(3);
	int compared = 0;
	for (const TileKey key : lattice.tiles().keys())
	{
		const double edge = lattice.tiles().tileEdge();
		const TileField here(lattice.tiles(), key, o), right(lattice.tiles(), {key.x + 1, key.y}, o);
		for (int i = 0; i < 20; i++)
		{
			const Vec2 p{edge + std::round(1024 * random.uniform(-2.9, 2.9)) / 1024, random.uniform(0, edge)};
			const KernelSums a = here.sample(p), b = right.sample({p.x - edge, p.y});
			ASSERT_EQ(std::memcmp(&a, &b, sizeof a), 0);
			compared += a.value > 0.1;
		}
	}
	EXPECT_GT(compared, 100);
}

TEST(FieldNodes, EveryVariantGivesTheSameBits)
{
#ifdef RIDGEMAP_HAVE_AVX2_UNIT
	if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has no AVX2";
	Random random(4);
	for (int trial = 0; trial < 500; trial++)
	{
		KernelReach reach;
		reach.rows = 1 + int(random.below(KernelProfile::capacity));
		reach.columns = KernelProfile::capacity;
		for (int j = 0; j < reach.rows; j++)
		{
			reach.first[j] = 8 * int(random.below(5));
			reach.last[j] = reach.first[j] + 8 * int(random.below(5));
		}
		KernelProfile before[2], after[2];
		const auto shape = [&](double largest)
		{
			return KernelShape{float(random.uniform(-6, -4)),    float(random.uniform(-6, -4)),
							   float(random.uniform(1, 1.1)),    float(random.uniform(1, 1.1)),
							   float(random.uniform(-0.1, 0.1)), float(random.uniform(0, largest))};
		};
		const auto magnitude = Magnitude(trial % 3);
		const bool wide = magnitude == Magnitude::large;
		const KernelShape was = shape(magnitude == Magnitude::small ? 1e8 : 1e15);
		KernelShape is = shape(wide ? 1e15 : 1e8);
		if (magnitude == Magnitude::smallDifference)
		{
			is = was;
			is.weight += float(random.uniform(-1e8, 1e8));
		}
		makeProfileImpl(was, reach, before[0]);
		makeProfileAvx2(was, reach, before[1]);
		makeProfileImpl(is, reach, after[0]);
		makeProfileAvx2(is, reach, after[1]);
		for (int i = 0; i < reach.columns; i++) ASSERT_EQ(after[0].dx[i], after[1].dx[i]);
		for (int j = 0; j < reach.rows; j++) ASSERT_EQ(after[0].dy[j], after[1].dy[j]);
		constexpr std::size_t size = std::size_t(KernelProfile::capacity * KernelProfile::capacity);
		std::vector<std::int32_t> low[3], high[3];
		NodeChanges to[3];
		for (int v = 0; v < 3; v++)
		{
			low[v].assign(size, 3);
			high[v].assign(size, 0);
			to[v] = {low[v].data(), high[v].data(), KernelProfile::capacity};
		}
		const bool both = magnitude == Magnitude::smallDifference, plus = both || trial % 4 != 0,
				   minus = both || trial % 5 != 0;
		addChangesImpl(to[0], magnitude, reach, plus ? &after[0] : nullptr, minus ? &before[0] : nullptr);
		addChangesAvx2(to[1], magnitude, reach, plus ? &after[1] : nullptr, minus ? &before[1] : nullptr);
		addChangesAvx2(to[2], Magnitude::large, reach, plus ? &after[1] : nullptr, minus ? &before[1] : nullptr);
		ASSERT_EQ(low[0], low[1]);
		ASSERT_EQ(high[0], high[1]);
		for (std::size_t i = 0; i < size; i++)
			ASSERT_EQ(low[0][i] + std::int64_t(high[0][i]) * (1 << 21),
					  low[2][i] + std::int64_t(high[2][i]) * (1 << 21));
		Nodes a(nodeCount, 7), b(nodeCount, 7);
		ASSERT_EQ(areChangedImpl(to[0], wide), areChangedAvx2(to[1], wide));
		ASSERT_EQ(applyChangesImpl(to[0], wide, a.data()), applyChangesAvx2(to[1], wide, b.data()));
		ASSERT_EQ(a, b);
		ASSERT_EQ(low[0], low[1]);
		ASSERT_FALSE(areChangedImpl(to[0], wide));
		const int stride = nodesPerBlock + int(random.below(20));
		std::vector<float> patch(std::size_t(nodesPerBlock * stride)), copy = patch;
		for (std::int64_t& v : a) v = std::int64_t(random.uniform(-1, 1) * std::pow(2.0, random.uniform(0, 63)));
		copyNodesImpl(a.data(), patch.data(), stride);
		copyNodesAvx2(a.data(), copy.data(), stride);
		ASSERT_EQ(patch, copy);
		for (int i = 0; i < nodesPerBlock * nodesPerBlock; i++)
			ASSERT_EQ(patch[std::size_t(i / nodesPerBlock * stride + i % nodesPerBlock)],
					  float(double(a[std::size_t(i)]) / nodesPerKernel));
		for (float& v : patch) v = float(random.uniform(0, 1000));
		const float tx = float(random.uniform()), ty = float(random.uniform());
		KernelSums sums[3];
		const NodeSquare portable[] = {{patch.data(), &sums[0]}},
						 two[] = {{patch.data() + 3, &sums[1]}, {patch.data(), &sums[2]}};
		interpolateNodesImpl(portable, 1, stride, tx, ty);
		interpolateNodesAvx2(two, 2, stride, tx, ty);
		ASSERT_EQ(std::memcmp(&sums[0], &sums[2], sizeof sums[0]), 0);
		ASSERT_NE(std::memcmp(&sums[1], &sums[2], sizeof sums[0]), 0);
	}
#else
	GTEST_SKIP() << "there is only the portable variant here";
#endif
}

TEST(FieldNodes, AreFreedWhenTheyAreZeroAgain)
{
	const RandomScene scene = randomScene(521, 2);
	Lattice lattice{Options()};
	lattice.insert(scene.measurements);
	lattice.refresh();
	lattice.erase(scene.measurements);
	lattice.refresh();
	for (const TileKey key : lattice.tiles().keys())
		for (const Block& b : lattice.tiles().find(key)->blocks) EXPECT_TRUE(b.layers.empty() && b.cells.empty());
}

TEST(FieldNodes, AreMadeOnSeveralThreadsToTheSameBits)
{
	// With the smallest tiles and the largest cut-off, kernels reach farthest into the tiles around.
	for (const double tileEdge : {12.0, 16.0})
		for (const double cutoff : {5.0, 8.0})
		{
			Options o;
			o.tileEdge = tileEdge;
			o.cutoff = cutoff;
			Random random(7);
			std::vector<Measurement> first(3000), second(3000);
			for (auto* list : {&first, &second})
				for (Measurement& m : *list)
				{
					m.x = random.uniform(-4, 4);
					m.y = random.uniform(-4, 4);
				}
			Lattice alone(o), shared(o);
			for (Lattice* lattice : {&alone, &shared})
			{
				const unsigned threads = lattice == &shared ? 3 : 1;
				lattice->insert(first);
				lattice->refresh(threads);
				lattice->erase(first);
				lattice->insert(second);
				lattice->refresh(threads);
			}
			const std::vector<TileKey> keys = alone.tiles().keys();
			ASSERT_EQ(keys, shared.tiles().keys());
			ASSERT_GT(keys.size(), 50u);
			for (const TileKey& key : keys)
			{
				const auto &a = alone.tiles().find(key)->blocks, &b = shared.tiles().find(key)->blocks;
				for (std::size_t i = 0; i < a.size(); i++)
				{
					ASSERT_EQ(a[i].layers.size(), b[i].layers.size());
					for (std::size_t l = 0; l < a[i].layers.size(); l++)
						ASSERT_EQ(a[i].layers[l].nodes, b[i].layers[l].nodes);
				}
			}
		}
}

}  // namespace ridgemap::test
