// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_sum.h"

#include "kernel_sum_impl.h"

namespace ridgemap
{
#ifdef RIDGEMAP_HAVE_AVX2_UNIT
KernelSums sumKernelsAvx2(const BlockView* views, std::size_t count);
void makeProfileAvx2(const KernelShape& shape, const KernelReach& reach, KernelProfile& profile);
void addChangesAvx2(const NodeChanges& to, Magnitude magnitude, const KernelReach& reach, const KernelProfile* after,
					const KernelProfile* before);
bool areChangedAvx2(const NodeChanges& changes, bool wide);
bool applyChangesAvx2(const NodeChanges& changes, bool wide, std::int64_t* nodes);
void copyNodesAvx2(const std::int64_t* nodes, float* to, int stride);
void interpolateNodesAvx2(const NodeSquare* squares, std::size_t count, int stride, float tx, float ty);

namespace
{
const bool hasAvx2 = __builtin_cpu_supports("avx2");
}

KernelSums sumKernels(const BlockView* views, std::size_t count)
{
	return hasAvx2 ? sumKernelsAvx2(views, count) : sumKernelsImpl(views, count);
}

void makeProfile(const KernelShape& shape, const KernelReach& reach, KernelProfile& profile)
{
	return (hasAvx2 ? makeProfileAvx2 : makeProfileImpl)(shape, reach, profile);
}

void addChanges(const NodeChanges& to, Magnitude magnitude, const KernelReach& reach, const KernelProfile* after,
				const KernelProfile* before)
{
	return (hasAvx2 ? addChangesAvx2 : addChangesImpl)(to, magnitude, reach, after, before);
}

bool areChanged(const NodeChanges& changes, bool wide)
{
	return (hasAvx2 ? areChangedAvx2 : areChangedImpl)(changes, wide);
}

bool applyChanges(const NodeChanges& changes, bool wide, std::int64_t* nodes)
{
	return (hasAvx2 ? applyChangesAvx2 : applyChangesImpl)(changes, wide, nodes);
}

void copyNodes(const std::int64_t* nodes, float* to, int stride)
{
	(hasAvx2 ? copyNodesAvx2 : copyNodesImpl)(nodes, to, stride);
}

void interpolateNodes(const NodeSquare* squares, std::size_t count, int stride, float tx, float ty)
{
	(hasAvx2 ? interpolateNodesAvx2 : interpolateNodesImpl)(squares, count, stride, tx, ty);
}
#else
KernelSums sumKernels(const BlockView* views, std::size_t count)
{
	return sumKernelsImpl(views, count);
}

void makeProfile(const KernelShape& shape, const KernelReach& reach, KernelProfile& profile)
{
	return makeProfileImpl(shape, reach, profile);
}

void addChanges(const NodeChanges& to, Magnitude magnitude, const KernelReach& reach, const KernelProfile* after,
				const KernelProfile* before)
{
	return addChangesImpl(to, magnitude, reach, after, before);
}

bool areChanged(const NodeChanges& changes, bool wide)
{
	return areChangedImpl(changes, wide);
}

bool applyChanges(const NodeChanges& changes, bool wide, std::int64_t* nodes)
{
	return applyChangesImpl(changes, wide, nodes);
}

void copyNodes(const std::int64_t* nodes, float* to, int stride)
{
	copyNodesImpl(nodes, to, stride);
}

void interpolateNodes(const NodeSquare* squares, std::size_t count, int stride, float tx, float ty)
{
	interpolateNodesImpl(squares, count, stride, tx, ty);
}
#endif
}  // namespace ridgemap
