// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "report.h"

namespace ridgemap::apps
{
/** The part of the HTML report that says what the figures mean, and where they do not speak for the ridge map. */
void writeNotes(std::ostream& out, const Report& report);

}  // namespace ridgemap::apps
