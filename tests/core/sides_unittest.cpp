// SPDX-License-Identifier: BSD-3-Clause
// Densities per viewing side: against brute-force sums over the raw measurements, and what they are for: two faces.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>

#include "field.h"
#include "frame.h"
#include "lattice.h"
#include "polylines.h"
#include "random.h"
#include "ridge_point.h"
#include "viewing_direction.h"

namespace ridgemap::test
{
namespace
{
constexpr double pi = 3.14159265358979323846;

/** Measurements of the segment a-b [m], seen from sensors that lie 1 to 3 m away on its left, at up to 60 degrees. */
void addFace(std::vector<Measurement>& all, Random& random, Point2 a, Point2 b, double noise, double density)
{
	const Vec2 along{b.x - a.x, b.y - a.y}, normal = leftNormal(unit(along));
	for (int n = int(density * norm(along)); n > 0; n--)
	{
		const Vec2 p = Vec2{a.x, a.y} + random.uniform() * along;
		const double range = random.uniform(1, 3), tilt = random.uniform(-1, 1);
		const Vec2 sensor = p + range * normal + range * std::tan(tilt) * unit(along);
		// Range noise moves a return along its beam.
		const Vec2 q = p + noise * random.normal() * unit(sensor - p);
		all.push_back({q.x, q.y, sensor.x, sensor.y});
	}
}

/** A wall of the given thickness along the x axis, turned, with its two faces. */
std::vector<Measurement> thinWall(std::uint64_t seed, double thickness, double turn, double density = 1500)
{
	Random random(seed);
	std::vector<Measurement> all;
	const Vec2 x{std::cos(turn), std::sin(turn)}, y = leftNormal(x);
	const auto at = [&](double u, double v) { return Point2{u * x.x + v * y.x, u * x.y + v * y.y}; };
	addFace(all, random, at(0, thickness / 2), at(2, thickness / 2), 0.01, density);
	addFace(all, random, at(2, -thickness / 2), at(0, -thickness / 2), 0.01, density);
	return all;
}

/** The sided density at p for the normal n as a sum over all measurements, in double precision. Map frame, unit sigma.
 */
struct Sided
{
	double value = 0;
	Vec2 gradient;
	double xx = 0, xy = 0, yy = 0;

	Sided(const std::vector<Measurement>& measurements, double sigma, Vec2 p, Vec2 n)
	{
		const SideWeights weights(Frame::rotateToLattice(n));
		for (const Measurement& m : measurements)
		{
			const std::uint32_t bin = directionBin(Frame::rotateToLattice({m.sensorX - m.x, m.sensorY - m.y}));
			const Vec2 d = (1 / sigma) * (p - Vec2{m.x, m.y});
			const double e = weights.of[bin] * std::exp(-0.5 * dot(d, d));
			value += e;
			gradient = gradient - e * d;
			xx += e * (d.x * d.x - 1);
			xy += e * d.x * d.y;
			yy += e * (d.y * d.y - 1);
		}
	}
	/** Unit eigenvector of the smaller eigenvalue. */
	Vec2 v1() const
	{
		const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
		return {-std::sin(angle), std::cos(angle)};
	}
	double lambda1() const { return 0.5 * (xx + yy) - std::hypot(0.5 * (xx - yy), xy); }
};

/** Slope of the sided density at p along the normal that it has there itself, found by iteration from n. */
double slopeAcross(const std::vector<Measurement>& m, double sigma, Vec2 p, Vec2 n, bool& isRidge)
{
	for (int k = 0; k < 30; k++)
	{
		Vec2 v = Sided(m, sigma, p, n).v1();
		if (dot(v, n) < 0) v = -v;
		const bool same = std::abs(cross(v, n)) < 1e-7;
		n = v;
		if (same) break;
	}
	const Sided s(m, sigma, p, n);
	isRidge = isRidge && s.lambda1() < 0;
	return dot(s.gradient, n);
}

/** Distance [sigma] within which the density falls to both sides of p along n: a ridge passes there. 1 if it does not
 * do so within half a sigma. Where the normals of several sides are fixed points, one turned from n by up to 0.7 will
 * do: a ridge may run across its own normal at an angle. */
double distanceToSidedRidge(const std::vector<Measurement>& m, double sigma, Vec2 p, Vec2 n)
{
	for (const double reach :
		 {0.002, 0.004, 0.006, 0.008, 0.01, 0.012, 0.014, 0.016, 0.018, 0.02, 0.03, 0.05, 0.1, 0.5})
		for (const double turn : {0.0, 0.35, -0.35, 0.7, -0.7})
		{
			const Vec2 start = std::cos(turn) * n + std::sin(turn) * leftNormal(n);
			bool isRidge = true;
			const double before = slopeAcross(m, sigma, p - reach * sigma * n, start, isRidge);
			const double behind = slopeAcross(m, sigma, p + reach * sigma * n, start, isRidge);
			if (isRidge && before > 0 && behind < 0) return reach;
		}
	return 1;
}

Vec2 toVec(Point2 p)
{
	return {p.x, p.y};
}

std::vector<Measurement> withoutSensors(std::vector<Measurement> m)
{
	for (Measurement& q : m) q.sensorX = q.sensorY = std::numeric_limits<double>::quiet_NaN();
	return m;
}

Options optionsOf(bool sides)
{
	Options o;
	o.sides = sides;
	o.freeSpace = false;
	return o;
}

/** Number of walls that cross the line across the thin wall at a place along it. */
std::size_t facesAt(const RidgeMap& map, Vec2 place, double turn)
{
	const Vec2 x{std::cos(turn), std::sin(turn)};
	std::size_t count = 0;
	for (const Polyline& line : map.walls())
		for (std::size_t k = 1; k < line.points.size(); k++)
		{
			const double a = dot(toVec(line.points[k - 1]), x) - place.x, b = dot(toVec(line.points[k]), x) - place.x;
			count += (a < 0) != (b < 0);
		}
	return count;
}

void expectSame(const RidgeMap& a, const RidgeMap& b)
{
	ASSERT_EQ(a.ridges().size(), b.ridges().size());
	ASSERT_EQ(a.walls().size(), b.walls().size());
	for (std::size_t i = 0; i < a.ridges().size(); i++) EXPECT_TRUE(a.ridges()[i].points == b.ridges()[i].points);
	for (std::size_t i = 0; i < a.walls().size(); i++) EXPECT_TRUE(a.walls()[i].points == b.walls()[i].points);
}
}  // namespace

TEST(ViewingDirection, BinsAreSectorsOf45Degrees)
{
	for (int k = 0; k < 720; k++)
	{
		const double angle = (k + 0.5) * pi / 360;
		const Vec2 d{3 * std::cos(angle), 3 * std::sin(angle)};
		const std::uint32_t bin = directionBin(d);
		EXPECT_EQ(bin, 1 + std::uint32_t(k / 90));
		EXPECT_GE(dot(unit(d), binDirection(bin)), std::cos(pi / 8));
	}
	EXPECT_EQ(directionBin({0, 0}), 0u);
}

TEST(ViewingDirection, WeightsOfOppositeSidesAddUpToOne)
{
	for (int k = 0; k < 360; k++)
	{
		const Vec2 n{std::cos(k * pi / 180), std::sin(k * pi / 180)};
		for (std::uint32_t bin = 1; bin < directionBins; bin++)
			EXPECT_NEAR(SideWeights(n).of[bin] + SideWeights(-n).of[bin], 1, 1e-12);
		EXPECT_EQ(SideWeights(n).of[0], 1);
	}
}

TEST(Sides, RidgesAreThoseOfTheSumOverAllMeasurements)
{
	double worst = 0;
	int vertices = 0;
	for (std::uint64_t seed = 1; seed <= 4; seed++)
	{
		const double turn = 0.7 * double(seed);
		const auto measurements = thinWall(seed, 0.12, turn, 500);
		RidgeMap map(optionsOf(true));
		map.insert(measurements);
		const double sigma = map.options().sigma;
		for (const Polyline& line : map.ridges())
			for (std::size_t k = 1; k < line.points.size(); k++)
				for (const double t : {0.5, 1.0})
				{
					const Vec2 a = toVec(line.points[k - 1]), b = toVec(line.points[k]);
					const Vec2 n = double(line.side) * leftNormal(unit(b - a));
					const double d = distanceToSidedRidge(measurements, sigma, a + t * (b - a), n);
					vertices++;
					worst = std::max(worst, d);
				}
	}
	std::cout << "seeds 1-4: " << vertices << " places on ridges, farthest from the true one: " << worst << " sigma\n";
	EXPECT_GT(vertices, 300);
	EXPECT_LE(worst, 0.02);  // eps
}

TEST(Sides, GradientOfTheRidgeFunctionFollowsTheNormal)
{
	// Against differences of f, whose normal is found anew at every place: places around the end of a thin wall, where
	// the density depends on the normal.
	Options o = optionsOf(true);
	Lattice lattice(o);
	lattice.insert(thinWall(61, 0.07, 0.4, 800));
	lattice.refresh();
	const double edge = lattice.tiles().tileEdge(), h = 0.01;
	Random random(6);
	std::map<TileKey, std::unique_ptr<TileField>> fields;
	int compared = 0, turned = 0;
	for (int i = 0; i < 20000; i++)
	{
		const double along = random.uniform(-0.15, 0.1), across = random.uniform(-0.1, 0.1),
					 angle = random.uniform(-3, 3);
		const Vec2 x{std::cos(0.4), std::sin(0.4)}, y = leftNormal(x);
		const Vec2 q = Frame(o.sigma).toLattice({along * x.x + across * y.x, along * x.y + across * y.y});
		const TileKey key{std::int32_t(std::floor(q.x / edge)), std::int32_t(std::floor(q.y / edge))};
		const auto made = fields.try_emplace(key);
		if (made.second) made.first->second = std::make_unique<TileField>(lattice.tiles(), key, o);
		const TileField& field = *made.first->second;
		const Vec2 p{q.x - edge * key.x, q.y - edge * key.y};
		const Vec2 start =
			Frame::rotateToLattice((across > 0 ? 1.0 : -1.0) * (std::cos(angle) * y + std::sin(angle) * x));
		const RidgePoint r = evaluateRidge(field, p, start);
		if (!isRidgeLike(r, o) || r.occupancy < 20 || std::abs(r.response) > 0.4) continue;
		// Some normals are not found: v1 goes to and fro between two.
		if (norm(evaluateRidge(field, p, r.v1).v1 - r.v1) > 0.01) continue;
		const auto f = [&](Vec2 d) { return evaluateRidge(field, p + h * d, r.v1).f; };
		const Vec2 difference{(f({1, 0}) - f({-1, 0})) / (2 * h), (f({0, 1}) - f({0, -1})) / (2 * h)};
		compared++;
		turned += std::abs(r.response) > 0.02;
		EXPECT_LT(norm(difference - r.df), 0.05 * r.occupancy) << along << " " << across << " response " << r.response;
	}
	std::cout << compared << " places, " << turned << " of them with a density that turns\n";
	EXPECT_GT(compared, 500);
	EXPECT_GT(turned, 100);
}

TEST(Sides, KeepTheFacesOfAThinWallApart)
{
	for (std::uint64_t seed = 11; seed <= 16; seed++)
	{
		const double turn = 0.4 * double(seed), thickness = 0.08;
		const auto measurements = thinWall(seed, thickness, turn);
		const Vec2 y = leftNormal(Vec2{std::cos(turn), std::sin(turn)});
		RidgeMap sided(optionsOf(true)), plain(optionsOf(false));
		sided.insert(measurements);
		plain.insert(measurements);
		const auto worst = [&](const RidgeMap& map)
		{
			double result = 0;
			for (const Polyline& line : map.walls())
				for (const Point2& p : line.points)
				{
					const double along = dot(toVec(p), {-leftNormal(y).x, -leftNormal(y).y});
					if (along < 0.3 || along > 1.7) continue;
					result = std::max(result, std::abs(std::abs(dot(toVec(p), y)) - thickness / 2));
				}
			return result;
		};
		EXPECT_LT(worst(sided), 0.002) << "seed " << seed;
		EXPECT_EQ(facesAt(sided, {1, 0.0}, turn), 2u);
		EXPECT_EQ(facesAt(plain, {1, 0.0}, turn), 1u) << "seed " << seed << ": this thickness is no test";
	}
}

TEST(Sides, AWallWithoutThicknessIsOneWall)
{
	RidgeMap map(optionsOf(true));
	map.insert(thinWall(21, 0, 0.3));
	EXPECT_GE(map.ridges().size(), 2u);
	ASSERT_EQ(map.walls().size(), 1u);
	EXPECT_NEAR(map.walls()[0].length(), 2, 0.05);
}

TEST(Sides, AWallSeenFromManyAnglesIsOneWall)
{
	for (std::uint64_t seed = 31; seed <= 36; seed++)
	{
		Random random(seed);
		std::vector<Measurement> m;
		const double turn = 0.35 * double(seed);
		addFace(m, random, {0, 0}, {3 * std::cos(turn), 3 * std::sin(turn)}, 0.01, 1000);
		RidgeMap map(optionsOf(true));
		map.insert(m);
		EXPECT_EQ(map.walls().size(), 1u) << "seed " << seed;
	}
}

TEST(Sides, OffOrUnknownTheyChangeNothing)
{
	const auto measurements = thinWall(41, 0.1, 0.2, 400);
	RidgeMap unknown(optionsOf(true)), off(optionsOf(false)), offUnknown(optionsOf(false));
	unknown.insert(withoutSensors(measurements));
	off.insert(measurements);
	offUnknown.insert(withoutSensors(measurements));
	expectSame(off, unknown);
	expectSame(off, offUnknown);
	for (const Polyline& line : off.ridges()) EXPECT_EQ(line.side, 0);
}

TEST(Sides, WhatWasSeenFromUnknownPlacesIsThereOnce)
{
	// A ring, in a map in which something else is known to be seen from one side.
	std::vector<Measurement> measurements;
	for (int i = 0; i < 400; i++)
	{
		Measurement m;
		m.x = 4 + 0.5 * std::cos(i * pi / 200);
		m.y = 10 + 0.5 * std::sin(i * pi / 200);
		measurements.push_back(m);
	}
	Random random(1);
	addFace(measurements, random, {3, 2}, {1, 2}, 0.01, 300);
	RidgeMap map(optionsOf(true));
	map.insert(measurements);
	std::size_t rings = 0;
	for (const Polyline& line : map.walls()) rings += line.closed ? 1 : 0;
	EXPECT_EQ(rings, 1u);
	EXPECT_EQ(map.walls().size(), 2u);
}

TEST(Sides, TracesConverge)
{
	// Walls that cross each other, each seen from two places, often along it: there the density turns with the normal.
	std::size_t traces = 0, lost = 0;
	for (std::uint64_t seed = 1; seed <= 60; seed++)
	{
		Random random(seed);
		std::vector<Measurement> measurements;
		for (int view = 0; view < 8; view++)
		{
			const Vec2 from{random.uniform(0, 3), random.uniform(0, 3)};
			const double heading = random.uniform(0, 2 * pi);
			const Vec2 along{std::cos(heading), std::sin(heading)};
			const Vec2 sensor{random.uniform(-1, 4), random.uniform(-1, 4)};
			for (int k = 0; k < 300; k++)
			{
				const Vec2 p = from + random.uniform(0, 1.5) * along;
				measurements.push_back(
					{p.x + 0.015 * random.normal(), p.y + 0.015 * random.normal(), sensor.x, sensor.y});
			}
		}
		RidgeMap map(optionsOf(true));
		map.insert(measurements);
		const UpdateResult r = map.update();
		traces += r.traces;
		lost += r.stops[std::size_t(StopReason::noConvergence)] + r.stops[std::size_t(StopReason::workLimit)];
	}
	std::cout << lost << " of " << traces << " traces did not converge\n";
	EXPECT_GT(traces, 1000u);
	EXPECT_LE(1000 * lost, traces);
}

TEST(Sides, HistoryLeavesNoTrace)
{
	for (std::uint64_t seed = 51; seed <= 54; seed++)
	{
		Random random(seed);
		auto measurements = thinWall(seed, 0.08, double(seed), 300);
		const auto plain = withoutSensors(thinWall(seed + 100, 0.3, 1.0, 200));
		measurements.insert(measurements.end(), plain.begin(), plain.end());
		RidgeMap whole(optionsOf(true));
		whole.insert(measurements);

		RidgeMap inPieces(optionsOf(true)), a(optionsOf(true)), b(optionsOf(true));
		random.shuffle(measurements);
		for (std::size_t i = 0; i < measurements.size();)
		{
			const std::size_t end = std::min(measurements.size(), i + 1 + random.below(200));
			const std::vector<Measurement> batch(measurements.begin() + std::ptrdiff_t(i),
												 measurements.begin() + std::ptrdiff_t(end));
			inPieces.insert(batch);
			inPieces.update(1 + unsigned(random.below(2)));
			(random.chance(0.5) ? a : b).insert(batch);
			i = end;
		}
		expectSame(whole, inPieces);
		a.update();
		a.merge(b);
		expectSame(whole, a);
		a.subtract(b);
		a.update();
		a.merge(b);
		expectSame(whole, a);

		// From sided to plain and back.
		RidgeMap map(optionsOf(true)), alone(optionsOf(true));
		map.insert(plain);
		alone.insert(plain);
		map.update();
		const auto faces = thinWall(seed, 0.08, double(seed), 300);
		map.insert(faces);
		expectSame(whole, map);
		map.erase(faces);
		expectSame(alone, map);
		RidgeMap stored(optionsOf(true));
		stored.insertCells(whole.cells());
		expectSame(whole, stored);
	}
}

}  // namespace ridgemap::test
