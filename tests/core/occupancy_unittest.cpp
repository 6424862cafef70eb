// SPDX-License-Identifier: BSD-3-Clause
// The continuous occupancy, equations (2)-(4), and its third derivatives against sums over the raw measurements.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>

#include "frame.h"
#include "oracle.h"
#include "scenes.h"

namespace ridgemap::test
{
namespace
{
/** Value, gradient, Hessian and third derivatives in a row, unit sigma. */
using Jet = std::array<double, 10>;
constexpr std::array<int, 10> orderOf{0, 1, 1, 2, 2, 2, 3, 3, 3, 3};

Jet jetOf(const OccupancySample& s, double sigma)
{
	const double i1 = sigma, i2 = i1 * i1, i3 = i2 * i1;
	return {s.value,    i1 * s.gx,   i1 * s.gy,   i2 * s.hxx,  i2 * s.hxy,
			i2 * s.hyy, i3 * s.txxx, i3 * s.txxy, i3 * s.txyy, i3 * s.tyyy};
}

Jet jetOf(const BruteSample& s)
{
	return {s.value,      s.gradient.x, s.gradient.y, s.hessian[0], s.hessian[1],
			s.hessian[2], s.third[0],   s.third[1],   s.third[2],   s.third[3]};
}

/** Largest differences of value, gradient, Hessian and third derivatives. */
std::array<double, 4> difference(const Jet& a, const Jet& b)
{
	std::array<double, 4> result{};
	for (std::size_t i = 0; i < a.size(); i++)
	{
		double& d = result[std::size_t(orderOf[i])];
		d = std::max(d, std::abs(a[i] - b[i]));
	}
	return result;
}

/** Places near measurements, far from them, and anywhere between. */
std::vector<Point2> places(const RandomScene& scene, std::size_t n)
{
	Random random(scene.seed + 77);
	std::vector<Point2> result;
	for (std::size_t i = 0; i < n; i++)
	{
		const Measurement& m = scene.measurements[random.below(scene.measurements.size())];
		const double spread = scene.sigma * std::array<double, 3>{0.3, 2, 10}[i % 3];
		const double ex = random.normal(), ey = random.normal();
		result.push_back({m.x + spread * ex, m.y + spread * ey});
	}
	return result;
}

RidgeMap mapOf(const RandomScene& scene, double cell, double cutoff)
{
	Options o;
	o.sigma = scene.sigma;
	o.cell = cell;
	o.cutoff = cutoff;
	RidgeMap map(o);
	map.insert(scene.measurements);
	return map;
}

/** Measurements as the lattice rounds them. */
std::vector<Measurement> rounded(const std::vector<Measurement>& measurements, double sigma)
{
	const Frame frame(sigma);
	const double quantum = 1 / double(Frame::quantaPerSigma);
	std::vector<Measurement> result;
	for (const Measurement& m : measurements)
	{
		const LatticePoint q = frame.quantise({m.x, m.y});
		const Point2 p = frame.toMap({double(q.u) * quantum, double(q.v) * quantum});
		result.push_back({p.x, p.y});
	}
	return result;
}

/** Largest error of the k-th derivatives over some scenes, relative to Sum w (1 + r^k). */
std::array<double, 4> relativeErrors(double cell, double cutoff, std::uint64_t firstSeed, int scenes,
									 bool roundFirst = false)
{
	std::array<double, 4> worst{};
	for (int i = 0; i < scenes; i++)
	{
		const RandomScene scene = randomScene(firstSeed + std::uint64_t(i));
		const RidgeMap map = mapOf(scene, cell, cutoff);
		const Oracle oracle(roundFirst ? rounded(scene.measurements, scene.sigma) : scene.measurements, scene.sigma);
		for (const Point2& p : places(scene, 300))
		{
			const BruteSample truth = oracle.sample(oracle.toUnit(p));
			if (truth.value < 0.01) continue;
			const auto d = difference(jetOf(map.occupancy(p), scene.sigma), jetOf(truth));
			for (std::size_t k = 0; k < 4; k++) worst[k] = std::max(worst[k], d[k] / truth.scale[k]);
		}
	}
	std::cout << "cell " << cell << ", cut-off " << cutoff << ", seeds from " << firstSeed << ": relative errors "
			  << worst[0] << ", " << worst[1] << ", " << worst[2] << ", " << worst[3] << "\n";
	return worst;
}
}  // namespace

TEST(Occupancy, AgreesWithTheSumOverAllMeasurements)
{
	const auto error = relativeErrors(0, 8, 100, 20, false);
	for (const std::size_t order : {0, 1, 2}) EXPECT_LE(error[order], 1e-6);
	// Places are rounded to sigma * 2^-20; the fourth derivatives, by which that changes the third, are larger.
	EXPECT_LE(error[3], 2.5e-6);
}

TEST(Occupancy, AgreesWithTheSumOverAllRoundedMeasurements)
{
	for (const double error : relativeErrors(0, 8, 100, 20, true)) EXPECT_LE(error, 1e-6);
}

TEST(Occupancy, CompactionChangesItLittleAndLessInSmallerCells)
{
	const auto whole = relativeErrors(1, 8, 200, 10), half = relativeErrors(0.5, 8, 200, 10);
	const auto quarter = relativeErrors(0.25, 8, 200, 10), eighth = relativeErrors(0.125, 8, 200, 10);
	for (std::size_t k = 0; k < 4; k++)
	{
		// Mass, mean and second moments are exact: what is left falls with the third power of the cell.
		EXPECT_LE(half[k], 0.01);
		EXPECT_LE(half[k], whole[k] / 4);
		EXPECT_LE(quarter[k], half[k] / 4);
		EXPECT_LE(eighth[k], quarter[k] / 4);
	}
}

TEST(Occupancy, CutOffLeavesOutNoMoreThanTheTail)
{
	for (const double cutoff : {4.0, 5.0, 6.0})
	{
		// Largest contribution of one kernel beyond the cut-off to the derivatives of order 0 to 3.
		const double c = cutoff, tail = std::exp(-0.5 * c * c);
		const std::array<double, 4> bound{tail, c * tail, (c * c + 1) * tail, (c * c * c + 3 * c) * tail};
		double largest = 0;
		for (std::uint64_t seed = 300; seed < 306; seed++)
		{
			const RandomScene scene = randomScene(seed);
			const RidgeMap cut = mapOf(scene, 0, cutoff), whole = mapOf(scene, 0, 8);
			for (const Point2& p : places(scene, 200))
			{
				std::size_t beyond = 0;
				double scale = 0;
				for (const Measurement& m : scene.measurements)
				{
					const double r = std::hypot(m.x - p.x, m.y - p.y) / scene.sigma;
					beyond += r > cutoff * (1 - 1e-6) && r < 14;
					scale += std::exp(-0.5 * r * r) * (1 + r * r * r);
				}
				const auto d = difference(jetOf(cut.occupancy(p), scene.sigma), jetOf(whole.occupancy(p), scene.sigma));
				for (std::size_t k = 0; k < 4; k++)
					EXPECT_LE(d[k], double(beyond) * bound[k] + 1e-6 * scale) << "order " << k << ", seed " << seed;
				largest = std::max(largest, d[0]);
			}
		}
		EXPECT_GT(largest, 0) << "the cut-off has no effect";
	}
}

TEST(Occupancy, OfOneMeasurementIsTheKernel)
{
	for (const double cell : {0.0, 0.5})
	{
		Options o;
		o.cell = cell;
		RidgeMap map(o);
		const Point2 mu{12.34, -56.78};
		map.insert({{mu.x, mu.y}});
		EXPECT_NEAR(map.occupancy(mu).value, 1, 1e-6);
		EXPECT_NEAR(map.occupancy(mu).hxx * o.sigma * o.sigma, -1, 2e-6);
		EXPECT_NEAR(map.occupancy(mu).gx * o.sigma, 0, 2e-6);
		const OccupancySample beside = map.occupancy({mu.x + o.sigma, mu.y});
		EXPECT_NEAR(beside.value, std::exp(-0.5), 2e-6);
		EXPECT_NEAR(beside.gx * o.sigma, -std::exp(-0.5), 2e-6);
		EXPECT_NEAR(beside.txxx * o.sigma * o.sigma * o.sigma, 2 * std::exp(-0.5), 5e-6);
	}
}

TEST(Occupancy, IsZeroOutsideOfTheWorld)
{
	const double edge = maxCoordinate, beyond = edge + 0.01;
	RidgeMap map;
	map.insert({{edge, 0}, {0, -edge}});
	EXPECT_GT(map.occupancy({edge, 0}).value, 0.9);
	EXPECT_GT(map.occupancy({0, -edge}).value, 0.9);
	for (const Point2& p : {Point2{beyond, 0}, Point2{0, -beyond}, Point2{std::nan(""), 0}, Point2{0, std::nan("")},
							Point2{0, -std::numeric_limits<double>::infinity()}})
		EXPECT_EQ(map.occupancy(p).value, 0) << p.x << " " << p.y;
}

TEST(Occupancy, IsZeroWhereThereIsNothing)
{
	const double nan = std::numeric_limits<double>::quiet_NaN();
	RidgeMap map;
	EXPECT_EQ(map.occupancy({0, 0}).value, 0);
	map.insert({{0, 0}});
	for (const Point2& p : {Point2{1000, 0}, {-1e6, 1e6}, {1e7, 0}, {0, -1e300}, {nan, 0}, {0, nan}})
	{
		const Jet jet = jetOf(map.occupancy(p), 1);
		EXPECT_TRUE(std::all_of(jet.begin(), jet.end(), [](double v) { return v == 0; })) << p.x << " " << p.y;
	}
}

}  // namespace ridgemap::test
