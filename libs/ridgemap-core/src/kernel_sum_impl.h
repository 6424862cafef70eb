// SPDX-License-Identifier: BSD-3-Clause
// The body of sumKernels(), compiled once per instruction set. Included by kernel_sum_*.cpp only; everything has
// internal linkage, so that no two variants meet at link time.
#pragma once

#include <cstdint>

#include "kernel_sum.h"

namespace ridgemap
{
namespace
{
typedef float Float8 __attribute__((vector_size(32)));
typedef float UnalignedFloat8 __attribute__((vector_size(32), aligned(4), may_alias));
typedef std::int32_t Int8 __attribute__((vector_size(32)));
typedef double Double4 __attribute__((vector_size(32)));
typedef float Float4 __attribute__((vector_size(16)));

/** exp(-t) for 0 <= t: 2^k * exp(r), |r| <= ln(2)/2, by a polynomial; relative error below 2e-7. */
inline void expMinus(const Float8& t, Float8& result)
{
	const Float8 limit = Float8{} + 80.0f;
	const Float8 x = -(t < limit ? t : limit);
	const float magic = 12582912.0f;  // 1.5 * 2^23: adding it rounds to an integer
	const Float8 shifted = x * 1.44269504f + magic;
	const Float8 k = shifted - magic;
	Float8 r = x - k * 0.693359375f;
	r = r + k * 2.12194440e-4f;
	Float8 p = r * 1.9875691500e-4f + 1.3981999507e-3f;
	p = p * r + 8.3334519073e-3f;
	p = p * r + 4.1665795894e-2f;
	p = p * r + 1.6666665459e-1f;
	p = p * r + 5.0000001201e-1f;
	p = p * (r * r) + r + 1.0f;
	const Int8 exponent = __builtin_convertvector(k, Int8) << 23;
	result = (Float8)((Int8)p + exponent);  // the same bits, with the exponent raised by k
}

inline double laneSum(const Float8& v)
{
	const Float4 low = {v[0], v[1], v[2], v[3]}, high = {v[4], v[5], v[6], v[7]};
	const Double4 d = __builtin_convertvector(low, Double4) + __builtin_convertvector(high, Double4);
	return (d[0] + d[1]) + (d[2] + d[3]);
}

inline const UnalignedFloat8& load(const float* p)
{
	return *reinterpret_cast<const UnalignedFloat8*>(p);
}

inline KernelSums sumKernelsImpl(const BlockView* views, std::size_t count)
{
	Float8 value{}, gx{}, gy{}, hxx{}, hxy{}, hyy{}, txxx{}, txxy{}, txyy{}, tyyy{};
	for (std::size_t i = 0; i < count; i++)
	{
		const BlockView& v = views[i];
		for (const KernelGroup* g = v.groups; g != v.groups + v.count; ++g)
		{
			const Float8 kx = load(g->x), ky = load(g->y), a = load(g->a), b = load(g->b), c = load(g->c),
						 w = load(g->w);
			const Float8 dx = v.dx - kx, dy = v.dy - ky;
			const Float8 ux = a * dx + b * dy, uy = b * dx + c * dy;  // S^-1 (x - mu)
			Float8 e;
			expMinus(0.5f * (ux * dx + uy * dy), e);
			const Float8 p = w * e;
			const Float8 px = p * ux, py = p * uy;
			const Float8 xx = ux * ux - a, xy = ux * uy - b, yy = uy * uy - c;
			value += p;
			gx -= px;
			gy -= py;
			hxx += p * xx;
			hxy += p * xy;
			hyy += p * yy;
			// Third derivatives: -u u u + the three products of S^-1 with u.
			txxx -= px * (xx - 2.0f * a);
			txxy -= px * (xy - b) - p * (a * uy);
			txyy -= py * (xy - b) - p * (c * ux);
			tyyy -= py * (yy - 2.0f * c);
		}
	}
	KernelSums s;
	s.value = laneSum(value);
	s.gx = laneSum(gx);
	s.gy = laneSum(gy);
	s.hxx = laneSum(hxx);
	s.hxy = laneSum(hxy);
	s.hyy = laneSum(hyy);
	s.txxx = laneSum(txxx);
	s.txxy = laneSum(txxy);
	s.txyy = laneSum(txyy);
	s.tyyy = laneSum(tyyy);
	return s;
}
}  // namespace
}  // namespace ridgemap
