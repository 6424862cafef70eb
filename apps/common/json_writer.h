// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace ridgemap::apps
{
/** Writes indented JSON, members in the order of the calls. Inside an array the key is left empty. */
class JsonWriter
{
 public:
	explicit JsonWriter(std::ostream& out) : out_(out) {}

	void beginObject(const std::string& key = "") { begin(key, '{', '}'); }
	void beginArray(const std::string& key = "") { begin(key, '[', ']'); }
	/** Ends the innermost object or array; after the outermost one the text is complete. */
	void end();

	void value(const std::string& key, const std::string& v);
	void value(const std::string& key, const char* v) { value(key, std::string(v)); }
	void value(const std::string& key, bool v) { raw(key, v ? "true" : "false"); }
	/** Shortest text that gives back the same double; null for values that JSON does not know. */
	void value(const std::string& key, double v);
	template <class Integer>
	void value(const std::string& key, Integer v)
	{
		raw(key, std::to_string(v));
	}

 private:
	struct Level
	{
		char close;
		bool empty;
	};
	std::ostream& out_;
	std::vector<Level> levels_;

	void begin(const std::string& key, char open, char close);
	void raw(const std::string& key, const std::string& text);
	void member(const std::string& key);
};

}  // namespace ridgemap::apps
