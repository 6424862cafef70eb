// SPDX-License-Identifier: BSD-3-Clause
// Becomes another program, with the plug-in loaded into it: arguments, exit code, signals and files are its own.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace
{
namespace fs = std::filesystem;

/** Exit codes of shells for a program that is not there, and one that cannot be run. */
constexpr int notFound = 127, notRunnable = 126;

constexpr const char* help =
	"usage: ridgemap-run APP [ARGS...]\n\n"
	"Runs a program of MRPT's (icp-slam, rbpf-slam, pf-localization, observations2map, RawLogViewer, ...) with the "
	"maps 'ridgeMap' and 'ridgePoints' at its disposal, as ready INI files in datasets/config use them. All that "
	"follows APP is passed on; exit code and signals are those of APP.\n";

/** Where the library lies, seen from this program: in the build tree and where both are installed. */
fs::path findLibrary()
{
	const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
	std::string tried;
	for (const char* folder : {"../lib", RIDGEMAP_BIN_TO_LIB})
	{
		const fs::path library = (here / folder / RIDGEMAP_LIBRARY_NAME).lexically_normal();
		if (fs::exists(library)) return library;
		if (tried.find(library.string()) == std::string::npos) tried += "\n  " + library.string();
	}
	throw std::runtime_error("the plug-in " RIDGEMAP_LIBRARY_NAME " is missing; looked for" + tried +
							 "\nBuild it (cmake --build), or install ridgemap anew");
}

void preload(const std::string& library)
{
	if (library.find_first_of(" :") != std::string::npos)
		throw std::runtime_error("the path '" + library +
								 "' holds a blank or a colon, which LD_PRELOAD cannot express; move the folder");
	const char* others = std::getenv("LD_PRELOAD");
	const std::string all = others && *others ? library + ":" + others : library;
	if (setenv("LD_PRELOAD", all.c_str(), 1) != 0) throw std::runtime_error("cannot set LD_PRELOAD");
}

int fail(const std::string& message, int code)
{
	std::fprintf(stderr, "ridgemap-run: %s\n", message.c_str());
	return code;
}
}  // namespace

int main(int argc, char** argv)
{
	const std::string first = argc > 1 ? argv[1] : "";
	if (first == "--help" || first == "-h") return std::fputs(help, stdout) < 0;
	if (first == "--version") return std::puts("ridgemap-run " RIDGEMAP_VERSION) < 0;
	if (first.empty() || first[0] == '-')
		return fail((first.empty() ? "no program given" : "unknown option '" + first + "'") + "\n\n" + help, 2);
	try
	{
		preload(findLibrary().string());
	}
	catch (const std::exception& e)
	{
		return fail(e.what(), 1);
	}
	execvp(argv[1], argv + 1);
	if (errno == ENOENT)
		return fail("there is no program '" + first +
						"'; MRPT's programs are in Debian's package mrpt-apps (apt-get install mrpt-apps)",
					notFound);
	return fail("cannot run '" + first + "': " + std::strerror(errno), notRunnable);
}
