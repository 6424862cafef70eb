// SPDX-License-Identifier: BSD-3-Clause
// What the parts of RidgeMap share.
#pragma once

#include <ridgemap/ridge_map.h>

#include <mutex>
#include <stdexcept>
#include <string>

#include "chains.h"
#include "free_space.h"
#include "lattice.h"
#include "stopwatch.h"
#include "tile_update.h"
#include "wall_maker.h"

namespace ridgemap
{
struct RidgeMap::Impl
{
	explicit Impl(const Options& o) : options((o.validate(), o)), lattice(o), freeSpace(o), wallMaker(o) {}
	Impl(const Impl& o)
		: options(o.options),
		  threads(o.threads),
		  version(o.version),
		  lattice(o.lattice),
		  freeSpace(o.freeSpace),
		  chains(o.chains),
		  wallMaker(o.wallMaker),
		  untold(o.untold),
		  ridges(o.ridges),
		  walls(o.walls),
		  ridgesMade(o.ridgesMade),
		  wallsMade(o.wallsMade)
	{
	}

	/** Brings the polylines up to date for a query; what happened is told by the next RidgeMap::update(). */
	void updateForQuery()
	{
		untold += update(threads);
		if (untold.regions.size() <= 64) return;
		UpdateRegion all;
		for (const UpdateRegion& r : untold.regions)
		{
			all.box.extend(r.box);
			all.tiles += r.tiles;
		}
		untold.regions.assign(1, all);
	}

	UpdateResult update(unsigned threadCount)
	{
		UpdateResult result;
		if (!lattice.hasChanged() && !chains.hasCleared()) return result;
		const std::vector<ReplacedTile> replaced = updateTiles(lattice, options, threadCount, result);
		const Stopwatch watch;
		chains.update(lattice.tiles(), replaced, result);
		result.seconds.chains = watch.seconds();
		ridgesMade = wallsMade = false;
		return result;
	}

	void changed()
	{
		version++;
		ridgesMade = wallsMade = false;
	}

	void requireSameOptions(const Impl& o, const char* what) const
	{
		if (options != o.options)
			throw std::invalid_argument(std::string("ridge map: cannot ") + what +
										" a map with other options; build both with the same options");
	}

	Options options;
	unsigned threads = 1;
	std::uint64_t version = 0;
	Lattice lattice;
	FreeSpace freeSpace;
	Chains chains;
	WallMaker wallMaker;
	UpdateResult untold;  ///< of updates that queries made
	std::vector<Polyline> ridges, walls;
	bool ridgesMade = false, wallsMade = false;
	std::mutex mutex;  ///< guards everything that const queries make on demand
};

}  // namespace ridgemap
