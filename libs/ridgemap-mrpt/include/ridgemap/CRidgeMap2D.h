// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/math/TBoundingBox.h>
#include <mrpt/version.h>
#include <ridgemap/map_options.h>
#include <ridgemap/observation_to_measurements.h>
#include <ridgemap/point_to_line_matching.h>
#include <ridgemap/polyline_index.h>
#include <ridgemap/ridge_map.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace ridgemap
{
class CRidgeMap2D;
struct MapState;

/** What an INI file of MRPT's says about a map of this library. */
struct RidgeMapDefinition
{
	MapOptions options;
	/** A .ridgemap to start with (key `file` of `_creationOpts`), such as a frozen map to localise in. The creation
	 * options are then those of the file. */
	std::string file;

	/** Throws as MapOptions::loadFromConfigFile(). */
	void loadFromConfigFile(const mrpt::config::CConfigFileBase& source, const std::string& sectionPrefix);
	void dumpToTextStream(std::ostream& out) const;
	/** A new map. Throws as loadRidgeMap(), and for options that are not valid. */
	CRidgeMap2D make() const;
};

/** Makes the map classes known to MRPT. Loading the library does this by itself; a program that uses the map only
 * through MRPT's registry (INI files, serialized objects) calls it once, else the linker may drop the library
 * (`--as-needed`). May be called any number of times, from any thread. */
void registerMapClasses();

/** A map of surfaces as polylines on the ridges of a continuous occupancy, as one of MRPT's metric maps.
 *
 * In INI files of MRPT programs it is called `ridgeMap`: `ridgeMap_count = 1`, and the sections
 * `<map>_ridgeMap_00_creationOpts`, `_insertOpts`, `_likelihoodOpts`, `_renderOpts` and `_matchingOpts`; see MapOptions
 * and defaultIniText(). Coordinates are metres in the map frame, in double precision.
 *
 * The polylines are a pure function of the multiset of measurements and the options. They are brought up to date by the
 * first query after a change; see update().
 *
 * Thread-safety: const functions may be called from several threads at once; a non-const function needs the map for
 * itself. References and pointers to results stay valid until the map changes. */
class CRidgeMap2D : public mrpt::maps::CMetricMap
{
	DEFINE_SERIALIZABLE(CRidgeMap2D, ridgemap)

 public:
	CRidgeMap2D();
	/** Throws std::exception naming the first option that is not valid. */
	explicit CRidgeMap2D(const Options& options);
	explicit CRidgeMap2D(const MapOptions& options);
	~CRidgeMap2D() override;
	/** Copies map and options, not the observers subscribed to it. O(1): measurements, polylines and what queries have
	 * built are shared until one of the two changes. */
	CRidgeMap2D(const CRidgeMap2D& o);
	CRidgeMap2D& operator=(const CRidgeMap2D& o);
	/** Leaves an empty map with the same options behind. */
	CRidgeMap2D(CRidgeMap2D&& o);
	CRidgeMap2D& operator=(CRidgeMap2D&& o);

	/** @name Options
	 * @{ */
	/** Applied by insertObservation() and eraseObservation(): an observation can be erased only with the options it was
	 * inserted with. */
	TInsertionOptions insertionOptions;
	TLikelihoodOptions likelihoodOptions;
	TRenderOptions renderOptions;
	TMatchingOptions matchingOptions;

	/** The parameters of the algorithm. */
	const Options& options() const { return core().options(); }
	/** Replaces them; throws std::exception if they are not valid, or differ and the map is not empty. */
	void setOptions(const Options& options);

	MapOptions mapOptions() const;
	/** Replaces all options; throws as setOptions() and for values out of range, with all options as before. */
	void setMapOptions(const MapOptions& options);
	/** @} */

	/** @name Changes
	 * @{ */
	/** Adds measured surface points; errors as in RidgeMap::insert(). O(measurements). */
	void insertMeasurements(const std::vector<Measurement>& measurements);
	/** Takes out measurements that were inserted before; errors as in RidgeMap::erase(). */
	void eraseMeasurements(const std::vector<Measurement>& measurements);
	/** Adds and takes out rays that met nothing; errors as in RidgeMap::insertFreeRays() and eraseFreeRays(). */
	void insertFreeRays(const std::vector<FreeRay>& rays);
	void eraseFreeRays(const std::vector<FreeRay>& rays);
	/** Adds what a scan saw, as insertObservation() does. With insertionOptions.keepScans or keepSeconds, scans that
	 * have become too old are taken out: the map is then that of the kept scans alone, to the bit. The map remembers
	 * the scans that it has to take out later, and its copies and files do, too. Throws as RidgeMap::insert(), and if
	 * the map no longer holds what has to be taken out; the map is then as before. */
	void insertScan(const ObservedScan& scan);
	/** Takes out a scan that was inserted before, as eraseObservation() does; errors as in RidgeMap::erase(). */
	void eraseScan(const ObservedScan& scan);
	/** Takes out an observation that was inserted at this pose before: the map is then what it would be without it, to
	 * the bit. Returns false if the observation holds no measurement (insertObservation() returned false, too). Throws
	 * std::exception if the map does not hold its measurements, with the map as before. */
	bool eraseObservation(const mrpt::obs::CObservation& obs,
						  const std::optional<const mrpt::poses::CPose3D>& robotPose = std::nullopt);
	/** Moves an observation that was inserted at oldPose to newPose: the map is then what it would be had it been
	 * inserted there, to the bit. Returns and throws as eraseObservation(). */
	bool reanchor(const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& oldPose,
				  const mrpt::poses::CPose3D& newPose);
	/** Adds all measurements of another map with equal Options; errors as in RidgeMap::merge(). */
	void merge(const CRidgeMap2D& other);
	/** Takes out all measurements of another map; errors as in RidgeMap::subtract(). */
	void subtract(const CRidgeMap2D& other);
	/** Brings the polylines up to date and tells what changed. Queries do this by themselves. */
	UpdateResult update(unsigned threads = 1);
	/** Threads used by updates that queries start by themselves. The result does not depend on it. */
	void setThreads(unsigned threads);
	/** @} */

	/** @name Frozen maps
	 * Polylines without the measurements they came from: a few kilobytes, for localisation on the robot. All queries,
	 * likelihoods, matching, drawing and serialization work; ridges() and walls() give the same polylines. What needs
	 * measurements (insert, erase, merge, subtract) throws std::exception that says so. clear() makes it an empty map
	 * that takes in measurements again.
	 * @{ */
	/** Keeps the walls, simplified with a tolerance [m] (see simplified()) and rounded to 2^-20 m (about a micrometre),
	 * and drops all measurements. */
	void freeze(double tolerance = 0);
	bool isFrozen() const;
	/** A frozen map of given polylines, such as a building plan, rounded as by freeze(). Throws std::exception for
	 * coordinates that are not finite or beyond +-1e9 m. */
	static CRidgeMap2D fromPolylines(const std::vector<Polyline>& lines, const MapOptions& options = MapOptions());
	/** @} */

	/** @name Queries
	 * @{ */
	/** The map without MRPT: occupancy, cells, statistics. */
	const RidgeMap& core() const;
	/** Strict ridges: every point within eps of the true ridge. */
	const std::vector<Polyline>& ridges() const;
	/** Walls: ridges after pruning and attachment, for people and robots. */
	const std::vector<Polyline>& walls() const;
	/** Box around all measurements (grown by at most one lattice cell), or around the polylines of a frozen map. */
	Box2 box() const;
	/** The walls with as few vertices as stay within a tolerance [m] of them, junctions and ends kept: a straight wall
	 * is two points. See ridgemap::simplified(). */
	std::vector<Polyline> simplified(double tolerance) const;
	/** The point of walls() nearest to a point, by a KD-tree; exact. Nothing if there is none within maxDistance or the
	 * query is not finite. About O(log walls); the first query after a change builds the tree. */
	std::optional<NearestPoint> nearestWallPoint(const Point2& query,
												 double maxDistance = std::numeric_limits<double>::infinity()) const;
	/** The same on ridges(). */
	std::optional<NearestPoint> nearestRidgePoint(const Point2& query,
												  double maxDistance = std::numeric_limits<double>::infinity()) const;
	/** @} */

	/** @name Interface of CMetricMap
	 * @{ */
	bool isEmpty() const override;
	std::string asString() const override;

	/** Pairs the points of another map with the map. Gate: maxDistForCorrespondence + maxAngularDistForCorrespondence
	 * times the distance to angularDistPivotPoint, at most matchingOptions.maxGate.
	 *
	 * With MatchingMethod::lines the alignment with the lines of the polylines is solved here, and the feet of the
	 * points are freed of the shift and the turn that are left: the least squares of MRPT's classic ICP then find the
	 * same alignment (Levenberg-Marquardt needs MatchingMethod::feet). With MatchingMethod::feet it is the foot on the
	 * polyline. Errors and ratio are those of true feet. `globalIdx` is the index of the point of
	 * getAsSimplePointsMap() nearest to the foot along its polyline. onlyUniqueRobust has no meaning for feet and is
	 * ignored. Throws std::exception if the other map has no points map.
	 *
	 * A call that starts where the one before ended, with a gate that is no wider, is taken for the next one of the
	 * same alignment; see TMatchingOptions::yawFirstOnly. */
	void determineMatching2D(const mrpt::maps::CMetricMap* otherMap, const mrpt::poses::CPose2D& otherMapPose,
							 mrpt::tfest::TMatchingPairList& correspondences, const mrpt::maps::TMatchingParams& params,
							 mrpt::maps::TMatchingExtraResults& extraResults) const override;

	/** As determineMatching2D(), for points in space; walls reach from floor to ceiling, so a foot has the height of
	 * its point. */
	void determineMatching3D(const mrpt::maps::CMetricMap* otherMap, const mrpt::poses::CPose3D& otherMapPose,
							 mrpt::tfest::TMatchingPairList& correspondences, const mrpt::maps::TMatchingParams& params,
							 mrpt::maps::TMatchingExtraResults& extraResults) const override;

	/** Share of the points of the other map that lie within maxDistForCorr of a wall; 0 for maps without points. */
	float compute3DMatchingRatio(const mrpt::maps::CMetricMap* otherMap, const mrpt::poses::CPose3D& otherMapPose,
								 const mrpt::maps::TMatchingRatioParams& params) const override;

	/** Square of the distance to the nearest target of matching [m^2]; the greatest float for an empty map or a query
	 * that is not finite. */
	float squareDistanceToClosestCorrespondence(float x0, float y0) const override;

	/** The targets of matching as points: along the polylines, evenly, and the lone measurements (see
	 * TMatchingOptions). Never null. Belongs to the map; valid until the map changes. */
	const mrpt::maps::CSimplePointsMap* getAsSimplePointsMap() const override;

	/** box() at z = 0; all zero for an empty map. */
#if MRPT_VERSION >= 0x20b03
	mrpt::math::TBoundingBoxf boundingBox() const override;
#else
	mrpt::math::TBoundingBoxf boundingBox() const;
#endif

	/** Adds the polylines (CSetOfLines) and, if wanted, the measurements (CPointCloud); see renderOptions. */
	void getVisualizationInto(mrpt::opengl::CSetOfObjects& outObj) const override;

	/** Writes PREFIX_ridges.csv, PREFIX_walls.csv, PREFIX.svg and PREFIX.3Dscene. Each file appears complete or not at
	 * all. Throws std::exception naming file and cause. */
	void saveMetricMapRepresentationToFile(const std::string& filNamePrefix) const override;
	/** @} */

	MAP_DEFINITION_START(CRidgeMap2D)
	RidgeMapDefinition map;
	MAP_DEFINITION_END(CRidgeMap2D)

 private:
	void internal_clear() override;
	bool internal_insertObservation(const mrpt::obs::CObservation& obs,
									const std::optional<const mrpt::poses::CPose3D>& robotPose = std::nullopt) override;
	double internal_computeObservationLikelihood(const mrpt::obs::CObservation& obs,
												 const mrpt::poses::CPose3D& takenFrom) const override;
	bool internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& obs) const override;

	std::shared_ptr<const PolylineIndex> wallIndex() const;
	std::shared_ptr<const PolylineIndex> ridgeIndex() const;
	std::shared_ptr<const MatchingTargets> matchingTargets() const;
	void swap(CRidgeMap2D& o);
	void throwIfFrozen(const char* change) const;

	mutable AlignmentMemory lastAlignment_;
	std::shared_ptr<MapState> state_;  ///< shared with copies until one of them changes; never null
};

/** Reads a map from a file that MRPT wrote (an object in a CFileGZOutputStream), compressed or not. Throws
 * std::exception naming the file and the cause. */
CRidgeMap2D loadRidgeMap(const std::string& path);

/** Writes a map to a file that MRPT programs with this library can read. The file appears complete or not at all.
 * Throws std::exception naming the file and the cause. */
void saveRidgeMap(const std::string& path, const CRidgeMap2D& map);

}  // namespace ridgemap
