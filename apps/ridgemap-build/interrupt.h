// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ridgemap::apps
{
/** From now on the first SIGINT, SIGTERM or SIGHUP only asks the program to stop; the same signal again ends it at
 * once. */
void catchInterrupts();

/** The signal that asked the program to stop; 0: none. */
int interruptedBy();

/** Its name, such as `SIGINT`. */
std::string interruptName();

}  // namespace ridgemap::apps
