// SPDX-License-Identifier: BSD-3-Clause
// The innermost loops, compiled once per instruction set. Included by kernel_sum*.cpp only; everything has internal
// linkage, so that no two variants meet at link time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "field_nodes.h"
#include "interpolation_table.h"
#include "kernel_sum.h"

namespace ridgemap
{
namespace
{
typedef float Float8 __attribute__((vector_size(32)));
typedef float UnalignedFloat8 __attribute__((vector_size(32), aligned(4), may_alias));
typedef std::int32_t Int8 __attribute__((vector_size(32)));
typedef std::uint32_t Word8 __attribute__((vector_size(32)));
typedef Int8 UnalignedInt8 __attribute__((aligned(4), may_alias));
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

/** To be dereferenced at once: behind a reference, clang forgets that it need not be aligned. */
inline const UnalignedFloat8* at(const float* p)
{
	return reinterpret_cast<const UnalignedFloat8*>(p);
}

inline KernelSums sumKernelsImpl(const BlockView* views, std::size_t count)
{
	Float8 value{}, gx{}, gy{}, hxx{}, hxy{}, hyy{}, txxx{}, txxy{}, txyy{}, tyyy{};
	for (std::size_t i = 0; i < count; i++)
	{
		const BlockView& v = views[i];
		for (const KernelGroup* g = v.groups; g != v.groups + v.count; ++g)
		{
			const Float8 kx = *at(g->x), ky = *at(g->y), a = *at(g->a), b = *at(g->b), c = *at(g->c), w = *at(g->w);
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

inline void makeProfileImpl(const KernelShape& s, const KernelReach& reach, KernelProfile& p)
{
	const Float8 lanes = {0, 1, 2, 3, 4, 5, 6, 7};
	constexpr float h = 1.0f / nodesPerSigma;
	const auto fill =
		[&](float start, float variance, float weight, float slope, int count, float* values, float* slopes)
	{
		for (int i = 0; i < count; i += 8)
		{
			const Float8 place = start + h * (float(i) + lanes);
			Float8 e;
			expMinus(place * place * (0.5f / variance), e);
			*reinterpret_cast<Float8*>(values + i) = e * weight;
			*reinterpret_cast<Float8*>(slopes + i) = e * weight * place * slope;
		}
	};
	// To first order, a covariance adds xy times the mixed derivative.
	fill(s.x0, s.vx, 1, 1 / s.vx, reach.columns, p.x, p.dx);
	fill(s.y0, s.vy, s.weight, s.xy / s.vy, reach.rows, p.y, p.dy);
}

/** Values of a profile in eight columns of a row, rounded to the nearest integer: low + 2^highShift high. */
template <Magnitude magnitude>
inline void integersAt(const KernelProfile& p, int i, const Float8& y, const Float8& dy, Int8& low, Int8& high)
{
	const Float8& x = *reinterpret_cast<const Float8*>(p.x + i);
	const Float8& dx = *reinterpret_cast<const Float8*>(p.dx + i);
	Float8 value = (x * y + dx * dy) + 0.5f;
	if (magnitude != Magnitude::small)
	{
		constexpr float unit = 1 << NodeChanges::highShift;
		high = __builtin_convertvector(value * (1 / unit), Int8);
		value -= __builtin_convertvector(high, Float8) * unit;
	}
	low = __builtin_convertvector(value, Int8);
}

template <bool plus, bool minus, Magnitude magnitude>
inline void addRows(const NodeChanges& to, const KernelReach& reach, const KernelProfile* after,
					const KernelProfile* before)
{
	constexpr bool wide = magnitude == Magnitude::large;
	std::int32_t *lowRow = to.low, *highRow = to.high;
	for (int j = 0, stride = to.stride, rows = reach.rows; j < rows; j++, lowRow += stride)
	{
		const Float8 zero{};
		const Float8 y = zero + (plus ? after->y[j] : 0), dy = zero + (plus ? after->dy[j] : 0);
		const Float8 oldY = zero + (minus ? before->y[j] : 0), oldDy = zero + (minus ? before->dy[j] : 0);
		for (int i = reach.first[j], end = reach.last[j]; i < end; i += 8)
		{
			Int8 low{}, high{}, l, h;
			if (plus) integersAt<magnitude>(*after, i, y, dy, low, high);
			if (minus)
			{
				integersAt<magnitude>(*before, i, oldY, oldDy, l, h);
				low -= l;
				if (magnitude != Magnitude::small) high -= h;
			}
			// What overflows here does so by whole multiples of 2^32: the difference itself fits.
			if (magnitude == Magnitude::smallDifference)
				low = (Int8)((Word8)low + ((Word8)high << NodeChanges::highShift));
			*reinterpret_cast<UnalignedInt8*>(lowRow + i) += low;
			if (wide) *reinterpret_cast<UnalignedInt8*>(highRow + i) += high;
		}
		if (wide) highRow += stride;
	}
}

template <Magnitude magnitude>
inline void addRowsOf(const NodeChanges& to, const KernelReach& reach, const KernelProfile* after,
					  const KernelProfile* before)
{
	if (after && before)
		addRows<true, true, magnitude>(to, reach, after, before);
	else if (after)
		addRows<true, false, magnitude>(to, reach, after, before);
	else if (before)
		addRows<false, true, magnitude>(to, reach, after, before);
}

inline void addChangesImpl(const NodeChanges& to, Magnitude magnitude, const KernelReach& reach,
						   const KernelProfile* after, const KernelProfile* before)
{
	switch (magnitude)
	{
		case Magnitude::small:
			return addRowsOf<Magnitude::small>(to, reach, after, before);
		case Magnitude::smallDifference:
			return addRowsOf<Magnitude::smallDifference>(to, reach, after, before);
		case Magnitude::large:
			return addRowsOf<Magnitude::large>(to, reach, after, before);
	}
}

inline bool isAnySet(const Int8& v)
{
	typedef std::int64_t Int4 __attribute__((vector_size(32)));
	const Int4 w = (Int4)v;
	return ((w[0] | w[1]) | (w[2] | w[3])) != 0;
}

inline bool areChangedImpl(const NodeChanges& changes, bool wide)
{
	Int8 any{};
	for (int row = 0; row < nodesPerBlock; row++)
		for (int i = 0; i < nodesPerBlock; i += 8)
		{
			any |= *reinterpret_cast<const UnalignedInt8*>(changes.low + row * changes.stride + i);
			if (wide) any |= *reinterpret_cast<const UnalignedInt8*>(changes.high + row * changes.stride + i);
		}
	return isAnySet(any);
}

template <bool wide>
inline bool applyRows(const NodeChanges& changes, std::int64_t* nodes)
{
	typedef std::int64_t Int4 __attribute__((vector_size(32)));
	typedef Int4 UnalignedInt4 __attribute__((aligned(8), may_alias));
	typedef std::int32_t Half4 __attribute__((vector_size(16)));
	typedef Half4 UnalignedHalf4 __attribute__((aligned(4), may_alias));
	std::int32_t *low = changes.low, *high = changes.high;
	const int stride = changes.stride;
	Int4 any{};
	for (int row = 0; row < nodesPerBlock; row++, nodes += nodesPerBlock, low += stride)
	{
		for (int i = 0; i < nodesPerBlock; i += 4)
		{
			UnalignedHalf4& change = *reinterpret_cast<UnalignedHalf4*>(low + i);
			UnalignedInt4& node = *reinterpret_cast<UnalignedInt4*>(nodes + i);
			Int4 sum = node + __builtin_convertvector((Half4)change, Int4);
			change = Half4{};
			if (wide)
			{
				UnalignedHalf4& rest = *reinterpret_cast<UnalignedHalf4*>(high + i);
				sum += __builtin_convertvector((Half4)rest, Int4) * (std::int64_t(1) << NodeChanges::highShift);
				rest = Half4{};
			}
			node = sum;
			any |= sum;
		}
		if (wide) high += stride;
	}
	return isAnySet((Int8)any);
}

inline bool applyChangesImpl(const NodeChanges& changes, bool wide, std::int64_t* nodes)
{
	return wide ? applyRows<true>(changes, nodes) : applyRows<false>(changes, nodes);
}

/** The integers as double precision numbers, rounded to the nearest. */
inline void toDouble(const std::int64_t* from, Double4& result)
{
	typedef std::uint64_t Word4 __attribute__((vector_size(32)));
	typedef Word4 UnalignedWord4 __attribute__((aligned(8), may_alias));
	// The halves of the words as the last bits of 2^52 and of 2^84 + 2^63: only the last sum rounds.
	const Word4 v = *reinterpret_cast<const UnalignedWord4*>(from);
	const Word4 low = (v & 0xffffffffu) | 0x4330000000000000u, high = (v >> 32) ^ 0x4530000080000000u;
	result = ((Double4)high - (0x1p84 + 0x1p63 + 0x1p52)) + (Double4)low;
}

inline void copyNodesImpl(const std::int64_t* nodes, float* to, int stride)
{
	typedef Float4 UnalignedFloat4 __attribute__((aligned(4), may_alias));
	for (int row = 0; row < nodesPerBlock; row++)
		for (int column = 0; column < nodesPerBlock; column += 4)
		{
			Double4 value;
			toDouble(nodes + row * nodesPerBlock + column, value);
			*reinterpret_cast<UnalignedFloat4*>(to + row * stride + column) =
				__builtin_convertvector(value * (1 / nodesPerKernel), Float4);
		}
}

/** interpolation_table.h and its derivatives with respect to the place in sigma, highest power first. */
struct InterpolationWeights
{
	alignas(32) float c[4][interpolationDegree + 1][8] = {};
	constexpr InterpolationWeights()
	{
		double scale = 1;
		for (int order = 0; order < 4; order++, scale *= nodesPerSigma)
			for (int k = order; k <= interpolationDegree; k++)
				for (int tap = 0; tap < 8; tap++)
				{
					double factor = scale;
					for (int i = 0; i < order; i++) factor *= k - i;
					c[order][interpolationDegree - k][tap] = float(factor * interpolationTable[k][tap]);
				}
	}
};
constexpr InterpolationWeights interpolationWeights;

/** Weights of the taps for the derivatives of order 0 to 3. */
inline void tapWeights(const Float8& u, Float8 (&w)[4])
{
	for (int order = 0; order < 4; order++)
	{
		const auto& c = interpolationWeights.c[order];
		w[order] = *at(c[0]);
		for (int k = 1; k <= interpolationDegree - order; k++) w[order] = w[order] * u + *at(c[k]);
	}
}

// The same instruction has one name with GCC before 12, another with clang.
#ifdef __clang__
#define RIDGEMAP_SHUFFLE(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#else
#define RIDGEMAP_SHUFFLE(a, b, ...) __builtin_shuffle(a, b, Int8{__VA_ARGS__})
#endif

/** Sums over the lanes of eight vectors: lane order 0, 2, 4, 6, 1, 3, 5, 7. */
inline void laneSums(const Float8 (&v)[8], Float8& result)
{
	Float8 half[4], quarter[2];
	for (int i = 0; i < 4; i++)
		half[i] = RIDGEMAP_SHUFFLE(v[2 * i], v[2 * i + 1], 0, 1, 2, 3, 8, 9, 10, 11) +
				  RIDGEMAP_SHUFFLE(v[2 * i], v[2 * i + 1], 4, 5, 6, 7, 12, 13, 14, 15);
	for (int i = 0; i < 2; i++)
		quarter[i] = RIDGEMAP_SHUFFLE(half[2 * i], half[2 * i + 1], 0, 1, 8, 9, 4, 5, 12, 13) +
					 RIDGEMAP_SHUFFLE(half[2 * i], half[2 * i + 1], 2, 3, 10, 11, 6, 7, 14, 15);
	result = RIDGEMAP_SHUFFLE(quarter[0], quarter[1], 0, 2, 8, 10, 4, 6, 12, 14) +
			 RIDGEMAP_SHUFFLE(quarter[0], quarter[1], 1, 3, 9, 11, 5, 7, 13, 15);
}
#undef RIDGEMAP_SHUFFLE

inline KernelSums interpolateSquare(const float* corner, int stride, const Float8 (&x)[4], const Float8 (&y)[4])
{
	Float8 r0{}, r1{}, r2{}, r3{};  // derivatives along y of every column
	for (int row = 0; row < 8; row++)
	{
		const Float8 nodes = *at(corner + row * stride);
		r0 += y[0][row] * nodes;
		r1 += y[1][row] * nodes;
		r2 += y[2][row] * nodes;
		r3 += y[3][row] * nodes;
	}
	Float8 a, b;
	laneSums({x[0] * r0, x[1] * r0, x[0] * r1, x[2] * r0, x[1] * r1, x[0] * r2, x[3] * r0, x[0] * r3}, a);
	laneSums({x[2] * r1, x[1] * r2, Float8{}, Float8{}, Float8{}, Float8{}, Float8{}, Float8{}}, b);
	KernelSums s;
	s.value = a[0];
	s.gx = a[4];
	s.gy = a[1];
	s.hxx = a[5];
	s.hxy = a[2];
	s.hyy = a[6];
	s.txxx = a[3];
	s.tyyy = a[7];
	s.txxy = b[0];
	s.txyy = b[4];
	return s;
}

inline void interpolateNodesImpl(const NodeSquare* squares, std::size_t count, int stride, float tx, float ty)
{
	Float8 x[4], y[4];
	tapWeights(Float8{} + (tx - 0.5f), x);
	tapWeights(Float8{} + (ty - 0.5f), y);
	for (const NodeSquare* s = squares; s != squares + count; ++s)
		*s->sums = interpolateSquare(s->corner, stride, x, y);
}
}  // namespace
}  // namespace ridgemap
