// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/initializer.h>
#include <mrpt/rtti/CObject.h>
#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/CRidgePointsMap.h>

IMPLEMENTS_SERIALIZABLE(CRidgeMap2D, CMetricMap, ridgemap)
MAP_DEFINITION_REGISTER("ridgemap::CRidgeMap2D,ridgeMap", ridgemap::CRidgeMap2D)
IMPLEMENTS_SERIALIZABLE(CRidgePointsMap, CSimplePointsMap, ridgemap)
MAP_DEFINITION_REGISTER("ridgemap::CRidgePointsMap,ridgePoints", ridgemap::CRidgePointsMap)

MRPT_INITIALIZER(registerRidgemapClasses)
{
	ridgemap::registerMapClasses();
}

namespace ridgemap
{
void registerMapClasses()
{
	mrpt::rtti::registerClass(CLASS_ID_NAMESPACE(CRidgeMap2D, ridgemap));
	mrpt::rtti::registerClass(CLASS_ID_NAMESPACE(CRidgePointsMap, ridgemap));
}

}  // namespace ridgemap
