// SPDX-License-Identifier: BSD-3-Clause
// Lines are cut where more rays passed through them than ended at them.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <cmath>

#include "free_cut.h"
#include "polylines.h"
#include "random.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
/** A straight line along x with a vertex every 0.1 m and the same density everywhere. */
Polyline lineAt(double y, double fromX, double toX, double occupancy)
{
	Polyline line;
	const int n = int(std::lround((toX - fromX) / 0.1));
	for (int i = 0; i <= n; i++)
	{
		line.points.push_back({fromX + (toX - fromX) * i / n, y});
		line.info.push_back(VertexInfo{float(occupancy), 0.9f, 0.01f, {}, {}});
	}
	return line;
}

/** Rays in steps of `spacing` along x, from y = -2 to y = 2, leaning by `lean` in x. */
std::vector<FreeRay> curtain(double fromX, double toX, double spacing, double lean = 0)
{
	std::vector<FreeRay> rays;
	for (double x = fromX; x <= toX; x += spacing) rays.push_back({x - lean, -2, x + lean, 2});
	return rays;
}
}  // namespace

TEST(FreeCut, StaysWhereHitsOutweighPasses)
{
	const Options options;
	const double spacing = 0.004;
	for (const double lean : {0.0, 1.0, 2.0})
	{
		FreeSpace space(options);
		space.insert(curtain(-4, 4, spacing, lean));
		const double passes = passesAcross(space, space.frame().toLattice({0, 0}), Frame::rotateToLattice({1, 0}));
		// In closed form: the rays that fall on a cell of 2 sigma as it lies to them, times cos^2.
		const Vec2 d = unit(Frame::rotateToLattice({lean, 2}));
		const double width = 2 * options.sigma * (std::abs(d.x) + std::abs(d.y));
		const double cosine = 2 / std::sqrt(lean * lean + 4);
		EXPECT_NEAR(passes, cosine * cosine * width / (spacing * cosine), 0.03 * passes) << lean;
		for (const double share : {0.9, 1.1})
		{
			std::vector<Polyline> removed;
			const auto kept = cutFree({lineAt(0, -1, 1, share * passes)}, space, options, &removed);
			EXPECT_EQ(kept.size(), share > 1 ? 1u : 0u) << lean;
			EXPECT_EQ(removed.size(), share > 1 ? 0u : 1u) << lean;
		}
	}
}

TEST(FreeCut, TheDensityIsInterpolatedBetweenVertices)
{
	const Options options;
	FreeSpace space(options);
	space.insert(curtain(-5, 5, 0.004));
	const double passes = passesAcross(space, space.frame().toLattice({0, 0}), Frame::rotateToLattice({1, 0}));
	// From twice the density that outweighs the passes down to hardly any: that much is left in the middle.
	Polyline line = lineAt(0, -4, 4, 2 * passes);
	line.points = {line.points.front(), line.points.back()};
	line.info = {line.info.front(), line.info.back()};
	line.info[1].occupancy = float(0.001 * passes);  // 0 would say that it is not known
	const auto kept = cutFree({line}, space, options);
	ASSERT_EQ(kept.size(), 1u);
	EXPECT_NEAR(kept[0].length(), 4, 10 * options.sigma);
}

TEST(FreeCut, PartsOfASingleSegmentAreSegments)
{
	const Options options;
	FreeSpace space(options);
	space.insert(curtain(-1, 1, 0.004));
	Polyline line = lineAt(0, -4, 4, 3);
	line.points = {line.points.front(), line.points.back()};
	line.info = {line.info.front(), line.info.back()};
	std::vector<Polyline> removed;
	const auto kept = cutFree({line}, space, options, &removed);
	ASSERT_EQ(kept.size(), 2u);
	ASSERT_EQ(removed.size(), 1u);
	for (const Polyline& part : {kept[0], kept[1], removed[0]}) EXPECT_EQ(part.points.size(), 2u);
	EXPECT_NEAR(kept[0].length(), 3, 5 * options.sigma);
	EXPECT_NEAR(kept[1].length(), 3, 5 * options.sigma);
	EXPECT_NEAR(removed[0].length(), 2, 5 * options.sigma);
}

TEST(FreeCut, TauIsTheShareOfHits)
{
	Options options;
	FreeSpace space(options);
	space.insert(curtain(-4, 4, 0.004));
	const double passes = passesAcross(space, space.frame().toLattice({0, 0}), Frame::rotateToLattice({1, 0}));
	for (const double tau : {0.0, 0.2, 0.5, 0.8})
	{
		options.freeSpaceTau = tau;
		const double least = passes * tau / (1 - tau);
		EXPECT_EQ(cutFree({lineAt(0, -1, 1, 1.1 * least + 0.001)}, space, options).size(), 1u);
		EXPECT_EQ(cutFree({lineAt(0, -1, 1, 0.9 * least + (tau > 0 ? 0 : 1e-9))}, space, options).size(),
				  tau > 0 ? 0u : 1u);
	}
}

TEST(FreeCut, FewOrGrazingRaysAreNoEvidence)
{
	const Options options;
	FreeSpace few(options), grazing(options);
	few.insert(curtain(-4, 4, 0.11));  // about one a cell
	EXPECT_EQ(cutFree({lineAt(0, -1, 1, 0.01)}, few, options).size(), 1u);
	for (int i = 0; i < 40; i++) grazing.insert(std::vector<FreeRay>{{-4, -0.02 + 0.001 * i, 4, -0.02 + 0.001 * i}});
	EXPECT_EQ(cutFree({lineAt(0, -1, 1, 3)}, grazing, options).size(), 1u);
	EXPECT_GT(grazing.interpolated(grazing.frame().toLattice({0, 0}))[0], 20);
}

TEST(FreeCut, CutsWhereTheRaysBegin)
{
	const Options options;
	FreeSpace space(options);
	space.insert(curtain(0.5, 1.5, 0.002));
	std::vector<Polyline> removed;
	const Polyline line = lineAt(0, -2, 3, 5);
	const auto kept = cutFree({line}, space, options, &removed);
	ASSERT_EQ(kept.size(), 2u);
	ASSERT_EQ(removed.size(), 1u);
	// Half of the window and of a cell are unsure.
	EXPECT_NEAR(removed[0].points.front().x, 0.5, 3 * options.sigma);
	EXPECT_NEAR(removed[0].points.back().x, 1.5, 3 * options.sigma);
	EXPECT_EQ(kept[0].points.back(), removed[0].points.front());
	EXPECT_EQ(kept[1].points.front(), removed[0].points.back());
	EXPECT_EQ(kept[0].endReason, StopReason::passedThrough);
	EXPECT_EQ(kept[0].startReason, line.startReason);
	EXPECT_NEAR(totalLength(kept) + totalLength(removed), line.length(), 1e-12);
	for (const VertexInfo& v : removed[0].info) EXPECT_NEAR(v.occupancy, 5, 1e-5);
}

TEST(FreeCut, AGapBelowTwoSigmaIsNotCut)
{
	Options options;
	options.freeSpaceWindow = 0;
	for (const bool narrow : {true, false})
	{
		FreeSpace space(options);
		const double half = (narrow ? 0.2 : 2) * options.sigma;
		space.insert(curtain(-half, half, 0.0005));
		// As strong as what a narrow beam leaves beside itself.
		const double passes = passesAcross(space, space.frame().toLattice({0, 0}), Frame::rotateToLattice({1, 0}));
		const auto kept = cutFree({lineAt(0, -2, 2, (narrow ? 0.95 : 0.5) * passes)}, space, options);
		EXPECT_EQ(kept.size(), narrow ? 1u : 2u);
	}
}

TEST(FreeCut, AWallIsNotShortenedWhereRaysPassBesideItsEnd)
{
	const Options options;
	const Polyline line = lineAt(0, -2, 2, 5);
	for (const double beyond : {0.0, 1.25, 6.0})
	{
		FreeSpace space(options);
		// Rays through a door; cells and window carry them over the last stretch of the wall.
		const double from = 2 - beyond * options.sigma;
		space.insert(curtain(from, 4, 0.007));
		std::vector<Polyline> removed;
		const auto kept = cutFree({line}, space, options, &removed);
		ASSERT_EQ(kept.size(), 1u);
		if (beyond < 2)
			EXPECT_EQ(kept[0].points.back(), line.points.back());
		else
			EXPECT_NEAR(kept[0].points.back().x, from, 3 * options.sigma);
		EXPECT_EQ(removed.size(), beyond < 2 ? 0u : 1u);
		// What was led to another wall has no end of its own there.
		Polyline led = line;
		led.info.back().origin = VertexOrigin::junction;
		EXPECT_EQ(cutFree({led}, space, options)[0].points.back() == line.points.back(), beyond < 1);
	}
}

TEST(FreeCut, AClosedLineHasNoBeginning)
{
	Options options;
	FreeSpace space(options);
	std::vector<FreeRay> rays;
	for (double x = -0.3; x < 0.5; x += 0.003) rays.push_back({x, 0, x, 3});
	space.insert(rays);
	std::vector<double> lengths;
	const int n = 180;
	for (const int turn : {0, 17, 45, 90, 133})
	{
		Polyline ring;
		ring.closed = true;
		for (int i = 0; i <= n; i++)
		{
			const double angle = 2 * 3.14159265358979323846 * ((i + turn) % n) / n;
			ring.points.push_back({std::cos(angle), std::sin(angle)});
			ring.info.push_back(VertexInfo{5, 0.9f, 0.01f, {}, {}});
		}
		std::vector<Polyline> removed;
		const auto kept = cutFree({ring}, space, options, &removed);
		ASSERT_EQ(kept.size(), 1u) << turn;
		ASSERT_EQ(removed.size(), 1u) << turn;
		EXPECT_FALSE(kept[0].closed);
		EXPECT_NEAR(kept[0].length() + removed[0].length(), ring.length(), 1e-9);
		EXPECT_NEAR(kept[0].length(), lengths.empty() ? kept[0].length() : lengths.front(), 2 * options.sigma);
		lengths.push_back(kept[0].length());
		EXPECT_NEAR(kept[0].points.back().x, removed[0].points.front().x, 1e-9);
		EXPECT_NEAR(kept[0].points.back().y, removed[0].points.front().y, 1e-9);
	}
	EXPECT_LT(lengths.front(), 2 * 3.1416 - 0.8);
}

}  // namespace ridgemap::test
