// SPDX-License-Identifier: BSD-3-Clause
#include "user_error.h"

#include <cstdio>
#include <new>

namespace ridgemap::apps
{
std::string oneLine(const std::exception& e)
{
	std::string text = e.what();
	// The innermost of nested MRPT exceptions is the last one.
	const std::string mark = "Message:";
	if (const auto at = text.rfind(mark); at != std::string::npos && text.find("MRPT exception") != std::string::npos)
	{
		text = text.substr(at + mark.size());
		if (const auto end = text.find("\nLocation:"); end != std::string::npos) text.resize(end);
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

int runProgram(const char* program, int (*body)(int, char**), int argc, char** argv)
{
	const auto report = [program](const std::string& text)
	{
		std::fprintf(stderr, "%s: error: %s\n", program, text.c_str());
		return 1;
	};
	try
	{
		return body(argc, argv);
	}
	catch (const std::bad_alloc&)
	{
		return report("out of memory; give fewer inputs at a time, or a larger --sigma");
	}
	catch (const std::exception& e)
	{
		return report(oneLine(e));
	}
	catch (...)
	{
		return report("unknown exception; please report this as a bug");
	}
}

}  // namespace ridgemap::apps
