// SPDX-License-Identifier: BSD-3-Clause
#include "place_set.h"

#include <gtest/gtest.h>

#include <cmath>

#include "random.h"
#include "viewing_direction.h"

namespace ridgemap::test
{
TEST(PlaceSets, HoldsTheSquaresWhoseMiddleIsNear)
{
	Random random(5);
	for (int trial = 0; trial < 100; trial++)
	{
		PlaceSets set(16, 3);
		const std::uint32_t bin = trial % directionBins, other = (bin + 1) % directionBins;
		const Vec2 a{random.uniform(-2, 18), random.uniform(-2, 18)};
		const Vec2 b = trial % 10 == 0   ? a
					   : trial % 10 == 1 ? a + Vec2{random.uniform(-2, 2), 0}
										 : a + Vec2{random.uniform(-2, 2), random.uniform(-2, 2)};
		set.addCapsule(a, b, 1, std::uint32_t(1) << bin);
		for (int i = 0; i < 500; i++)
		{
			const Vec2 p{random.uniform(-3, 19), random.uniform(-3, 19)};
			const Vec2 middle{0.25 * std::floor(4 * p.x) + 0.125, 0.25 * std::floor(4 * p.y) + 0.125};
			EXPECT_FALSE(set.contains(p, other));
			EXPECT_EQ(set.contains(p, bin), footOnSegment(a, b, middle).distance <= 1);
		}
		EXPECT_FALSE(set.contains({-3.1, 5}, bin));
		EXPECT_FALSE(set.contains({5, 19.1}, bin));
	}
}

}  // namespace ridgemap::test
