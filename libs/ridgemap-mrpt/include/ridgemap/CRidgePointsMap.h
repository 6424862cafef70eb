// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CSimplePointsMap.h>
#include <ridgemap/CRidgeMap2D.h>

namespace ridgemap
{
/** A ridge map in the shape of a points map, for programs of MRPT's that want one: icp-slam, rbpf-slam with
 * PF_algorithm = 2, obstacle maps.
 *
 * In INI files it is called `ridgePoints`: `ridgePoints_count = 1`, and sections as those of a ridge map. All is done
 * by the ridge map inside; the points are CRidgeMap2D::getAsSimplePointsMap(), renewed with every change. The options
 * of CPointsMap have no meaning.
 *
 * Points that are added one by one (insertPoint(), insertAnotherMap(), files) become measurements of the ridge map, and
 * the points are renewed by the next observation or refreshPoints(). Functions of CPointsMap that move or delete points
 * in place are not virtual, so they change the points only, until then.
 *
 * Thread-safety: as CRidgeMap2D. */
class CRidgePointsMap : public mrpt::maps::CSimplePointsMap
{
	DEFINE_SERIALIZABLE(CRidgePointsMap, ridgemap)

 public:
	CRidgePointsMap();
	/** Throws std::exception naming the first option that is not valid. */
	explicit CRidgePointsMap(const MapOptions& options);
	/** Takes over a ridge map. */
	explicit CRidgePointsMap(const CRidgeMap2D& map);
	/** Copies points, ridge map and options. The ridge map is shared until one of the two changes. */
	CRidgePointsMap(const CRidgePointsMap& o);
	CRidgePointsMap& operator=(const CRidgePointsMap& o);

	const CRidgeMap2D& ridgeMap() const { return ridgeMap_; }
	/** The ridge map, to be changed. Call refreshPoints() afterwards. */
	CRidgeMap2D& ridgeMap() { return ridgeMap_; }

	/** Makes the points anew from the ridge map. O(points). */
	void refreshPoints();

	/** @name Interface of CMetricMap, by the ridge map
	 * @{ */
	bool isEmpty() const override { return ridgeMap_.isEmpty(); }
	std::string asString() const override;
	void determineMatching2D(const mrpt::maps::CMetricMap* otherMap, const mrpt::poses::CPose2D& otherMapPose,
							 mrpt::tfest::TMatchingPairList& correspondences, const mrpt::maps::TMatchingParams& params,
							 mrpt::maps::TMatchingExtraResults& extraResults) const override;
	void determineMatching3D(const mrpt::maps::CMetricMap* otherMap, const mrpt::poses::CPose3D& otherMapPose,
							 mrpt::tfest::TMatchingPairList& correspondences, const mrpt::maps::TMatchingParams& params,
							 mrpt::maps::TMatchingExtraResults& extraResults) const override;
	float compute3DMatchingRatio(const mrpt::maps::CMetricMap* otherMap, const mrpt::poses::CPose3D& otherMapPose,
								 const mrpt::maps::TMatchingRatioParams& params) const override;
	float squareDistanceToClosestCorrespondence(float x0, float y0) const override;
	void getVisualizationInto(mrpt::opengl::CSetOfObjects& outObj) const override;
	/** As CRidgeMap2D, and the points to PREFIX.txt. */
	void saveMetricMapRepresentationToFile(const std::string& filNamePrefix) const override;
	/** @} */

	/** @name Interface of CPointsMap
	 * @{ */
	void insertPointFast(float x, float y, float z = 0) override;
	/** Both insert the scan. */
	void loadFromRangeScan(const mrpt::obs::CObservation2DRangeScan& scan,
						   const std::optional<const mrpt::poses::CPose3D>& robotPose = std::nullopt) override;
	void loadFromRangeScan(const mrpt::obs::CObservation3DRangeScan& scan,
						   const std::optional<const mrpt::poses::CPose3D>& robotPose = std::nullopt) override;
	/** @} */

	MAP_DEFINITION_START(CRidgePointsMap)
	RidgeMapDefinition map;
	MAP_DEFINITION_END(CRidgePointsMap)

 protected:
	/** Copies the ridge map of another CRidgePointsMap; points of any other map become measurements. */
	void impl_copyFrom(const mrpt::maps::CPointsMap& o) override;

 private:
	void internal_clear() override;
	bool internal_insertObservation(const mrpt::obs::CObservation& obs,
									const std::optional<const mrpt::poses::CPose3D>& robotPose = std::nullopt) override;
	double internal_computeObservationLikelihood(const mrpt::obs::CObservation& obs,
												 const mrpt::poses::CPose3D& takenFrom) const override;
	bool internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& obs) const override;

	CRidgeMap2D ridgeMap_;
};

}  // namespace ridgemap
