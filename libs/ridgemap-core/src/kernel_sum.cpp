// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_sum.h"

#include "kernel_sum_impl.h"

namespace ridgemap
{
#ifdef RIDGEMAP_HAVE_AVX2_UNIT
KernelSums sumKernelsAvx2(const BlockView* views, std::size_t count);
void addToNodesAvx2(std::int64_t* nodes, const KernelWindow& window, int originX, int originY, int y0, int y1);
void copyNodesAvx2(const std::int64_t* nodes, float* to, int stride);
KernelSums interpolateNodesAvx2(const float* corner, int stride, float tx, float ty);

namespace
{
const bool hasAvx2 = __builtin_cpu_supports("avx2");
}

KernelSums sumKernels(const BlockView* views, std::size_t count)
{
	return hasAvx2 ? sumKernelsAvx2(views, count) : sumKernelsImpl(views, count);
}

void addToNodes(std::int64_t* nodes, const KernelWindow& window, int originX, int originY, int y0, int y1)
{
	(hasAvx2 ? addToNodesAvx2 : addToNodesImpl)(nodes, window, originX, originY, y0, y1);
}

void copyNodes(const std::int64_t* nodes, float* to, int stride)
{
	(hasAvx2 ? copyNodesAvx2 : copyNodesImpl)(nodes, to, stride);
}

KernelSums interpolateNodes(const float* corner, int stride, float tx, float ty)
{
	return hasAvx2 ? interpolateNodesAvx2(corner, stride, tx, ty) : interpolateNodesImpl(corner, stride, tx, ty);
}
#else
KernelSums sumKernels(const BlockView* views, std::size_t count)
{
	return sumKernelsImpl(views, count);
}

void addToNodes(std::int64_t* nodes, const KernelWindow& window, int originX, int originY, int y0, int y1)
{
	addToNodesImpl(nodes, window, originX, originY, y0, y1);
}

void copyNodes(const std::int64_t* nodes, float* to, int stride)
{
	copyNodesImpl(nodes, to, stride);
}

KernelSums interpolateNodes(const float* corner, int stride, float tx, float ty)
{
	return interpolateNodesImpl(corner, stride, tx, ty);
}
#endif
}  // namespace ridgemap
