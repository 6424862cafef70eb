// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report.h"

namespace ridgemap::apps
{
/** Draws a chart NAME.png with gnuplot and keeps its script NAME.gp. `script` holds the settings and the plot command;
 * it may read csv files of the directory by name. Throws UserError if gnuplot is missing or fails. */
void drawChart(const Setting& setting, const std::string& name, const std::string& script);

}  // namespace ridgemap::apps
