// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/CRidgeMap2D.h>

#include <ostream>
#include <stdexcept>

#include "map_state.h"
#include "option_text.h"

namespace ridgemap
{
void CRidgeMap2D::setOptions(const Options& options)
{
	options.validate();
	if (options == core().options()) return;
	if (!isEmpty())
		throw std::logic_error(
			"the creation options of a ridge map that holds measurements cannot change; clear the map, or make a new "
			"one");
	state_ = std::make_shared<MapState>(options);
}

MapOptions CRidgeMap2D::mapOptions() const
{
	MapOptions all;
	all.creation = TCreationOptions(options());
	all.insertion = insertionOptions;
	all.likelihood = likelihoodOptions;
	all.render = renderOptions;
	all.matching = matchingOptions;
	return all;
}

void CRidgeMap2D::setMapOptions(const MapOptions& options)
{
	options.validate();
	setOptions(options.creation);
	insertionOptions = options.insertion;
	likelihoodOptions = options.likelihood;
	renderOptions = options.render;
	matchingOptions = options.matching;
}

void RidgeMapDefinition::loadFromConfigFile(const mrpt::config::CConfigFileBase& source,
											const std::string& sectionPrefix)
{
	options.loadFromConfigFile(source, sectionPrefix);
	file = withoutComment(source.read_string(sectionPrefix + "_creationOpts", "file", ""));
}

void RidgeMapDefinition::dumpToTextStream(std::ostream& out) const
{
	if (!file.empty()) out << "file                    = " << file << "\n";
	options.creation.dumpToTextStream(out);
	options.insertion.dumpToTextStream(out);
	options.likelihood.dumpToTextStream(out);
	options.render.dumpToTextStream(out);
	options.matching.dumpToTextStream(out);
}

CRidgeMap2D RidgeMapDefinition::make() const
{
	if (file.empty()) return CRidgeMap2D(options);
	CRidgeMap2D map = loadRidgeMap(file);
	MapOptions all = options;
	all.creation = TCreationOptions(map.options());
	map.setMapOptions(all);
	return map;
}

CRidgeMap2D::TMapDefinition::TMapDefinition() = default;

void CRidgeMap2D::TMapDefinition::loadFromConfigFile_map_specific(const mrpt::config::CConfigFileBase& source,
																  const std::string& sectionNamePrefix)
{
	map.loadFromConfigFile(source, sectionNamePrefix);
}

void CRidgeMap2D::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const
{
	map.dumpToTextStream(out);
}

// A raw pointer before MRPT 2.11.3, a shared one since.
std::invoke_result_t<mrpt::maps::internal::MapCtorFromDefFunctor, const mrpt::maps::TMetricMapInitializer&>
CRidgeMap2D::internal_CreateFromMapDefinition(const mrpt::maps::TMetricMapInitializer& definition)
{
	using Result =
		std::invoke_result_t<mrpt::maps::internal::MapCtorFromDefFunctor, const mrpt::maps::TMetricMapInitializer&>;
	return Result(new CRidgeMap2D(dynamic_cast<const TMapDefinition&>(definition).map.make()));
}

}  // namespace ridgemap
