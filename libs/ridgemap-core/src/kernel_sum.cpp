// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_sum.h"

#include "kernel_sum_impl.h"

namespace ridgemap
{
#ifdef RIDGEMAP_HAVE_AVX2_UNIT
KernelSums sumKernelsAvx2(const BlockView* views, std::size_t count);

KernelSums sumKernels(const BlockView* views, std::size_t count)
{
	static const bool avx2 = __builtin_cpu_supports("avx2");
	return avx2 ? sumKernelsAvx2(views, count) : sumKernelsImpl(views, count);
}
#else
KernelSums sumKernels(const BlockView* views, std::size_t count)
{
	return sumKernelsImpl(views, count);
}
#endif
}  // namespace ridgemap
