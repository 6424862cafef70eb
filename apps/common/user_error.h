// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/one_line.h>

#include <stdexcept>
#include <string>

namespace ridgemap::apps
{
/** An error that the user can do something about: what is wrong and what to do, each without a full stop. */
class UserError : public std::runtime_error
{
 public:
	UserError(const std::string& cause, const std::string& remedy) : std::runtime_error(cause + "; " + remedy) {}
};

/** Runs a program with C++ streams silenced, because MRPT prints to them: an exception becomes the line `program:
 * error: ...` on stderr and a non-zero return code. */
int runProgram(const char* program, int (*body)(int, char**), int argc, char** argv);

}  // namespace ridgemap::apps
