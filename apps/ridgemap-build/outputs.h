// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/atomic_file.h>

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "resume.h"

namespace ridgemap::apps
{
/** What the pictures show beside the walls. */
struct PictureContents
{
	bool standardErrors = false;  ///< colour the walls by their standard errors
	bool removed = false;         ///< stretches that rays passed through
	bool free = false;            ///< shade what is known to be free
};

/** The files of a run: PREFIX.ridgemap and so on. All are finished before the first of them appears. */
class Outputs
{
 public:
	/** Creates the directory of the prefix if only this is missing, and tries whether all files can be written.
	 * Throws UserError if not. */
	Outputs(const std::string& prefix, const std::set<std::string>& formats, const PictureContents& pictures);
	~Outputs();
	Outputs(const Outputs&) = delete;
	Outputs& operator=(const Outputs&) = delete;

	/** Takes the next measurement of this run. */
	void addMeasurement(const Measurement& m);

	/** Writes all files and lets them appear. `writeStats` is called last, with the sizes of the other files. A run
	 * that was interrupted at `stoppedAt` leaves PREFIX.resume, too; a complete one removes it. */
	using FileSizes = std::map<std::string, std::uintmax_t>;
	void write(const CRidgeMap2D& map, const std::vector<std::vector<Point2>>& robotPaths, const std::string& title,
			   const std::function<void(std::ostream&, const FileSizes&)>& writeStats,
			   const std::optional<ResumePoint>& stoppedAt);

	/** PREFIX.resume, which holds an interrupted run. */
	static std::string resumePath(const std::string& prefix) { return prefix + ".resume"; }

	/** Names of the files in the order of the formats. */
	std::vector<std::string> paths() const;

 private:
	const std::string prefix_;
	const std::set<std::string> formats_;
	const PictureContents pictures_;
	std::string createdDirectory_;  ///< removed again if no file is written
	std::optional<AtomicFile> measurements_;
	std::vector<AtomicFile> finished_;

	bool wanted(const std::string& format) const { return formats_.count(format) != 0; }
	std::string pathOf(const std::string& format) const;
	void createDirectory();
	void writePictures(const CRidgeMap2D& map, const std::vector<std::vector<Point2>>& robotPaths,
					   const std::string& title);
	void writeScene(const CRidgeMap2D& map, const std::vector<std::vector<Point2>>& robotPaths);
	/** Starts a file, has it written and keeps it until all others are finished, too. */
	void keep(const std::string& format, const std::function<void(AtomicFile&)>& writer);
};

}  // namespace ridgemap::apps
