// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report.h"

namespace ridgemap::apps
{
/** One column of the table: its heading and the text for a map. */
struct Column
{
	std::string heading, unit;
	std::function<std::string(const Figures&)> text;
};

/** The columns that a report has: those of the truth only if there is one. */
std::vector<Column> columnsOf(const Report& report);

}  // namespace ridgemap::apps
