// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/CRidgePointsMap.h>

#include <ostream>
#include <type_traits>

namespace ridgemap
{
CRidgePointsMap::TMapDefinition::TMapDefinition() = default;

void CRidgePointsMap::TMapDefinition::loadFromConfigFile_map_specific(const mrpt::config::CConfigFileBase& source,
																	  const std::string& sectionNamePrefix)
{
	map.loadFromConfigFile(source, sectionNamePrefix);
}

void CRidgePointsMap::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const
{
	map.dumpToTextStream(out);
}

// A raw pointer before MRPT 2.11.3, a shared one since.
std::invoke_result_t<mrpt::maps::internal::MapCtorFromDefFunctor, const mrpt::maps::TMetricMapInitializer&>
CRidgePointsMap::internal_CreateFromMapDefinition(const mrpt::maps::TMetricMapInitializer& definition)
{
	using Result =
		std::invoke_result_t<mrpt::maps::internal::MapCtorFromDefFunctor, const mrpt::maps::TMetricMapInitializer&>;
	return Result(new CRidgePointsMap(dynamic_cast<const TMapDefinition&>(definition).map.make()));
}

}  // namespace ridgemap
