// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "report.h"

namespace ridgemap::apps
{
enum class Better
{
	less,
	more
};

/** One line of the table: a figure of every map. */
struct Line
{
	std::string group;          ///< of figures that belong together
	std::string heading, unit;  ///< no unit: empty
	int decimals = 0;
	Better better = Better::less;
	std::string shortName;  ///< of lines that matter most; others: empty
	std::function<double(const Figures&)> value;

	std::string text(const Figures& f) const;
	/** As they are written. */
	bool isWorse(const Figures& f, const Figures& than) const;
	/** Whether no map has a better text in this line, and at least one a worse one. */
	bool isBest(const Figures& f, const std::vector<Figures>& all) const;
};

/** The lines that a report has: those of the truth, for instance, only if there is one. */
std::vector<Line> linesOf(const Report& report);

/** Of these, the lines that matter most. */
std::vector<Line> mainLinesOf(const Report& report);

/** Where the ridge map is better than all grids, than some, and than none, and where another map is the best. */
std::vector<std::string> inShort(const Report& report);

/** Of maps that are shown as MRPT has them. */
bool hasRemark(const Figures& f);

}  // namespace ridgemap::apps
