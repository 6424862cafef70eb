// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "free_ray.h"

namespace ridgemap::test
{
/** Calls fn(cx, cy) once for all cells of the walk of a ray, as RayWalk defines them. */
template <class Fn>
void forEachCell(const LatticeRay& ray, Fn fn)
{
	const RayWalk walk(ray);
	const auto visit = [&](std::int64_t column, std::int64_t row) { walk.steep() ? fn(row, column) : fn(column, row); };
	for (std::int64_t column = walk.firstColumn(); column <= walk.lastColumn(); column++)
	{
		const std::int64_t row = walk.rowAt(column), leaving = walk.rowAt(column + 1);
		visit(column, row);
		if (leaving != row) visit(column, leaving);
	}
}

}  // namespace ridgemap::test
