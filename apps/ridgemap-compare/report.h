// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "measure.h"

namespace ridgemap::apps
{
/** A picture of one map. */
struct Picture
{
	std::string caption;
	std::vector<std::uint8_t> png;
};

/** Pictures of the same part of all maps. */
struct PictureRow
{
	std::string title;
	std::vector<Picture> pictures;
};

/** All that the report shows. */
struct Report
{
	std::string input, truth, secondPass;  ///< names of the files; none: empty
	std::size_t scans = 0, fromClouds = 0, folds = 0;
	double rotation = 0;           ///< of all poses [degrees]
	double sigma = 0;              ///< of the ridge map [m]
	std::vector<Figures> figures;  ///< that of the ridge map first
	std::vector<PictureRow> rows;

	bool localizes() const { return folds > 0 || !secondPass.empty(); }
};

/** The table on the terminal. */
void printTable(const Report& report);
void writeJson(std::ostream& out, const Report& report);
/** One file with all pictures inside. */
void writeHtml(std::ostream& out, const Report& report);

}  // namespace ridgemap::apps
