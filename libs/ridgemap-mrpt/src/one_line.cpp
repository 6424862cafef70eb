// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/one_line.h>

namespace ridgemap
{
std::string oneLine(const std::exception& e)
{
	std::string text = e.what();
	// The innermost of nested MRPT exceptions is the last one. Those of others, which went through functions of MRPT,
	// have a title and a backtrace, but no mark.
	if (const std::string title = "==== MRPT exception ===="; text.find(title) != std::string::npos)
	{
		for (const std::string& mark : {title, std::string("Message:")})
			if (const auto at = text.rfind(mark); at != std::string::npos) text = text.substr(at + mark.size());
		for (const char* end : {"\nLocation:", "\nCall stack backtrace"})
			if (const auto at = text.find(end); at != std::string::npos) text.resize(at);
	}
	std::string line;
	for (const char c : text)
	{
		const bool blank = static_cast<unsigned char>(c) <= ' ';
		if (!blank)
			line += c;
		else if (!line.empty() && line.back() != ' ')
			line += ' ';
	}
	while (!line.empty() && line.back() == ' ') line.pop_back();
	return line.empty() ? "unknown error" : line;
}

}  // namespace ridgemap
