// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <vector>

namespace ridgemap
{
/** The polylines with a vertex more wherever the end of an open polyline lies within a nanometre of the inside of a
 * segment of another one. */
std::vector<Polyline> withJunctions(const std::vector<Polyline>& lines);

/** For every vertex of every polyline, whether an end of an open polyline, its own included, lies there. */
std::vector<std::vector<bool>> junctionVertices(const std::vector<Polyline>& lines);

}  // namespace ridgemap
