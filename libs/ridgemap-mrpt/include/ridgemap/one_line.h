// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>

namespace ridgemap
{
/** The cause in one line: MRPT's exceptions carry several lines of locations and call stacks around it. */
std::string oneLine(const std::exception& e);

}  // namespace ridgemap
