// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/metric_map_types.h>
#include <ridgemap/map_options.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>

#include "option_text.h"

namespace ridgemap
{
namespace
{
template <class T>
std::vector<std::string> keysOf(const T& section)
{
	std::vector<std::string> keys;
	forEachField(section, [&](const FieldInfo& info, const auto&) { keys.push_back(info.key); });
	return keys;
}

/** Sets one field; false if the section has no such key. */
template <class T>
bool setField(T& section, const std::string& key, const std::string& value)
{
	bool found = false;
	forEachField(section,
				 [&](const FieldInfo& info, auto& field)
				 {
					 if (!sameKey(key, info.key)) return;
					 parseOption(info, value, field);
					 found = true;
				 });
	return found;
}

/** The keys of `_creationOpts` that are no options: those that MRPT itself reads, and the file to start with. */
bool isNoOption(const std::string& key)
{
	const std::string k = normalizedKey(key);
	return k == "enablesaveas3dobject" || k == "enableobservationlikelihood" || k == "enableobservationinsertion" ||
		   k == "file";
}

template <class T>
void loadSection(T& options, const mrpt::config::CConfigFileBase& source, const std::string& section)
{
	T loaded = options;
	std::vector<std::string> keys;
	source.getAllKeys(section, keys);
	try
	{
		for (const auto& key : keys)
		{
			if (std::is_same_v<T, TCreationOptions> && isNoOption(key)) continue;
			const std::string value = withoutComment(source.read_string(section, key, ""));
			if (!setField(loaded, key, value)) rejectKey(key, keysOf(options));
		}
		loaded.validate();
	}
	catch (const std::invalid_argument& e)
	{
		throw std::invalid_argument("section '" + section + "': " + e.what());
	}
	options = loaded;
}

template <class T>
void saveSection(const T& options, mrpt::config::CConfigFileBase& target, const std::string& section)
{
	forEachField(options,
				 [&](const FieldInfo& info, const auto& field)
				 {
					 target.write(section, info.key, optionText(field), mrpt::config::MRPT_SAVE_NAME_PADDING(),
								  mrpt::config::MRPT_SAVE_VALUE_PADDING(), optionComment(info, field));
				 });
}

template <class T>
void dumpSection(const T& options, std::ostream& out)
{
	forEachField(options,
				 [&](const FieldInfo& info, const auto& field)
				 {
					 out << info.key << std::string(std::max<std::size_t>(1, 24 - std::string(info.key).size()), ' ')
						 << "= " << optionText(field) << (*info.unit ? " [" + std::string(info.unit) + "]" : "")
						 << "\n";
				 });
}

/** Checks the ranges of the table. */
template <class T>
void validateSection(const T& options)
{
	forEachField(options,
				 [](const FieldInfo& info, const auto& field)
				 {
					 auto copy = field;
					 parseOption(info, optionText(field), copy);
				 });
}

[[noreturn]] void rejectOrder(const char* low, const char* high)
{
	throw std::invalid_argument("ridge map option '" + std::string(low) + "' must not be greater than '" +
								std::string(high) + "'");
}
}  // namespace

void TInsertionOptions::validate() const
{
	validateSection(*this);
	if (minZ > maxZ) rejectOrder("minZ", "maxZ");
	if (minRange > maxRange) rejectOrder("minRange", "maxRange");
}

void TLikelihoodOptions::validate() const
{
	validateSection(*this);
}

void TRenderOptions::validate() const
{
	validateSection(*this);
}

void TMatchingOptions::validate() const
{
	validateSection(*this);
}

#define RIDGEMAP_LOADABLE(T)                                                                            \
	void T::loadFromConfigFile(const mrpt::config::CConfigFileBase& source, const std::string& section) \
	{                                                                                                   \
		loadSection(*this, source, section);                                                            \
	}                                                                                                   \
	void T::saveToConfigFile(mrpt::config::CConfigFileBase& file, const std::string& section) const     \
	{                                                                                                   \
		saveSection(*this, file, section);                                                              \
	}                                                                                                   \
	void T::dumpToTextStream(std::ostream& out) const                                                   \
	{                                                                                                   \
		dumpSection(*this, out);                                                                        \
	}

RIDGEMAP_LOADABLE(TCreationOptions)
RIDGEMAP_LOADABLE(TInsertionOptions)
RIDGEMAP_LOADABLE(TLikelihoodOptions)
RIDGEMAP_LOADABLE(TRenderOptions)
RIDGEMAP_LOADABLE(TMatchingOptions)
#undef RIDGEMAP_LOADABLE

void MapOptions::validate() const
{
	forEachSection(*this, [](const char*, const auto& section) { section.validate(); });
}

std::vector<std::string> MapOptions::keys()
{
	std::vector<std::string> all;
	const MapOptions defaults;
	forEachSection(defaults,
				   [&](const char*, const auto& section)
				   {
					   for (auto& key : keysOf(section)) all.push_back(key);
				   });
	return all;
}

void MapOptions::setOption(const std::string& key, const std::string& value)
{
	bool found = false;
	forEachSection(*this, [&](const char*, auto& section) { found |= setField(section, key, value); });
	if (!found) rejectKey(key, keys());
}

std::string MapOptions::getOption(const std::string& key) const
{
	std::string text;
	bool found = false;
	const auto visit = [&](const FieldInfo& info, const auto& field)
	{
		if (!sameKey(key, info.key)) return;
		text = optionText(field);
		found = true;
	};
	forEachSection(*this, [&](const char*, const auto& section) { forEachField(section, visit); });
	if (!found) rejectKey(key, keys());
	return text;
}

void MapOptions::loadFromConfigFile(const mrpt::config::CConfigFileBase& source, const std::string& sectionPrefix)
{
	MapOptions loaded = *this;
	std::vector<std::string> sections, known;
	forEachSection(loaded,
				   [&](const char* suffix, auto& section)
				   {
					   known.push_back(sectionPrefix + "_" + suffix);
					   if (source.sectionExists(known.back())) section.loadFromConfigFile(source, known.back());
				   });
	source.getAllSections(sections);
	for (const auto& name : sections)
	{
		const std::string n = normalizedKey(name), prefix = normalizedKey(sectionPrefix + "_");
		const auto same = [&](const std::string& k) { return normalizedKey(k) == n; };
		if (n.compare(0, prefix.size(), prefix) == 0 && std::none_of(known.begin(), known.end(), same))
			throw std::invalid_argument(
				"a ridge map has no section '" + name +
				"'; the endings are _creationOpts, _insertOpts, _likelihoodOpts, _renderOpts and _matchingOpts");
	}
	*this = loaded;
}

void MapOptions::saveToConfigFile(mrpt::config::CConfigFileBase& target, const std::string& sectionPrefix) const
{
	forEachSection(*this, [&](const char* suffix, const auto& section)
				   { section.saveToConfigFile(target, sectionPrefix + "_" + suffix); });
}

std::string MapOptions::toIniText(const std::string& sectionPrefix) const
{
	mrpt::config::CConfigFileMemory ini;
	saveToConfigFile(ini, sectionPrefix);
	return ini.getContent();
}

std::string defaultIniText(const std::string& mapSection)
{
	const std::string prefix = mapSection + "_ridgeMap_00", creation = prefix + "_creationOpts";
	const mrpt::maps::TMapGenericParams generic;
	mrpt::config::CConfigFileMemory ini;
	const auto write = [&](const std::string& section, const char* key, const std::string& value, const char* comment)
	{
		ini.write(section, key, value, mrpt::config::MRPT_SAVE_NAME_PADDING(), mrpt::config::MRPT_SAVE_VALUE_PADDING(),
				  comment);
	};
	write(mapSection, "ridgeMap_count", "1", "number of ridge maps in the multi-metric map of an MRPT program");
	MapOptions().saveToConfigFile(ini, prefix);
	write(creation, "enableSaveAs3DObject", optionText(generic.enableSaveAs3DObject),
		  "of every map: show in 3-D scenes");
	write(creation, "enableObservationLikelihood", optionText(generic.enableObservationLikelihood),
		  "of every map: take part in likelihoods");
	write(creation, "enableObservationInsertion", optionText(generic.enableObservationInsertion),
		  "of every map: take in observations");
	return ini.getContent();
}

}  // namespace ridgemap
