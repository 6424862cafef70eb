// SPDX-License-Identifier: BSD-3-Clause
#include "json_writer.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <ostream>

namespace ridgemap::apps
{
namespace
{
std::string quoted(const std::string& s)
{
	std::string out = "\"";
	for (const char c : s)
	{
		if (c == '"' || c == '\\')
			(out += '\\') += c;
		else if (static_cast<unsigned char>(c) < 0x20)
		{
			char code[8];
			std::snprintf(code, sizeof(code), "\\u%04x", unsigned(static_cast<unsigned char>(c)));
			out += code;
		}
		else
			out += c;
	}
	return out + '"';
}
}  // namespace

void JsonWriter::member(const std::string& key)
{
	if (levels_.empty()) return;
	if (!levels_.back().empty) out_ << ',';
	levels_.back().empty = false;
	out_ << '\n' << std::string(levels_.size(), '\t');
	if (!key.empty()) out_ << quoted(key) << ": ";
}

void JsonWriter::begin(const std::string& key, char open, char close)
{
	member(key);
	out_ << open;
	levels_.push_back({close, true});
}

void JsonWriter::end()
{
	const Level level = levels_.back();
	levels_.pop_back();
	if (!level.empty) out_ << '\n' << std::string(levels_.size(), '\t');
	out_ << level.close;
	if (levels_.empty()) out_ << '\n';
}

void JsonWriter::raw(const std::string& key, const std::string& text)
{
	member(key);
	out_ << text;
}

void JsonWriter::value(const std::string& key, const std::string& v)
{
	raw(key, quoted(v));
}

void JsonWriter::value(const std::string& key, double v)
{
	if (!std::isfinite(v)) return raw(key, "null");
	char text[40];
	raw(key, std::string(text, std::to_chars(text, text + sizeof(text), v).ptr));
}

}  // namespace ridgemap::apps
