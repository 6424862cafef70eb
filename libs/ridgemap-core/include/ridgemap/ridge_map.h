// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/options.h>
#include <ridgemap/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace ridgemap
{
/** Exact integer sums of the measurements in one lattice cell: all that the map keeps of them.
 * Offsets are counted from the centre of the cell in units of sigma * 2^-20, second moments in (sigma * 2^-16)^2. */
struct CellRecord
{
	std::int64_t cx = 0, cy = 0;             ///< cell index on the (rotated) lattice
	std::uint32_t bin = 0;                   ///< viewing-direction bin; 0: direction not used
	std::uint32_t n = 0;                     ///< number of measurements
	std::int64_t sx = 0, sy = 0;             ///< sums of offsets
	std::int64_t sxx = 0, sxy = 0, syy = 0;  ///< sums of products of offsets
};

/** Exact sums over the rays that passed a cell of the free-space counters: all that the map keeps of them. Cells are
 * 2 sigma wide, in the frame of the lattice. phi is the angle of a ray in that frame. */
struct FreeCellRecord
{
	std::int64_t cx = 0, cy = 0;  ///< cell index
	std::uint64_t n = 0;          ///< number of rays
	std::int64_t a = 0, b = 0;    ///< sums of round(128 cos 2 phi) and of round(128 sin 2 phi)

	friend bool operator==(const FreeCellRecord& x, const FreeCellRecord& y)
	{
		return x.cx == y.cx && x.cy == y.cy && x.n == y.n && x.a == y.a && x.b == y.b;
	}
	friend bool operator!=(const FreeCellRecord& x, const FreeCellRecord& y) { return !(x == y); }
};

/** What is known about a point of the plane. */
enum class SpaceState : std::uint8_t
{
	unknown = 0,  ///< too few rays passed, and there is no surface
	free = 1,     ///< rays passed
	occupied = 2  ///< a surface, and not outvoted by rays that passed
};

/** What is known about a point, with the figures that say so. */
struct SpaceSample
{
	SpaceState state = SpaceState::unknown;
	double passes = 0;  ///< rays that passed, interpolated between cells of 2 sigma
	double hits = 0;    ///< continuous occupancy L [kernels], comparable with passes
	double across = 0;  ///< of the passes, the sum of cos^2 of their angle to the normal of the density
};

/** One connected part of the map that an update recomputed (paper section IV, snapped to tiles). */
struct UpdateRegion
{
	Box2 box;               ///< box around the tiles of the region, map frame
	std::size_t tiles = 0;  ///< tiles in the region
};

/** Stable name of a polyline within one map object, as long as it does not change. Never used twice. */
using PolylineId = std::uint64_t;

/** Times of the steps of an update [s], by the clock on the wall, summed over the threads. */
struct StepTimes
{
	double kernels = 0;    ///< kernels made from the sums of the cells that changed
	double borders = 0;    ///< corners of tiles and the crossings of ridges with their borders: initial guesses
	double crossings = 0;  ///< ridges traced from crossings
	double seeds = 0;      ///< initial guesses from measurements, and ridges traced from them
	double chains = 0;     ///< pieces joined to polylines

	StepTimes& operator+=(const StepTimes& o);
};

/** What RidgeMap::update() did. */
struct UpdateResult
{
	std::vector<UpdateRegion> regions;                                 ///< connected groups of recomputed tiles
	std::vector<PolylineId> vanished;                                  ///< ridges that no longer exist in this form
	std::vector<PolylineId> appeared;                                  ///< ridges that are new; see RidgeMap::ridge()
	std::array<std::size_t, std::size_t(StopReason::count_)> stops{};  ///< ends of traces by reason
	std::size_t tiles = 0;                                             ///< tiles recomputed
	std::size_t evaluations = 0;                                       ///< evaluations of the continuous occupancy
	std::size_t kernels =
		0;  ///< kernels of lattice cells added to or taken from the nodes, or summed one by one (`cell` = 0)
	std::size_t seeds = 0;   ///< measurements from which a ridge was looked for
	std::size_t traces = 0;  ///< ridges that were followed, from crossings one way and from seeds both ways
	StepTimes seconds;       ///< by step

	/** Adds what happened next. Polylines that appeared here and vanished there are in neither list of the sum. */
	UpdateResult& operator+=(const UpdateResult& o);
};

/** Figures of a whole map. */
struct MapStatistics
{
	std::uint64_t measurements = 0;       ///< measurements in the map
	std::size_t cells = 0;                ///< occupied lattice cells
	std::size_t tiles = 0;                ///< tiles that hold measurements or polylines
	std::size_t bytes = 0;                ///< memory in use, estimated [bytes]
	std::size_t freeCells = 0;            ///< cells of the free-space counters that rays passed
	std::size_t freeBytes = 0;            ///< part of `bytes` that the free-space counters take [bytes]
	std::size_t unstitchedCrossings = 0;  ///< crossings of tile borders where a ridge goes on but its polyline does not
	std::array<std::size_t, std::size_t(StopReason::count_)>
		stops{};  ///< ends of the present polyline pieces by reason
};

/** A map of surfaces: polylines on the ridges of the continuous occupancy of all measurements inserted so far.
 *
 * The polylines are a pure function of the multiset of measurements and the options: order, batching, threads,
 * erased measurements and merged maps leave no trace, to the bit. The measurements are held as exact integer sums on a
 * lattice, and the rays that led to them on a coarser one, which makes insert, erase, merge and subtract exact.
 *
 * Changes (`insert`, `erase`, `merge`, `subtract`) only mark what they touch; `update()` brings the polylines up to
 * date, and every query that needs them calls it by itself.
 *
 * Thread-safety: const functions may be called from several threads at once (a pending update is done once, under a
 * lock); a non-const function needs the map for itself. */
class RidgeMap
{
 public:
	/** Throws std::invalid_argument if the options are not valid. */
	explicit RidgeMap(const Options& options = Options());
	~RidgeMap();
	RidgeMap(const RidgeMap& o);
	RidgeMap& operator=(const RidgeMap& o);
	RidgeMap(RidgeMap&& o) noexcept;
	RidgeMap& operator=(RidgeMap&& o) noexcept;

	const Options& options() const;

	/** Adds measurements, and the rays to them where the sensor is known. Throws std::invalid_argument for a coordinate
	 * that is not finite (but NaN of a sensor) or beyond +-1e6 m, and std::overflow_error when a cell would exceed
	 * 2^31; the map is then as before. O(measurements), and O(length of the rays / sigma). */
	void insert(const std::vector<Measurement>& measurements);

	/** Takes out measurements that were inserted before, given by the same numbers. Throws std::invalid_argument when
	 * the map does not hold them (as far as the sums can tell); the map is then as before. */
	void erase(const std::vector<Measurement>& measurements);

	/** Adds rays that met nothing; no effect with the option freeSpace off. Throws std::invalid_argument for
	 * coordinates beyond +-1e6 m, with the map as before. O(length of the rays / sigma). */
	void insertFreeRays(const std::vector<FreeRay>& rays);

	/** Takes out rays that were inserted before; errors as in erase(). */
	void eraseFreeRays(const std::vector<FreeRay>& rays);

	/** Adds all measurements and rays of another map with equal options (else std::invalid_argument): the same as
	 * inserting them one by one. */
	void merge(const RidgeMap& other);

	/** Takes out all measurements and rays of another map; errors as in merge() and erase(). */
	void subtract(const RidgeMap& other);

	/** Forgets all measurements and rays; options stay. */
	void clear();

	/** Neither measurements nor rays. */
	bool empty() const;

	/** Recomputes the polylines where measurements changed, and tells what changed since the last call; queries update
	 * the polylines by themselves and leave the telling to this function.
	 * @param threads number of threads to use, at least 1; the result does not depend on it. */
	UpdateResult update(unsigned threads = 1);

	/** Threads used by updates that queries start by themselves (default 1). */
	void setThreads(unsigned threads);

	/** Strict ridges: every point within eps of the true ridge, complete above L_tol. Canonical order and direction.
	 * The reference stays valid until the map changes. */
	const std::vector<Polyline>& ridges() const;

	/** One ridge by the name that update() gave it; throws std::out_of_range if it has vanished. */
	Polyline ridge(PolylineId id) const;

	/** Walls: ridges after pruning and attachment, without what rays passed through, for people and robots. The
	 * reference stays valid until the map changes. */
	const std::vector<Polyline>& walls() const;

	/** Stretches of ridges that would be in the walls, had rays not passed through them. Not cached. */
	std::vector<Polyline> clearedWalls() const;

	/** Counts changes of measurements and rays: equal values mean equal polylines in this object. For caches. */
	std::uint64_t version() const;

	/** Continuous occupancy and its derivatives at a point of the map frame, equations (2)-(4). */
	OccupancySample occupancy(const Point2& p) const;

	/** Whether a point is free, occupied or unknown: occupied where L >= L_tol and hits >= freeSpaceTau * (hits +
	 * passes across the surface), free where more than freeSpaceLeast rays passed. O(1). */
	SpaceSample space(const Point2& p) const;
	/** state of space() is free. */
	bool isFree(const Point2& p) const { return space(p).state == SpaceState::free; }
	/** Rays that passed a point, interpolated between cells of 2 sigma, whether there is a surface or not; 0 beyond
	 * +-1e6 m. Cheaper than space(). */
	double passes(const Point2& p) const;

	/** Box around the centroids of all occupied lattice cells, empty for an empty map. */
	Box2 boundingBox() const;

	MapStatistics statistics() const;

	/** All occupied cells in canonical order: equal maps give equal lists. */
	std::vector<CellRecord> cells() const;

	/** Centroid of the measurements of every occupied cell, map frame, in the order of cells(). */
	std::vector<Point2> cellCentroids() const;

	/** Adds the contents of cells as returned by cells() of a map with equal options. Throws std::invalid_argument for
	 * sums that no measurements can have, with the map as before. */
	void insertCells(const std::vector<CellRecord>& cells);

	/** Whether freeCells() gives any. O(1). */
	bool passedAnywhere() const;
	/** All cells of the free-space counters that rays passed, in canonical order: equal maps give equal lists. */
	std::vector<FreeCellRecord> freeCells() const;
	/** Centres of the cells that more than `least` rays passed, map frame, in the order of freeCells(). Squares with an
	 * edge of 2 sigma around them, turned as the lattice is, are the cells. */
	std::vector<Point2> freeCellCentres(double least) const;
	/** Adds the contents of cells as returned by freeCells() of a map with equal options, in that order. Throws
	 * std::invalid_argument for sums that no rays can have, with the map as before. */
	void insertFreeCells(const std::vector<FreeCellRecord>& cells);

 private:
	struct Impl;
	std::unique_ptr<Impl> impl_;
};

}  // namespace ridgemap
