// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ridgemap/point_to_line_matching.h>

#include <cmath>
#include <limits>
#include <random>

using namespace ridgemap;

namespace
{
constexpr double degree = 0.017453292519943295;

Polyline line(const Point2& a, const Point2& b, int parts = 50)
{
	Polyline p;
	for (int i = 0; i <= parts; i++) p.points.push_back({a.x + (b.x - a.x) * i / parts, a.y + (b.y - a.y) * i / parts});
	return p;
}

/** An L of two walls with a stub, no symmetry. */
std::vector<Polyline> corner()
{
	return {line({-3, -2}, {4, -2}), line({4, -2}, {4, 3}), line({0, 1}, {1, 1.5}, 10)};
}

/** Points on the walls, seen from a pose. */
std::vector<Point2> seenFrom(const std::vector<Polyline>& walls, const PlanarPose& pose)
{
	std::vector<Point2> points;
	const double c = std::cos(pose.phi), s = std::sin(pose.phi);
	for (const auto& wall : walls)
		for (std::size_t i = 1; i < wall.points.size(); i++)
		{
			const double x = (wall.points[i].x + 2 * wall.points[i - 1].x) / 3 - pose.x;
			const double y = (wall.points[i].y + 2 * wall.points[i - 1].y) / 3 - pose.y;
			points.push_back({c * x + s * y, -s * x + c * y});
		}
	return points;
}
}  // namespace

TEST(PointToLine, FindsTheExactPose)
{
	const auto walls = corner();
	const MatchingTargets targets(walls, {}, {});
	const PlanarPose truth{0.3, -0.4, 0.2};
	const auto points = seenFrom(walls, truth);
	std::mt19937 random(3);
	std::uniform_real_distribution<double> unit(-1, 1);
	for (int i = 0; i < 50; i++)
	{
		const PlanarPose start{truth.x + 0.2 * unit(random), truth.y + 0.2 * unit(random),
							   truth.phi + 5 * degree * unit(random)};
		const Alignment found = alignToLines(targets, points, start, {1, 0.1, 2, {start.x, start.y}}, {});
		EXPECT_TRUE(found.converged);
		EXPECT_NEAR(found.pose.x, truth.x, 1e-6);
		EXPECT_NEAR(found.pose.y, truth.y, 1e-6);
		EXPECT_NEAR(found.pose.phi, truth.phi, 1e-6);
	}
}

TEST(PointToLine, SeveralStartsBringBackALostHeading)
{
	const auto walls = corner();
	const MatchingTargets targets(walls, {}, {});
	const PlanarPose truth{0.3, -0.4, 0.2};
	const auto points = seenFrom(walls, truth);
	TMatchingOptions options;
	options.yawStarts = 7;
	int alone = 0, several = 0;
	for (int turn = -60; turn <= 60; turn += 12)
	{
		const PlanarPose start{truth.x + 0.1, truth.y, truth.phi + turn * degree};
		const MatchingGate gate{1, 0.1, 2, {start.x, start.y}};
		const auto good = [&](const Alignment& a) { return std::abs(a.pose.phi - truth.phi) < 1e-4; };
		alone += good(alignToLines(targets, points, start, gate, options));
		several += good(alignFromSeveralStarts(targets, points, start, gate, options));
	}
	EXPECT_EQ(several, 11);
	EXPECT_LT(alone, 11);
}

TEST(PointToLine, ASearchFindsWhatNoStartLeadsTo)
{
	// A room with rows of chairs: turned and shifted, each point finds another chair.
	std::vector<Polyline> walls{line({-2.2, -1.5}, {2, -1.5}), line({2, -1.5}, {2, 1.7})};
	for (int i = 0; i < 5; i++)
		for (int k = 0; k < 3; k++)
			walls.push_back(line({0.7 * i - 1.5, 0.7 * k - 0.7}, {0.7 * i - 1.2, 0.75 * k - 0.7}, 12));
	const MatchingTargets targets(walls, {}, {});
	const PlanarPose truth{-0.3, 0.2, 0.1};
	const auto points = seenFrom(walls, truth);
	TMatchingOptions finished;
	finished.shiftStarts = 2;
	int alone = 0, searched = 0, all = 0;
	for (int way = 0; way < 12; way++)
		for (const int turn : {-22, -11, 11, 22})
		{
			const PlanarPose start{truth.x + 0.4 * std::cos(30 * way * degree),
								   truth.y + 0.4 * std::sin(30 * way * degree), truth.phi + turn * degree};
			const MatchingGate gate{1, 0.17, 2, {start.x, start.y}};
			const auto good = [&](const Alignment& a)
			{ return std::hypot(a.pose.x - truth.x, a.pose.y - truth.y) < 1e-3; };
			alone += good(alignFromSeveralStarts(targets, points, start, gate, {}));
			searched += good(alignFromSeveralStarts(targets, points, start, gate, finished));
			all++;
		}
	EXPECT_EQ(searched, all);
	EXPECT_LT(alone, all);
}

TEST(PointToLine, PillarsDecideAlongAHallway)
{
	// Slid along by as much as two pillars are apart, half of them fit again, and all of the walls.
	std::vector<Polyline> walls{line({-8, 1}, {8, 1}, 160), line({-8, -1}, {8, -1}, 160)};
	for (const double x : {-6.0, -5.6, -3.1, -2.7, -0.9, 0.8, 1.2, 3.1, 3.5, 5.7})
		walls.push_back(line({x, 1}, {x, 0.9}, 3));
	const MatchingTargets targets(walls, {}, {});
	const PlanarPose truth{0.3, -0.1, 0.05};
	const auto points = seenFrom(walls, truth);
	TMatchingOptions finished;
	finished.slideReach = 0.6;
	int slid = 0, stayed = 0;
	for (const double off : {-0.5, -0.4, -0.3, 0.3, 0.4, 0.5})
	{
		const PlanarPose start{truth.x + off, truth.y + 0.05, truth.phi + 0.02};
		const MatchingGate gate{1, 0.17, 2, {start.x, start.y}};
		const auto good = [&](const Alignment& a) { return std::abs(a.pose.x - truth.x) < 1e-3; };
		slid += good(alignFromSeveralStarts(targets, points, start, gate, finished));
		stayed += good(alignFromSeveralStarts(targets, points, start, gate, {}));
	}
	EXPECT_EQ(slid, 6);
	EXPECT_LT(stayed, 6);
}

TEST(PointToLine, NarrowingGatesReachFartherThanOneNarrowGate)
{
	const auto walls = corner();
	const MatchingTargets targets(walls, {}, {});
	const PlanarPose truth{0.3, -0.4, 0.2}, start{0.75, -0.1, 0.25};
	const auto points = seenFrom(walls, truth);
	const auto error = [&](const Alignment& a) { return std::hypot(a.pose.x - truth.x, a.pose.y - truth.y); };
	EXPECT_GT(error(alignToLines(targets, points, start, {0.1, 0, 2, {}}, {})), 0.05);
	EXPECT_LT(error(alignNarrowing(targets, points, start, {1, 0.1, 2, {start.x, start.y}}, {})), 2e-3);
	const double inf = std::numeric_limits<double>::infinity();
	EXPECT_LT(error(alignNarrowing(targets, points, start, {inf, 0, 2, {}}, {})), 2e-3);
}

TEST(PointToLine, AmongEqualSolutionsTheNearestCounts)
{
	// A comb: moved by a tooth it looks the same, but for its end.
	std::vector<Polyline> comb{line({0, 0}, {8, 0})};
	for (int i = 0; i <= 16; i++) comb.push_back(line({0.5 * i, 0}, {0.5 * i, 0.3}, 6));
	const MatchingTargets targets(comb, {}, {});
	std::vector<Polyline> seen;
	for (int i = 6; i <= 10; i++) seen.push_back(line({0.5 * i, 0}, {0.5 * i, 0.3}, 6));
	seen.push_back(line({3, 0}, {5, 0}));
	const PlanarPose truth{4, 2, -1.5};
	const auto points = seenFrom(seen, truth);
	for (const double off : {-0.2, -0.1, 0.1, 0.2})
	{
		const PlanarPose start{truth.x + off, truth.y + 0.05, truth.phi};
		const Alignment found = alignFromSeveralStarts(targets, points, start, {1, 0.17, 2, {start.x, start.y}}, {});
		EXPECT_NEAR(found.pose.x, truth.x, 1e-3) << off;
		EXPECT_NEAR(found.pose.y, truth.y, 1e-3) << off;
	}
}

TEST(PointToLine, WhereLittleFitsOdometryDecides)
{
	// Two corners are known. One of them is seen from the start, and something new of the form of the other one, which
	// fits that one better when the robot turns and moves by half a metre.
	const std::vector<Polyline> known{line({3, -0.6}, {3, 0.6}, 12), line({3, 0.6}, {3.8, 0.9}, 8)};
	const std::vector<Polyline> other{line({-2, 1}, {-2, 2.4}, 14), line({-2, 2.4}, {-1, 2.8}, 10)};
	auto map = known;
	map.insert(map.end(), other.begin(), other.end());
	const MatchingTargets targets(map, {}, {});
	const PlanarPose start, wrong{0.4, -0.3, 9 * degree};
	auto points = seenFrom(known, start);
	const auto lookalike = seenFrom(other, wrong);
	points.insert(points.end(), lookalike.begin(), lookalike.end());
	for (int i = 0; i < 16; i++) points.push_back({-6 + 0.1 * i, -7});
	TMatchingOptions options;
	for (const double power : {0.0, options.startPower})
	{
		options.startPower = power;
		const auto found = alignFromSeveralStarts(targets, points, start, {1, 0.17, 2, {0, 0}}, options).pose;
		EXPECT_EQ(std::hypot(found.x, found.y) < 0.2, power > 0) << found.x << ' ' << found.y << ' ' << found.phi;
	}
}

TEST(PointToLine, DirectionsWithoutEvidenceStayAsTheyAre)
{
	const std::vector<Polyline> wall{line({-50, 0}, {50, 0}, 500)};
	const MatchingTargets targets(wall, {}, {});
	std::vector<Point2> points;
	for (int i = -20; i <= 20; i++) points.push_back({0.1 * i, 1});
	const Alignment found = alignToLines(targets, points, {3, -0.7, 0.05}, {1, 0, 2, {}}, {});
	EXPECT_NEAR(found.pose.x, 3, 0.05);
	EXPECT_NEAR(found.pose.y, -1, 1e-5);
	EXPECT_NEAR(found.pose.phi, 0, 1e-5);
}

TEST(PointToLine, FacesOfAThinWallAreToldApart)
{
	// Seen from the right. The line of the other face runs where the points are at the start.
	auto back = line({0, -2}, {0, 2}), front = line({0.12, -2}, {0.12, 2});
	back.side = 1;
	front.side = -1;
	const MatchingTargets targets({back, front, line({0.12, 2}, {4, 2.5})}, {}, {});
	const PlanarPose truth{2, 0, 0.1};
	const auto points = seenFrom({front, line({0.12, 2}, {2, 2.2423}, 10)}, truth);
	TMatchingOptions options;
	for (const bool sides : {false, true})
	{
		options.matchSides = sides;
		const Alignment found = alignToLines(targets, points, {1.89, 0, 0.1}, {0.1, 0, 2, {}}, options);
		EXPECT_EQ(std::abs(found.pose.x - truth.x) < 1e-3, sides) << found.pose.x;
	}
}

TEST(PointToLine, LoneMeasurementsAreTargetsOnlyFarFromPolylines)
{
	const std::vector<Polyline> wall{line({0, 0}, {1, 0})};
	TargetSettings settings;
	settings.loneDistance = 0.1;
	const MatchingTargets with(wall, {{0.5, 0.05}, {0.5, 0.5}, {2, 2}}, settings);
	const MatchingTargets without(wall, {{0.5, 0.05}, {0.5, 0.5}, {2, 2}}, {});
	EXPECT_EQ(with.points().size(), without.points().size() + 2);
	const auto lone = with.nearest({2.1, 2}, 1);
	ASSERT_TRUE(lone);
	EXPECT_TRUE(with.isLone(*lone));
	EXPECT_NEAR(lone->distanceSqr, 0.01, 1e-12);
	EXPECT_EQ(with.pointOf(*lone), with.points().size() - 1);
	EXPECT_FALSE(without.nearest({2.1, 2}, 1));
	EXPECT_FALSE(with.isLone(*with.nearest({0.5, 0.1}, 1)));
}

TEST(PointToLine, NothingToAlignWith)
{
	const MatchingTargets none({}, {}, {});
	const PlanarPose start{1, 2, 3};
	for (const auto& points : {std::vector<Point2>{}, std::vector<Point2>{{1, 1}, {std::nan(""), 0}}})
	{
		const Alignment found = alignFromSeveralStarts(none, points, start, {1, 0, 2, {}}, {});
		EXPECT_EQ(found.pose.x, 1);
		EXPECT_EQ(found.pose.y, 2);
		EXPECT_EQ(found.pose.phi, 3);
		EXPECT_FALSE(found.converged);
	}
}

TEST(AlignmentMemory, TellsTheNextCallFromAFirstOne)
{
	AlignmentMemory memory;
	EXPECT_FALSE(memory.goesOn({0, 0, 0}, 1));
	memory.remember({1, 2, 3}, 1);
	EXPECT_TRUE(memory.goesOn({1, 2, 3}, 1));
	EXPECT_TRUE(memory.goesOn({1, 2, 3 - 6.283185307179586}, 0.5));
	EXPECT_FALSE(memory.goesOn({1, 2, 3}, 2));
	EXPECT_FALSE(memory.goesOn({1.1, 2, 3}, 1));
	EXPECT_FALSE(AlignmentMemory(memory).goesOn({1, 2, 3}, 1));
}
