// SPDX-License-Identifier: BSD-3-Clause
// Uses the map class as MRPT programs do: by its name only.
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <ridgemap/CRidgeMap2D.h>

#include <iostream>

int main()
{
	ridgemap::registerMapClasses();
	mrpt::config::CConfigFileMemory ini("[map]\nridgeMap_count=1\n[map_ridgeMap_00_creationOpts]\nsigma=0.1\n");
	mrpt::maps::TSetOfMetricMapInitializers definition;
	definition.loadFromConfigFile(ini, "map");
	const mrpt::maps::CMultiMetricMap maps(definition);
	const auto map = maps.mapByClass<ridgemap::CRidgeMap2D>();
	if (maps.maps.size() != 1 || !map) return 1;
	std::cout << "sigma " << map->options().sigma << " m\n";
}
