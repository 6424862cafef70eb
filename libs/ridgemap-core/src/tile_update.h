// SPDX-License-Identifier: BSD-3-Clause
// The update of the map (paper section IV): which tiles a change touches, and their new polylines.
#pragma once

#include <ridgemap/ridge_map.h>

#include <vector>

#include "chains.h"
#include "lattice.h"

namespace ridgemap
{
/** Recomputes all tiles that depend on changed cells. Adds its figures to `result`; returns the tiles whose pieces
 * became different. */
std::vector<ReplacedTile> updateTiles(Lattice& lattice, const Options& options, unsigned threads, UpdateResult& result);

}  // namespace ridgemap
