// SPDX-License-Identifier: BSD-3-Clause
#include "number_line.h"

#include <charconv>

namespace ridgemap::apps
{
std::vector<std::string> splitFields(const std::string& line)
{
	std::vector<std::string> fields;
	const auto isBlank = [](char c) { return c == ' ' || c == '\t'; };
	const std::string text = line.substr(0, line.find('#'));
	std::size_t i = 0;
	bool separated = false;  // a comma or semicolon came last: a field must follow
	while (true)
	{
		while (i < text.size() && isBlank(text[i])) i++;
		if (i == text.size()) break;
		const std::size_t start = i;
		while (i < text.size() && !isBlank(text[i]) && text[i] != ',' && text[i] != ';') i++;
		fields.push_back(text.substr(start, i - start));
		while (i < text.size() && isBlank(text[i])) i++;
		separated = i < text.size() && (text[i] == ',' || text[i] == ';');
		if (separated) i++;
	}
	if (separated) fields.emplace_back();
	return fields;
}

std::optional<double> parseNumber(const std::string& field)
{
	const char* begin = field.data();
	const char* end = begin + field.size();
	if (end - begin > 1 && *begin == '+' && begin[1] != '-') begin++;
	double value = 0;
	const auto [at, error] = std::from_chars(begin, end, value);
	if (error != std::errc() || at != end || begin == end) return std::nullopt;
	return value;
}

}  // namespace ridgemap::apps
