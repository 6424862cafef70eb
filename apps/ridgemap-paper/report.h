// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ridgemap::apps
{
/** Figures in rows and columns. */
struct Table
{
	std::vector<std::string> columns;
	std::vector<std::vector<double>> rows;
};

/** Whether what the paper says was found here. */
enum class Verdict
{
	holds,
	differs,
	beyond  ///< the paper says nothing of it
};

/** One experiment and what came out of it. */
struct Finding
{
	std::string id;  ///< also the name of its files
	std::string title;
	std::string claim;   ///< what the paper says
	std::string result;  ///< what was found, in words and numbers
	Verdict verdict = Verdict::holds;
	std::vector<std::string> pictures;  ///< files in the directory of the report
	Table table;                        ///< shown, and written as ID.csv
	std::string data;                   ///< further csv file, if any
};

/** Where and how experiments are run. */
struct Setting
{
	std::string directory;  ///< of all files, without a slash at the end
	bool quick = false;     ///< fewer repetitions
	std::uint64_t seed = 1;

	std::string path(const std::string& name) const { return directory + "/" + name; }
	/** A number of repetitions: all, or few when there is little time. */
	int repeat(int all, int few) const { return quick ? few : all; }
};

/** The text as printf would print it. */
std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));

/** Writes a table as csv with 9 significant digits. */
void writeCsv(const std::string& path, const Table& table);

/** Writes ID.csv for every finding, index.html and paper.md. `note` says where it was run. */
void writeReport(const Setting& setting, const std::vector<Finding>& findings, const std::string& note);

}  // namespace ridgemap::apps
