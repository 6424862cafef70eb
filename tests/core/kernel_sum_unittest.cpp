// SPDX-License-Identifier: BSD-3-Clause
// The sum of kernels and what is made of it: against closed forms, finite differences, and one variant against another.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "kernel_sum_impl.h"
#include "random.h"
#include "ridge_point.h"

namespace ridgemap
{
#ifdef RIDGEMAP_HAVE_AVX2_UNIT
KernelSums sumKernelsAvx2(const BlockView* views, std::size_t count);
#endif
}  // namespace ridgemap

namespace ridgemap::test
{
namespace
{
/** Random kernels with covariances of up to 1.5, some lanes unused. */
std::vector<KernelGroup> randomGroups(Random& random, std::size_t n)
{
	std::vector<KernelGroup> groups(n);
	for (KernelGroup& g : groups)
		for (int i = 0; i < 8; i++)
		{
			if (random.chance(0.1)) continue;
			const double vx = random.uniform(0, 0.5), vy = random.uniform(0, 0.5);
			const double vxy = random.uniform(-1, 1) * std::sqrt(vx * vy), det = (1 + vx) * (1 + vy) - vxy * vxy;
			g.x[i] = float(random.uniform(-2, 2));
			g.y[i] = float(random.uniform(-2, 2));
			g.a[i] = float((1 + vy) / det);
			g.b[i] = float(-vxy / det);
			g.c[i] = float((1 + vx) / det);
			g.w[i] = float(random.uniform(0.5, 50) / std::sqrt(det));
		}
	return groups;
}

/** The same sums in double precision, indices i, j, k running over the axes. */
struct Sums
{
	double value = 0, g[2] = {}, h[2][2] = {}, t[2][2][2] = {}, scale[4] = {};
};

void add(Sums& s, const double d[2], const double a[2][2], double w)
{
	const double u[2] = {a[0][0] * d[0] + a[0][1] * d[1], a[1][0] * d[0] + a[1][1] * d[1]};
	const double p = w * std::exp(-0.5 * (u[0] * d[0] + u[1] * d[1])), r = std::hypot(u[0], u[1]);
	s.value += p;
	for (int i = 0; i < 2; i++)
	{
		s.g[i] -= p * u[i];
		for (int j = 0; j < 2; j++)
		{
			s.h[i][j] += p * (u[i] * u[j] - a[i][j]);
			for (int k = 0; k < 2; k++)
				s.t[i][j][k] += p * (a[i][j] * u[k] + a[i][k] * u[j] + a[j][k] * u[i] - u[i] * u[j] * u[k]);
		}
	}
	for (int k = 0; k < 4; k++) s.scale[k] += p * (1 + std::pow(r, k));
}

Sums sumInDouble(const std::vector<BlockView>& views)
{
	Sums s;
	for (const BlockView& v : views)
		for (std::size_t n = 0; n < v.count; n++)
			for (int i = 0; i < 8; i++)
			{
				const KernelGroup& g = v.groups[n];
				const double d[2] = {double(v.dx) - double(g.x[i]), double(v.dy) - double(g.y[i])};
				const double a[2][2] = {{g.a[i], g.b[i]}, {g.b[i], g.c[i]}};
				add(s, d, a, g.w[i]);
			}
	return s;
}

/** A few blocks of kernels seen from one point. */
struct View
{
	std::vector<std::vector<KernelGroup>> blocks;
	std::vector<BlockView> views;

	View(Random& random, double reach)
	{
		for (int i = 0; i < 6; i++) blocks.push_back(randomGroups(random, random.below(12)));
		for (const auto& groups : blocks)
			views.push_back({groups.data(), groups.size(), float(random.uniform(-reach, reach)),
							 float(random.uniform(-reach, reach))});
	}
};

/** Sums of a smooth made-up density at a point. */
KernelSums smooth(Vec2 p)
{
	Random random(5);
	Sums s;
	for (int i = 0; i < 40; i++)
	{
		const double mx = random.uniform(-4, 4), my = 0.3 * random.normal() + 0.1 * mx * mx;
		const double d[2] = {p.x - mx, p.y - my}, a[2][2] = {{1, 0}, {0, 1}};
		add(s, d, a, 1);
	}
	return {s.value,   s.g[0],       s.g[1],       s.h[0][0],    s.h[0][1],
			s.h[1][1], s.t[0][0][0], s.t[0][0][1], s.t[0][1][1], s.t[1][1][1]};
}
}  // namespace

TEST(KernelSum, AgreesWithDoublePrecision)
{
	Random random(1);
	for (int trial = 0; trial < 300; trial++)
	{
		const View view(random, 5);
		const KernelSums got = sumKernels(view.views.data(), view.views.size());
		const Sums s = sumInDouble(view.views);
		EXPECT_NEAR(got.value, s.value, 1e-6 * s.scale[0]);
		EXPECT_NEAR(got.gx, s.g[0], 1e-6 * s.scale[1]);
		EXPECT_NEAR(got.gy, s.g[1], 1e-6 * s.scale[1]);
		EXPECT_NEAR(got.hxx, s.h[0][0], 1e-6 * s.scale[2]);
		EXPECT_NEAR(got.hxy, s.h[0][1], 1e-6 * s.scale[2]);
		EXPECT_NEAR(got.hyy, s.h[1][1], 1e-6 * s.scale[2]);
		EXPECT_NEAR(got.txxx, s.t[0][0][0], 1e-6 * s.scale[3]);
		EXPECT_NEAR(got.txxy, s.t[0][0][1], 1e-6 * s.scale[3]);
		EXPECT_NEAR(got.txyy, s.t[0][1][1], 1e-6 * s.scale[3]);
		EXPECT_NEAR(got.tyyy, s.t[1][1][1], 1e-6 * s.scale[3]);
	}
}

TEST(KernelSum, OfNothingIsZero)
{
	const KernelSums none = sumKernels(nullptr, 0);
	EXPECT_EQ(none.value, 0);
	EXPECT_EQ(none.tyyy, 0);
}

TEST(KernelSum, EveryVariantGivesTheSameBits)
{
	Random random(2);
	for (int trial = 0; trial < 2000; trial++)
	{
		// Also from far away, where exp is cut off, and from where it is subnormal.
		const View view(random, trial % 4 == 0 ? 40 : trial % 4 == 1 ? 13 : 5);
		const KernelSums portable = sumKernelsImpl(view.views.data(), view.views.size());
		const KernelSums chosen = sumKernels(view.views.data(), view.views.size());
		ASSERT_EQ(std::memcmp(&portable, &chosen, sizeof chosen), 0) << "trial " << trial;
#ifdef RIDGEMAP_HAVE_AVX2_UNIT
		if (!__builtin_cpu_supports("avx2")) continue;
		const KernelSums avx2 = sumKernelsAvx2(view.views.data(), view.views.size());
		ASSERT_EQ(std::memcmp(&portable, &avx2, sizeof avx2), 0) << "trial " << trial;
#endif
	}
}

TEST(KernelSum, DoesNotDependOnUnusedLanes)
{
	Random random(3);
	auto groups = randomGroups(random, 5);
	auto padded = groups;
	padded.push_back(KernelGroup{});
	const BlockView a{groups.data(), groups.size(), 1.5f, -0.5f}, b{padded.data(), padded.size(), 1.5f, -0.5f};
	const KernelSums sa = sumKernels(&a, 1), sb = sumKernels(&b, 1);
	EXPECT_EQ(std::memcmp(&sa, &sb, sizeof sa), 0);
}

TEST(RidgePoint, SolvesTheEigenvalueProblem)
{
	Random random(4);
	for (int trial = 0; trial < 500; trial++)
	{
		const Vec2 p{random.uniform(-4, 4), random.uniform(-2, 3)};
		const KernelSums s = smooth(p);
		const RidgePoint r = makeRidgePoint(p, s);
		EXPECT_NEAR(norm(r.v1), 1, 1e-12);
		EXPECT_NEAR(norm(r.v2), 1, 1e-12);
		EXPECT_NEAR(dot(r.v1, r.v2), 0, 1e-12);
		EXPECT_LE(r.lambda1, r.lambda2);
		const Vec2 image{s.hxx * r.v1.x + s.hxy * r.v1.y, s.hxy * r.v1.x + s.hyy * r.v1.y};
		EXPECT_NEAR(norm(image - r.lambda1 * r.v1), 0, 1e-11 * (1 + s.value));
		EXPECT_NEAR(r.lambda1 * r.lambda2, s.hxx * s.hyy - s.hxy * s.hxy, 1e-10 * (1 + s.value * s.value));
		EXPECT_DOUBLE_EQ(r.f, s.gx * r.v1.x + s.gy * r.v1.y);
	}
}

TEST(RidgePoint, GradientOfTheRidgeFunctionIsExact)
{
	Random random(6);
	const double h = 1e-4;
	for (int trial = 0; trial < 500; trial++)
	{
		const Vec2 p{random.uniform(-4, 4), random.uniform(-2, 3)};
		const RidgePoint r = makeRidgePoint(p, smooth(p));
		if (r.lambda2 - r.lambda1 < 0.2 * r.occupancy) continue;  // v1 turns fast there
		const auto f = [&](Vec2 q)
		{
			const RidgePoint n = makeRidgePoint(q, smooth(q));
			return dot(n.v1, r.v1) < 0 ? -n.f : n.f;
		};
		const double scale = 1 + r.occupancy, step = r.newtonStep(unit(r.df));
		EXPECT_NEAR((f({p.x + h, p.y}) - f({p.x - h, p.y})) / (2 * h), r.df.x, 1e-5 * scale);
		EXPECT_NEAR((f({p.x, p.y + h}) - f({p.x, p.y - h})) / (2 * h), r.df.y, 1e-5 * scale);
		if (std::abs(step) < 0.01)
		{
			EXPECT_NEAR(f(p + step * unit(r.df)), 0, 0.1 * std::abs(r.f) + 1e-9);
		}
		EXPECT_NEAR(dot(r.tangent({1, 0}), r.df), 0, 1e-9 * scale);
		EXPECT_GE(r.tangent({1, 0}).x, 0);
	}
}

TEST(RidgePoint, OfEqualEigenvaluesIsNoRidgeAndFinite)
{
	KernelSums s{};
	s.value = 1;
	s.hxx = s.hyy = -1;
	const RidgePoint r = makeRidgePoint({}, s);
	EXPECT_TRUE(std::isfinite(r.f) && std::isfinite(r.df.x) && std::isfinite(r.df.y));
	EXPECT_NEAR(norm(r.v1), 1, 1e-12);
	EXPECT_FALSE(isRidgeLike(r, Options()));
	s.hxx = 1;
	EXPECT_TRUE(isRidgeLike(makeRidgePoint({}, s), Options()));
	s.hxx = s.hyy = 1;
	s.hxy = 0.5;
	EXPECT_FALSE(isRidgeLike(makeRidgePoint({}, s), Options())) << "a valley";
	EXPECT_FALSE(isRidgeLike(makeRidgePoint({}, KernelSums()), Options())) << "nothing";
}

}  // namespace ridgemap::test
