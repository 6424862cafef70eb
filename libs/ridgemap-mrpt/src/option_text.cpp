// SPDX-License-Identifier: BSD-3-Clause
#include "option_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <system_error>

namespace ridgemap
{
namespace
{
template <class T>
std::string numberText(T value)
{
	char buffer[40];
	const auto r = std::to_chars(buffer, buffer + sizeof(buffer), value);
	return std::string(buffer, r.ptr);
}

template <class T>
bool parseWhole(const std::string& text, T& value, int base)
{
	const char* end = text.data() + text.size();
	const auto r = std::from_chars(text.data(), end, value, base);
	return r.ec == std::errc() && r.ptr == end;
}

bool parseWhole(const std::string& text, double& value)
{
	const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
	const char* end = text.data() + text.size();
	const auto r = std::from_chars(text.data() + plus, end, value);
	return r.ec == std::errc() && r.ptr == end;
}

/** Number of single-letter changes between two words. */
std::size_t editDistance(const std::string& a, const std::string& b)
{
	std::vector<std::size_t> row(b.size() + 1);
	std::iota(row.begin(), row.end(), std::size_t(0));
	for (std::size_t i = 1; i <= a.size(); i++)
	{
		std::size_t diagonal = row[0];
		row[0] = i;
		for (std::size_t j = 1; j <= b.size(); j++)
		{
			const std::size_t replace = diagonal + (a[i - 1] != b[j - 1]);
			diagonal = row[j];
			row[j] = std::min({replace, row[j] + 1, row[j - 1] + 1});
		}
	}
	return row.back();
}

bool isNear(const std::string& a, const std::string& b)
{
	if (a.size() >= 3 && (a.find(b) != std::string::npos || b.find(a) != std::string::npos)) return true;
	return editDistance(a, b) <= std::max<std::size_t>(2, a.size() / 3);
}

std::string joined(const std::vector<std::string>& words)
{
	std::string s;
	for (const auto& w : words) s += (s.empty() ? "" : ", ") + w;
	return s;
}
}  // namespace

std::string optionText(double value)
{
	// Left to itself, to_chars() writes a million as 1e+06.
	const double size = std::abs(value);
	char buffer[40];
	if (!(size >= 1e-4 && size < 1e9)) return numberText(value);
	const auto r = std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::fixed);
	return std::string(buffer, r.ptr);
}
std::string optionText(unsigned value)
{
	return numberText(value);
}
std::string optionText(bool value)
{
	return value ? "true" : "false";
}

std::string optionText(const mrpt::img::TColor& c)
{
	static const char* digits = "0123456789abcdef";
	std::string s;
	for (const std::uint8_t v : {c.R, c.G, c.B, c.A})
	{
		s += digits[v >> 4];
		s += digits[v & 15];
	}
	if (c.A == 0xff) s.resize(6);
	return s;
}

std::string rangeText(const FieldInfo& info)
{
	return "from " + optionText(info.lowest) + " to " + optionText(info.highest);
}

namespace
{
/** "from a to b unit": without brackets, for the programs of MRPT take what ends with ']' for a place in a source. */
std::string allowedRange(const FieldInfo& info)
{
	return rangeText(info) + (*info.unit ? " " + std::string(info.unit) : "");
}
}  // namespace

void rejectOption(const FieldInfo& info, const std::string& text, const std::string& allowed)
{
	throw std::invalid_argument("ridge map option '" + std::string(info.key) + "' is '" + text + "', but must be " +
								allowed);
}

void parseOption(const FieldInfo& info, const std::string& text, double& value)
{
	double v;
	const std::string allowed = info.hasRange() ? "a number " + allowedRange(info) : std::string("a number");
	if (!parseWhole(text, v)) rejectOption(info, text, allowed);
	if (info.hasRange() && !(v >= info.lowest && v <= info.highest)) rejectOption(info, text, allowed);
	value = v;
}

void parseOption(const FieldInfo& info, const std::string& text, unsigned& value)
{
	unsigned v;
	const std::string allowed = "a whole number " + allowedRange(info);
	if (!parseWhole(text, v, 10) || !(v >= info.lowest && v <= info.highest)) rejectOption(info, text, allowed);
	value = v;
}

void parseOption(const FieldInfo& info, const std::string& text, bool& value)
{
	const std::string word = normalizedKey(text);
	if (word == "true" || word == "yes" || word == "on" || word == "1")
		value = true;
	else if (word == "false" || word == "no" || word == "off" || word == "0")
		value = false;
	else
		rejectOption(info, text, "true or false");
}

void parseOption(const FieldInfo& info, const std::string& text, mrpt::img::TColor& value)
{
	const std::string digits = !text.empty() && text[0] == '#' ? text.substr(1) : text;
	std::uint32_t v;
	if ((digits.size() != 6 && digits.size() != 8) || !parseWhole(digits, v, 16))
		rejectOption(info, text, "a colour as RRGGBB or RRGGBBAA, hexadecimal");
	if (digits.size() == 6) v = v << 8 | 0xff;
	value = mrpt::img::TColor(std::uint8_t(v >> 24), std::uint8_t(v >> 16), std::uint8_t(v >> 8), std::uint8_t(v));
}

bool sameKey(const std::string& a, const char* b)
{
	const char* p = a.c_str();
	for (;; p++, b++)
	{
		while (*p == '_') p++;
		while (*b == '_') b++;
		if (std::tolower(static_cast<unsigned char>(*p)) != std::tolower(static_cast<unsigned char>(*b))) return false;
		if (*p == 0) return true;
	}
}

std::string normalizedKey(const std::string& key)
{
	std::string s;
	for (const char c : key)
		if (c != '_') s += char(std::tolower(static_cast<unsigned char>(c)));
	return s;
}

void rejectKey(const std::string& key, const std::vector<std::string>& keys)
{
	std::vector<std::string> near;
	for (const auto& k : keys)
		if (isNear(normalizedKey(key), normalizedKey(k))) near.push_back(k);
	const std::string message = "there is no ridge map option '" + key + "'; ";
	if (near.empty()) throw std::invalid_argument(message + "the options are " + joined(keys));
	throw std::invalid_argument(message + "did you mean " + joined(near) + "?");
}

std::string withoutComment(const std::string& text)
{
	std::string s = text.substr(0, std::min(text.find("//"), text.find(';')));
	const char* blanks = " \t\r\n";
	const auto first = s.find_first_not_of(blanks);
	if (first == std::string::npos) return {};
	return s.substr(first, s.find_last_not_of(blanks) - first + 1);
}

}  // namespace ridgemap
