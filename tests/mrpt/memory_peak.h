// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace ridgemap::test
{
/** Counts what this program and its libraries hold from operator new: starts a new peak at what is held now.
 * Under sanitizers nothing is counted. */
void restartMemoryPeak();
/** Most bytes held at once since restartMemoryPeak(), beyond what was held then. */
std::size_t memoryPeak();

}  // namespace ridgemap::test
