// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ridgemap::apps
{
/** The fields of a line of text: separated by one comma or semicolon, or by blanks and tabs; what follows `#` is
 * left out. */
std::vector<std::string> splitFields(const std::string& line);

/** The number that a field holds completely, whatever the locale; infinite and NaN are numbers here, too. */
std::optional<double> parseNumber(const std::string& field);

}  // namespace ridgemap::apps
