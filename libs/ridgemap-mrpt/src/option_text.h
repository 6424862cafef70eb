// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "option_fields.h"

#include <string>

namespace ridgemap
{
/** Exact text of a value: parseOption() of it gives the same value, in any locale. */
std::string optionText(double value);
std::string optionText(unsigned value);
std::string optionText(bool value);
std::string optionText(const mrpt::img::TColor& value);

/** Reads a value; throws std::invalid_argument naming key, text and what is allowed. */
void parseOption(const FieldInfo& info, const std::string& text, double& value);
void parseOption(const FieldInfo& info, const std::string& text, unsigned& value);
void parseOption(const FieldInfo& info, const std::string& text, bool& value);
void parseOption(const FieldInfo& info, const std::string& text, mrpt::img::TColor& value);

[[noreturn]] void rejectOption(const FieldInfo& info, const std::string& text, const std::string& allowed);

/** "from a to b". */
std::string rangeText(const FieldInfo& info);

/** Keys and words are compared without case and underscores. */
bool sameKey(const std::string& a, const char* b);

/** A key as it is compared. */
std::string normalizedKey(const std::string& key);

/** Throws std::invalid_argument for a key that does not exist, with the keys nearest to it. */
[[noreturn]] void rejectKey(const std::string& key, const std::vector<std::string>& keys);

/** Text without an end-of-line comment and without blanks around it. */
std::string withoutComment(const std::string& text);

template <class E, class = std::enable_if_t<std::is_enum_v<E>>>
std::string optionText(E value)
{
	return Words<E>::names.at(std::size_t(value));
}

/** The words of an enumeration as "a | b". */
template <class E>
std::string wordsText()
{
	std::string all;
	for (const char* word : Words<E>::names) all += (all.empty() ? "" : " | ") + std::string(word);
	return all;
}

template <class E, class = std::enable_if_t<std::is_enum_v<E>>>
void parseOption(const FieldInfo& info, const std::string& text, E& value)
{
	for (std::size_t i = 0; i < Words<E>::names.size(); i++)
	{
		if (!sameKey(text, Words<E>::names[i])) continue;
		value = E(i);
		return;
	}
	rejectOption(info, text, wordsText<E>());
}

/** The comment beside an option in an INI file: meaning, unit, range or words. */
template <class T>
std::string optionComment(const FieldInfo& info, const T&)
{
	std::string s = info.text;
	if constexpr (std::is_enum_v<T>) s += ": " + wordsText<T>();
	if (info.hasRange()) s += ", " + rangeText(info);
	if (*info.unit) s += std::string(" [") + info.unit + "]";
	return s;
}

}  // namespace ridgemap
