// SPDX-License-Identifier: BSD-3-Clause
// Compiled with AVX2 enabled; called only where the processor has it.
#include "kernel_sum_impl.h"

namespace ridgemap
{
KernelSums sumKernelsAvx2(const BlockView* views, std::size_t count)
{
	return sumKernelsImpl(views, count);
}
}  // namespace ridgemap
