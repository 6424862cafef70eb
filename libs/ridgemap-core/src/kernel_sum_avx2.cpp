// SPDX-License-Identifier: BSD-3-Clause
// Compiled with AVX2 enabled; called only where the processor has it.
#include "kernel_sum_impl.h"

namespace ridgemap
{
KernelSums sumKernelsAvx2(const BlockView* views, std::size_t count)
{
	return sumKernelsImpl(views, count);
}

void addToNodesAvx2(std::int64_t* nodes, const KernelWindow& window, int originX, int originY, int y0, int y1)
{
	addToNodesImpl(nodes, window, originX, originY, y0, y1);
}

void copyNodesAvx2(const std::int64_t* nodes, float* to, int stride)
{
	copyNodesImpl(nodes, to, stride);
}

KernelSums interpolateNodesAvx2(const float* corner, int stride, float tx, float ty)
{
	return interpolateNodesImpl(corner, stride, tx, ty);
}
}  // namespace ridgemap
