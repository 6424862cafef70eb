// SPDX-License-Identifier: BSD-3-Clause
// The statistical error of a ridge against numeric integrals, tables and simulated walls.
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>
#include <ridgemap/standard_error.h>

#include <cmath>

#include "scenes.h"

namespace ridgemap::test
{
TEST(StandardError, varianceEqualsNumericIntegrals)
{
	for (const double sigma : {0.05, 0.2})
		for (const double s : {0.01, 0.05, 0.2})
		{
			// Sums over measurements become integrals over the wall and the noise across it, density 1.
			double variance = 0, slope = 0, occupancy = 0, squares = 0;
			const double h = 0.02;
			for (double u = -8; u < 8; u += h)
				for (double v = -8; v < 8; v += h)
				{
					const double x = u * sigma, y = v * s;
					const double weight = h * h * sigma * std::exp(-0.5 * v * v) / std::sqrt(2 * M_PI);
					const double k = std::exp(-0.5 * (x * x + y * y) / (sigma * sigma));
					const double slopeOfK = (y * y / (sigma * sigma) - 1) / (sigma * sigma) * k;
					variance += weight * std::pow(y / (sigma * sigma) * k, 2);
					slope += weight * slopeOfK;
					occupancy += weight * k;
					squares += weight * k * k;
				}
			const double expected = variance / (slope * slope);
			EXPECT_NEAR(offsetVariance(occupancy, s, sigma) / expected, 1, 1e-3) << sigma << " " << s;
			EXPECT_NEAR(effectiveMeasurements(occupancy, s, sigma) / (occupancy * occupancy / squares), 1, 1e-3);
			EXPECT_NEAR(-slope * sigma * sigma / occupancy, 1 / (1 + s * s / (sigma * sigma)), 1e-3);
		}
}

TEST(StandardError, quantilesOfStudent)
{
	for (const auto& [dof, t] :
		 {std::pair(3.0, 3.1824), {5.0, 2.5706}, {10.0, 2.2281}, {30.0, 2.0423}, {1000.0, 1.9623}})
		EXPECT_NEAR(studentQuantile95(dof) / t, 1, 0.006) << dof;
	for (double dof = 0.6; dof < 50; dof += 0.1) EXPECT_GT(studentQuantile95(dof), studentQuantile95(dof + 0.1));
}

TEST(StandardError, whereNothingCanBeTold)
{
	EXPECT_TRUE(std::isinf(ridgeUncertainty({0, 0}, 0.1).standardError));  // a vertex of a wall pass
	EXPECT_TRUE(std::isinf(ridgeUncertainty({1, 0.9f}, 0.1).halfWidth95));
	EXPECT_TRUE(std::isinf(ridgeUncertainty({10, -0.1f}, 0.1).halfWidth95));
	EXPECT_EQ(ridgeUncertainty({10, 1.01f}, 0.1).noise, 0);
}

TEST(StandardError, everyVertexCarriesIt)
{
	const double sigma = 0.1;
	Options options;
	options.sigma = sigma;
	options.straighten = false;  // fitted runs have errors of their own
	RidgeMap map(options);
	// An L: its sharpened corner and its trimmed ends lie on no ridge.
	map.insert(SceneBuilder(5, sigma, 0.33, 30).wall({0, 0}, {40, 0}).wall({40, 0}, {40, 30}).finish());
	std::size_t known = 0, added = 0;
	for (const auto* lines : {&map.ridges(), &map.walls()})
		for (const Polyline& line : *lines)
			for (const VertexInfo& v : line.info)
			{
				EXPECT_EQ(v.standardError, float(ridgeUncertainty(v, sigma).standardError));
				EXPECT_EQ(std::isinf(v.standardError), v.occupancy == 0);
				(std::isinf(v.standardError) ? added : known)++;
			}
	EXPECT_GT(known, 40u);
	EXPECT_GE(added, 3u);
}

TEST(StandardError, intervalsCoverTheWall)
{
	const double sigma = 0.1;
	int covered = 0, places = 0;
	for (std::uint64_t seed = 0; seed < 150; seed++)
	{
		Options options;
		options.sigma = sigma;
		options.eps = sigma / 500;
		options.straighten = false;
		RidgeMap map(options);
		map.insert(SceneBuilder(seed, sigma, 0.33, 10).wall({0, 0}, {50, 0}).finish());
		for (const Polyline& p : map.walls())
			for (std::size_t i = 1; i < p.points.size(); i++)
				for (double x = 0.6; x < 4.5; x += 0.3)
				{
					if ((p.points[i - 1].x <= x) == (p.points[i].x <= x)) continue;
					const double t = (x - p.points[i - 1].x) / (p.points[i].x - p.points[i - 1].x);
					const double y = p.points[i - 1].y + t * (p.points[i].y - p.points[i - 1].y);
					places++;
					covered += std::abs(y) <= ridgeUncertainty(p.info[i], sigma).halfWidth95 ? 1 : 0;
				}
	}
	ASSERT_GT(places, 1800);
	EXPECT_NEAR(double(covered) / places, 0.95, 0.02);
}

}  // namespace ridgemap::test
