// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernel_block.h"

namespace ridgemap
{
/** Makes the kernels of a block from its cells. Neighbouring cells, four at a time and up to an edge of sigma, share
 * one kernel where that cannot be felt: where the moments beyond the second, which a kernel does not have, are small
 * against all that the block holds. So the number of kernels stays bounded by the surface while measurements pile up.
 */
void makeKernels(Block& block, const CellGrid& grid);

}  // namespace ridgemap
