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

CRidgeMap2D::TMapDefinition::TMapDefinition() = default;

void CRidgeMap2D::TMapDefinition::loadFromConfigFile_map_specific(const mrpt::config::CConfigFileBase& source,
																  const std::string& sectionNamePrefix)
{
	MapOptions all{creationOpts, insertionOpts, likelihoodOpts, renderOpts, matchingOpts};
	all.loadFromConfigFile(source, sectionNamePrefix);
	creationOpts = all.creation;
	file = withoutComment(source.read_string(sectionNamePrefix + "_creationOpts", "file", ""));
	insertionOpts = all.insertion;
	likelihoodOpts = all.likelihood;
	renderOpts = all.render;
	matchingOpts = all.matching;
}

void CRidgeMap2D::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const
{
	if (!file.empty()) out << "file                    = " << file << "\n";
	creationOpts.dumpToTextStream(out);
	insertionOpts.dumpToTextStream(out);
	likelihoodOpts.dumpToTextStream(out);
	renderOpts.dumpToTextStream(out);
	matchingOpts.dumpToTextStream(out);
}

CRidgeMap2D* CRidgeMap2D::TMapDefinition::load() const
{
	auto map = std::make_unique<CRidgeMap2D>(loadRidgeMap(file));
	map->insertionOptions = insertionOpts;
	map->likelihoodOptions = likelihoodOpts;
	map->renderOptions = renderOpts;
	map->matchingOptions = matchingOpts;
	return map.release();
}

// A raw pointer before MRPT 2.11.3, a shared one since.
std::invoke_result_t<mrpt::maps::internal::MapCtorFromDefFunctor, const mrpt::maps::TMetricMapInitializer&>
CRidgeMap2D::internal_CreateFromMapDefinition(const mrpt::maps::TMetricMapInitializer& definition)
{
	const auto& d = dynamic_cast<const TMapDefinition&>(definition);
	if (!d.file.empty()) return decltype(internal_CreateFromMapDefinition(d))(d.load());
	using Result =
		std::invoke_result_t<mrpt::maps::internal::MapCtorFromDefFunctor, const mrpt::maps::TMetricMapInitializer&>;
	return Result(
		new CRidgeMap2D(MapOptions{d.creationOpts, d.insertionOpts, d.likelihoodOpts, d.renderOpts, d.matchingOpts}));
}

}  // namespace ridgemap
