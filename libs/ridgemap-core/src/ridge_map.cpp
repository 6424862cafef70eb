// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <mutex>
#include <set>
#include <stdexcept>

#include "chains.h"
#include "field.h"
#include "lattice.h"
#include "stopwatch.h"
#include "tile_update.h"
#include "wall_maker.h"

namespace ridgemap
{
struct RidgeMap::Impl
{
	explicit Impl(const Options& o) : options((o.validate(), o)), lattice(o), wallMaker(o) {}
	Impl(const Impl& o)
		: options(o.options),
		  threads(o.threads),
		  version(o.version),
		  lattice(o.lattice),
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
	Chains chains;
	WallMaker wallMaker;
	UpdateResult untold;  ///< of updates that queries made
	std::vector<Polyline> ridges, walls;
	bool ridgesMade = false, wallsMade = false;
	std::mutex mutex;  ///< guards everything that const queries make on demand
};

StepTimes& StepTimes::operator+=(const StepTimes& o)
{
	kernels += o.kernels;
	borders += o.borders;
	crossings += o.crossings;
	seeds += o.seeds;
	chains += o.chains;
	return *this;
}

UpdateResult& UpdateResult::operator+=(const UpdateResult& o)
{
	regions.insert(regions.end(), o.regions.begin(), o.regions.end());
	// What appeared and vanished again in between is nobody's business.
	const std::set<PolylineId> ours(appeared.begin(), appeared.end());
	std::set<PolylineId> passing;
	for (const PolylineId id : o.vanished) (ours.count(id) ? (void)passing.insert(id) : vanished.push_back(id));
	appeared.erase(
		std::remove_if(appeared.begin(), appeared.end(), [&](PolylineId id) { return passing.count(id) > 0; }),
		appeared.end());
	appeared.insert(appeared.end(), o.appeared.begin(), o.appeared.end());
	for (std::size_t i = 0; i < stops.size(); i++) stops[i] += o.stops[i];
	tiles += o.tiles;
	evaluations += o.evaluations;
	kernels += o.kernels;
	seeds += o.seeds;
	traces += o.traces;
	seconds += o.seconds;
	return *this;
}

RidgeMap::RidgeMap(const Options& options) : impl_(std::make_unique<Impl>(options)) {}
RidgeMap::~RidgeMap() = default;
RidgeMap::RidgeMap(const RidgeMap& o)
{
	const std::lock_guard<std::mutex> lock(o.impl_->mutex);
	impl_ = std::make_unique<Impl>(*o.impl_);
}
RidgeMap& RidgeMap::operator=(const RidgeMap& o)
{
	if (this != &o) *this = RidgeMap(o);
	return *this;
}
RidgeMap::RidgeMap(RidgeMap&&) noexcept = default;
RidgeMap& RidgeMap::operator=(RidgeMap&&) noexcept = default;

const Options& RidgeMap::options() const
{
	return impl_->options;
}

void RidgeMap::insert(const std::vector<Measurement>& measurements)
{
	impl_->lattice.insert(measurements);
	impl_->changed();
}

void RidgeMap::erase(const std::vector<Measurement>& measurements)
{
	impl_->lattice.erase(measurements);
	impl_->changed();
}

void RidgeMap::merge(const RidgeMap& other)
{
	impl_->requireSameOptions(*other.impl_, "merge with");
	{
		const std::lock_guard<std::mutex> lock(other.impl_->mutex);
		impl_->lattice.merge(other.impl_->lattice);
	}
	impl_->changed();
}

void RidgeMap::subtract(const RidgeMap& other)
{
	impl_->requireSameOptions(*other.impl_, "subtract");
	{
		const std::lock_guard<std::mutex> lock(other.impl_->mutex);
		impl_->lattice.subtract(other.impl_->lattice);
	}
	impl_->changed();
}

void RidgeMap::clear()
{
	impl_->lattice.clear();
	impl_->chains.clear();
	impl_->changed();
}

bool RidgeMap::empty() const
{
	return impl_->lattice.measurements() == 0;
}

UpdateResult RidgeMap::update(unsigned threads)
{
	const std::lock_guard<std::mutex> lock(impl_->mutex);
	UpdateResult result = std::move(impl_->untold);
	impl_->untold = UpdateResult();
	result += impl_->update(threads);
	return result;
}

void RidgeMap::setThreads(unsigned threads)
{
	impl_->threads = threads > 0 ? threads : 1;
}

const std::vector<Polyline>& RidgeMap::ridges() const
{
	Impl& m = *impl_;
	const std::lock_guard<std::mutex> lock(m.mutex);
	m.updateForQuery();
	if (!m.ridgesMade)
	{
		m.ridges.clear();
		for (const LinePtr& line : m.chains.lines(m.lattice.tiles(), m.lattice.frame())) m.ridges.push_back(*line);
		m.ridgesMade = true;
	}
	return m.ridges;
}

Polyline RidgeMap::ridge(PolylineId id) const
{
	Impl& m = *impl_;
	const std::lock_guard<std::mutex> lock(m.mutex);
	return m.chains.polyline(id, m.lattice.tiles(), m.lattice.frame());
}

const std::vector<Polyline>& RidgeMap::walls() const
{
	Impl& m = *impl_;
	const std::lock_guard<std::mutex> lock(m.mutex);
	m.updateForQuery();
	if (!m.wallsMade)
	{
		m.walls = m.wallMaker.make(m.chains.lines(m.lattice.tiles(), m.lattice.frame()));
		m.wallsMade = true;
	}
	return m.walls;
}

std::uint64_t RidgeMap::version() const
{
	return impl_->version;
}

OccupancySample RidgeMap::occupancy(const Point2& p) const
{
	Impl& m = *impl_;
	const std::lock_guard<std::mutex> lock(m.mutex);
	m.updateForQuery();
	OccupancySample o;
	if (!(std::abs(p.x) <= maxCoordinate && std::abs(p.y) <= maxCoordinate)) return o;
	const KernelSums s = sumOfCells(m.lattice.tiles(), m.options, m.lattice.frame().toLattice(p));

	// Rotate to the map frame: derivatives along the map's axes, which in the lattice frame are x' and y'.
	const Vec2 a = Frame::rotateToLattice({1, 0}), b = Frame::rotateToLattice({0, 1});
	const auto second = [&](Vec2 u, Vec2 v)
	{ return s.hxx * u.x * v.x + s.hxy * (u.x * v.y + u.y * v.x) + s.hyy * u.y * v.y; };
	const auto third = [&](Vec2 u, Vec2 v, Vec2 w)
	{
		return u.x * (s.txxx * v.x * w.x + s.txxy * (v.x * w.y + v.y * w.x) + s.txyy * v.y * w.y) +
			   u.y * (s.txxy * v.x * w.x + s.txyy * (v.x * w.y + v.y * w.x) + s.tyyy * v.y * w.y);
	};
	const double i1 = 1 / m.options.sigma, i2 = i1 * i1, i3 = i2 * i1;
	o.value = s.value;
	o.gx = i1 * dot({s.gx, s.gy}, a);
	o.gy = i1 * dot({s.gx, s.gy}, b);
	o.hxx = i2 * second(a, a);
	o.hxy = i2 * second(a, b);
	o.hyy = i2 * second(b, b);
	o.txxx = i3 * third(a, a, a);
	o.txxy = i3 * third(a, a, b);
	o.txyy = i3 * third(a, b, b);
	o.tyyy = i3 * third(b, b, b);
	return o;
}

Box2 RidgeMap::boundingBox() const
{
	const std::lock_guard<std::mutex> lock(impl_->mutex);
	return impl_->lattice.boundingBox();
}

MapStatistics RidgeMap::statistics() const
{
	Impl& m = *impl_;
	const std::lock_guard<std::mutex> lock(m.mutex);
	m.updateForQuery();
	const TileStore& tiles = m.lattice.tiles();
	MapStatistics s;
	s.measurements = m.lattice.measurements();
	s.bytes = sizeof(Impl);
	for (const TileKey& key : tiles.keys())
	{
		const Tile& tile = *tiles.find(key);
		s.tiles++;
		s.cells += tile.cellCount;
		s.bytes += sizeof(Tile);
		for (const Block& b : tile.blocks) s.bytes += b.memoryBytes();
		for (const Edge* e : {&tile.bottom, &tile.left})
			s.bytes += e->path.capacity() * sizeof(Vec2) + e->crossings.capacity() * sizeof(Crossing);
		s.bytes += tile.stubs.capacity() * sizeof(PieceEnd);
		for (const Piece& p : tile.pieces)
		{
			s.bytes += sizeof(Piece) + p.nodes.capacity() * sizeof(RidgeNode);
			s.stops[std::size_t(p.start.reason)]++;
			s.stops[std::size_t(p.end.reason)]++;
		}
		s.unstitchedCrossings += countUnstitched(tiles, key);
	}
	return s;
}

std::vector<CellRecord> RidgeMap::cells() const
{
	const std::lock_guard<std::mutex> lock(impl_->mutex);
	return impl_->lattice.cells();
}
std::vector<Point2> RidgeMap::cellCentroids() const
{
	const std::lock_guard<std::mutex> lock(impl_->mutex);
	return impl_->lattice.centroids();
}

void RidgeMap::insertCells(const std::vector<CellRecord>& cells)
{
	impl_->lattice.insertCells(cells);
	impl_->changed();
}

}  // namespace ridgemap
