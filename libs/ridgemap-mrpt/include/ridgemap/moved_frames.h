// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CSimpleMap.h>
#include <ridgemap/CRidgeMap2D.h>

namespace ridgemap
{
/** What moveFrames() did. */
struct MovedFrames
{
	std::size_t moved = 0;  ///< frames whose pose changed
	std::size_t kept = 0;   ///< frames that were not touched
};

/** Brings a map that was built from the frames of `before` to the poses of `after`, which holds the same observations,
 * for instance after a loop was closed. Only frames whose mean pose changed are touched; the map is then the one built
 * from `after` from scratch, to the bit. O(measurements that move), and as many tiles to update.
 *
 * Throws std::invalid_argument, with the map as before, if the two hold different numbers of frames or observations;
 * std::exception if the map does not hold the observations of `before`: the frames up to that one have moved then. */
MovedFrames moveFrames(CRidgeMap2D& map, const mrpt::maps::CSimpleMap& before, const mrpt::maps::CSimpleMap& after);

}  // namespace ridgemap
