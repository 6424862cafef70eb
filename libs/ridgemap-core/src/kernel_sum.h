// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "kernel_block.h"

namespace ridgemap
{
/** The kernels of one block as seen from a query point: the point relative to the block centre [sigma]. */
struct BlockView
{
	const KernelGroup* groups = nullptr;
	std::size_t count = 0;  ///< number of groups of eight
	float dx = 0, dy = 0;
};

/** Sums of all kernels and of their derivatives, equations (2)-(4) and the third derivatives; unit sigma, kernels. Not
 * zero unless it is made so. */
struct KernelSums
{
	double value;
	double gx, gy;
	double hxx, hxy, hyy;
	double txxx, txxy, txyy, tyyy;

	/** Adds `weight` times other sums. */
	void add(const KernelSums& o, double weight)
	{
		value += weight * o.value;
		gx += weight * o.gx;
		gy += weight * o.gy;
		hxx += weight * o.hxx;
		hxy += weight * o.hxy;
		hyy += weight * o.hyy;
		txxx += weight * o.txxx;
		txxy += weight * o.txxy;
		txyy += weight * o.txyy;
		tyyy += weight * o.tyyy;
	}
};

/** Sums the kernels of the given blocks. Every lane adds in the order of the blocks and groups and the lanes are added
 * in a fixed tree, with IEEE single-precision operations that are never contracted: the same bits on every machine.
 * The fastest variant that the processor has is chosen at run time. */
KernelSums sumKernels(const BlockView* views, std::size_t count);

}  // namespace ridgemap
