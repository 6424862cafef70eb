// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <vector>

#include "byte_stream.h"

namespace ridgemap
{
/** What a frozen map keeps of polylines: points on a grid of 2^-20 m (about a micrometre), nothing else. Points that
 * fall together become one; what is then no line any more is left out. Throws std::invalid_argument for coordinates
 * that are not finite or beyond +-1e9 m. */
std::vector<Polyline> toFrozen(const std::vector<Polyline>& lines);

/** Stores what toFrozen() gave, as differences: three to four bytes a coordinate of a usual map. */
void writeFrozen(ByteWriter& out, const std::vector<Polyline>& lines);

/** Reads it; throws std::runtime_error for data that writeFrozen() cannot have written. */
std::vector<Polyline> readFrozen(ByteReader& in);

}  // namespace ridgemap
