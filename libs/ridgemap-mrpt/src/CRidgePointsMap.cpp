// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/serialization/CArchive.h>
#include <ridgemap/CRidgePointsMap.h>

#include <stdexcept>

namespace ridgemap
{
CRidgePointsMap::CRidgePointsMap() = default;

CRidgePointsMap::CRidgePointsMap(const MapOptions& options) : ridgeMap_(options) {}

CRidgePointsMap::CRidgePointsMap(const CRidgeMap2D& map) : ridgeMap_(map)
{
	genericMapParams = map.genericMapParams;
	ridgeMap_.genericMapParams = mrpt::maps::TMapGenericParams();
	refreshPoints();
}

CRidgePointsMap::CRidgePointsMap(const CRidgePointsMap& o) : mrpt::maps::CSimplePointsMap()
{
	*this = o;
}

CRidgePointsMap& CRidgePointsMap::operator=(const CRidgePointsMap& o)
{
	if (this == &o) return *this;
	genericMapParams = o.genericMapParams;
	insertionOptions = o.insertionOptions;
	likelihoodOptions = o.likelihoodOptions;
	renderOptions = o.renderOptions;
	impl_copyFrom(o);
	return *this;
}

void CRidgePointsMap::impl_copyFrom(const mrpt::maps::CPointsMap& o)
{
	if (const auto* other = dynamic_cast<const CRidgePointsMap*>(&o))
	{
		ridgeMap_ = other->ridgeMap_;
		m_x = other->m_x;
		m_y = other->m_y;
		m_z = other->m_z;
		mark_as_modified();
		return;
	}
	internal_clear();
	const auto &x = o.getPointsBufferRef_x(), &y = o.getPointsBufferRef_y();
	std::vector<Measurement> measurements;
	for (std::size_t i = 0; i < x.size(); i++) measurements.push_back({x[i], y[i]});
	ridgeMap_.insertMeasurements(measurements);
	refreshPoints();
}

void CRidgePointsMap::refreshPoints()
{
	const auto* points = ridgeMap_.getAsSimplePointsMap();
	const auto &x = points->getPointsBufferRef_x(), &y = points->getPointsBufferRef_y();
	m_x.assign(x.begin(), x.end());
	m_y.assign(y.begin(), y.end());
	m_z.assign(x.size(), 0);
	mark_as_modified();
}

void CRidgePointsMap::internal_clear()
{
	mrpt::maps::CSimplePointsMap::internal_clear();
	ridgeMap_.clear();
}

bool CRidgePointsMap::internal_insertObservation(const mrpt::obs::CObservation& obs,
												 const std::optional<const mrpt::poses::CPose3D>& robotPose)
{
	const mrpt::poses::CPose3D pose = robotPose.value_or(mrpt::poses::CPose3D());
	if (!ridgeMap_.insertObservation(obs, pose)) return false;
	refreshPoints();
	return true;
}

void CRidgePointsMap::insertPointFast(float x, float y, float z)
{
	ridgeMap_.insertMeasurements({Measurement{x, y}});
	mrpt::maps::CSimplePointsMap::insertPointFast(x, y, z);
}

void CRidgePointsMap::loadFromRangeScan(const mrpt::obs::CObservation2DRangeScan& scan,
										const std::optional<const mrpt::poses::CPose3D>& robotPose)
{
	internal_insertObservation(scan, robotPose);
}

void CRidgePointsMap::loadFromRangeScan(const mrpt::obs::CObservation3DRangeScan& scan,
										const std::optional<const mrpt::poses::CPose3D>& robotPose)
{
	internal_insertObservation(scan, robotPose);
}

std::string CRidgePointsMap::asString() const
{
	return ridgeMap_.asString() + ", as " + std::to_string(size()) + " points";
}

void CRidgePointsMap::determineMatching2D(const mrpt::maps::CMetricMap* otherMap,
										  const mrpt::poses::CPose2D& otherMapPose,
										  mrpt::tfest::TMatchingPairList& correspondences,
										  const mrpt::maps::TMatchingParams& params,
										  mrpt::maps::TMatchingExtraResults& extraResults) const
{
	ridgeMap_.determineMatching2D(otherMap, otherMapPose, correspondences, params, extraResults);
}

void CRidgePointsMap::determineMatching3D(const mrpt::maps::CMetricMap* otherMap,
										  const mrpt::poses::CPose3D& otherMapPose,
										  mrpt::tfest::TMatchingPairList& correspondences,
										  const mrpt::maps::TMatchingParams& params,
										  mrpt::maps::TMatchingExtraResults& extraResults) const
{
	ridgeMap_.determineMatching3D(otherMap, otherMapPose, correspondences, params, extraResults);
}

float CRidgePointsMap::compute3DMatchingRatio(const mrpt::maps::CMetricMap* otherMap,
											  const mrpt::poses::CPose3D& otherMapPose,
											  const mrpt::maps::TMatchingRatioParams& params) const
{
	return ridgeMap_.compute3DMatchingRatio(otherMap, otherMapPose, params);
}

float CRidgePointsMap::squareDistanceToClosestCorrespondence(float x0, float y0) const
{
	return ridgeMap_.squareDistanceToClosestCorrespondence(x0, y0);
}

void CRidgePointsMap::getVisualizationInto(mrpt::opengl::CSetOfObjects& outObj) const
{
	if (genericMapParams.enableSaveAs3DObject) ridgeMap_.getVisualizationInto(outObj);
}

void CRidgePointsMap::saveMetricMapRepresentationToFile(const std::string& filNamePrefix) const
{
	ridgeMap_.saveMetricMapRepresentationToFile(filNamePrefix);
	if (!save3D_to_text_file(filNamePrefix + ".txt"))
		throw std::runtime_error("cannot write '" + filNamePrefix + ".txt'");
}

double CRidgePointsMap::internal_computeObservationLikelihood(const mrpt::obs::CObservation& obs,
															  const mrpt::poses::CPose3D& takenFrom) const
{
	return ridgeMap_.computeObservationLikelihood(obs, takenFrom);
}

bool CRidgePointsMap::internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& obs) const
{
	return ridgeMap_.canComputeObservationLikelihood(obs);
}

uint8_t CRidgePointsMap::serializeGetVersion() const
{
	return 0;
}

// Version 0: the three generic parameters of MRPT, and the ridge map as an object. The points are made anew.
void CRidgePointsMap::serializeTo(mrpt::serialization::CArchive& out) const
{
	out << genericMapParams.enableSaveAs3DObject << genericMapParams.enableObservationLikelihood
		<< genericMapParams.enableObservationInsertion << ridgeMap_;
}

void CRidgePointsMap::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version)
{
	if (version != 0)
		throw std::runtime_error("stored ridge points map: version " + std::to_string(version) +
								 " is newer than this library, which reads version 0");
	CRidgePointsMap loaded;
	in >> loaded.genericMapParams.enableSaveAs3DObject >> loaded.genericMapParams.enableObservationLikelihood >>
		loaded.genericMapParams.enableObservationInsertion >> loaded.ridgeMap_;
	loaded.refreshPoints();
	*this = loaded;
}

}  // namespace ridgemap
