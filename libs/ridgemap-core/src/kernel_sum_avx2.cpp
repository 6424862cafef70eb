// SPDX-License-Identifier: BSD-3-Clause
// Compiled with AVX2 enabled; called only where the processor has it.
#include "kernel_sum_impl.h"

namespace ridgemap
{
KernelSums sumKernelsAvx2(const BlockView* views, std::size_t count)
{
	return sumKernelsImpl(views, count);
}

void makeProfileAvx2(const KernelShape& shape, const KernelReach& reach, KernelProfile& profile)
{
	return makeProfileImpl(shape, reach, profile);
}

void addChangesAvx2(const NodeChanges& to, Magnitude magnitude, const KernelReach& reach, const KernelProfile* after,
					const KernelProfile* before)
{
	return addChangesImpl(to, magnitude, reach, after, before);
}

bool areChangedAvx2(const NodeChanges& changes, bool wide)
{
	return areChangedImpl(changes, wide);
}

bool applyChangesAvx2(const NodeChanges& changes, bool wide, std::int64_t* nodes)
{
	return applyChangesImpl(changes, wide, nodes);
}

void copyNodesAvx2(const std::int64_t* nodes, float* to, int stride)
{
	copyNodesImpl(nodes, to, stride);
}

void interpolateNodesAvx2(const NodeSquare* squares, std::size_t count, int stride, float tx, float ty)
{
	interpolateNodesImpl(squares, count, stride, tx, ty);
}
}  // namespace ridgemap
