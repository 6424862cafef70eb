// SPDX-License-Identifier: BSD-3-Clause
#include "user_error.h"

#include <cstdio>
#include <iostream>
#include <new>

namespace ridgemap::apps
{
namespace
{
/** Keeps what MRPT prints on its own out of the output; the programs print by stdio. */
class QuietStreams
{
 public:
	QuietStreams() : streams_{&std::cout, &std::cerr, &std::clog}
	{
		for (std::size_t i = 0; i < 3; i++) buffers_[i] = streams_[i]->rdbuf(nullptr);
	}
	~QuietStreams()
	{
		for (std::size_t i = 0; i < 3; i++) streams_[i]->rdbuf(buffers_[i]);
	}
	QuietStreams(const QuietStreams&) = delete;
	QuietStreams& operator=(const QuietStreams&) = delete;

 private:
	std::ostream* streams_[3];
	std::streambuf* buffers_[3];
};

}  // namespace

int runProgram(const char* program, int (*body)(int, char**), int argc, char** argv)
{
	const QuietStreams quiet;
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
	catch (const UserError& e)
	{
		return report(oneLine(e));
	}
	catch (const std::exception& e)
	{
		return report(oneLine(e) + "; see " + program + " --help");
	}
	catch (...)
	{
		return report("unknown exception; please report this as a bug");
	}
}

}  // namespace ridgemap::apps
