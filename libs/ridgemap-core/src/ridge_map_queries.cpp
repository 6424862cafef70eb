// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/ridge_map.h>

#include <cmath>

#include "field.h"
#include "free_cut.h"
#include "ridge_map_impl.h"
#include "walls.h"

namespace ridgemap
{
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
		m.walls = m.wallMaker.make(m.chains.lines(m.lattice.tiles(), m.lattice.frame()), m.freeSpace);
		m.wallsMade = true;
	}
	return m.walls;
}

std::vector<Polyline> RidgeMap::clearedWalls() const
{
	const std::vector<Polyline>& source = ridges();
	return clearedFromWalls(source, impl_->freeSpace, impl_->options);
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

SpaceSample RidgeMap::space(const Point2& p) const
{
	SpaceSample s;
	if (!(std::abs(p.x) <= maxCoordinate && std::abs(p.y) <= maxCoordinate)) return s;
	const OccupancySample o = occupancy(p);
	const Vec2 q = impl_->freeSpace.frame().toLattice(p);
	// The density falls off fastest along the normal: the direction of least curvature runs along the surface.
	const double half = 0.5 * (o.hxx - o.hyy), radius = std::sqrt(half * half + o.hxy * o.hxy);
	const Vec2 along = half >= 0 ? unit({half + radius, o.hxy}) : unit({o.hxy, radius - half});
	s.passes = impl_->freeSpace.interpolated(q)[0];
	s.across = passesAcross(impl_->freeSpace, q, Frame::rotateToLattice(along));
	s.hits = hitsOf(o.value);
	const Options& options = impl_->options;
	if (o.value >= options.lTol && s.hits >= options.freeSpaceTau * (s.hits + s.across))
		s.state = SpaceState::occupied;
	else if (s.passes > options.freeSpaceLeast)
		s.state = SpaceState::free;
	return s;
}

double RidgeMap::passes(const Point2& p) const
{
	if (!(std::abs(p.x) <= maxCoordinate && std::abs(p.y) <= maxCoordinate)) return 0;
	return impl_->freeSpace.interpolated(impl_->freeSpace.frame().toLattice(p))[0];
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
	s.freeCells = m.freeSpace.cellCount();
	s.freeBytes = m.freeSpace.memoryBytes();
	s.bytes = sizeof(Impl) + s.freeBytes;
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

bool RidgeMap::passedAnywhere() const
{
	return !impl_->freeSpace.empty();
}

std::vector<Point2> RidgeMap::freeCellCentres(double least) const
{
	const double edge = double(LatticeRay::cellSigmas);
	std::vector<Point2> centres;
	for (const FreeCellRecord& c : freeCells())
		if (double(c.n) > least)
			centres.push_back(
				impl_->freeSpace.frame().toMap({(double(c.cx) + 0.5) * edge, (double(c.cy) + 0.5) * edge}));
	return centres;
}

std::vector<FreeCellRecord> RidgeMap::freeCells() const
{
	return impl_->freeSpace.cells();
}

}  // namespace ridgemap
