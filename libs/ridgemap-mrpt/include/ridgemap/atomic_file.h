// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <string>

namespace ridgemap
{
/** A file that appears complete or not at all.
 *
 * Everything goes to a temporary file beside the target; commit() renames it onto the target. Without commit() the
 * temporary file is removed and the target stays as it was. Not thread-safe. */
class AtomicFile
{
 public:
	/** Creates the temporary file. Throws std::runtime_error naming the path and the cause if that is not possible. */
	explicit AtomicFile(const std::string& path);
	~AtomicFile();
	AtomicFile(AtomicFile&& o) noexcept;
	AtomicFile(const AtomicFile&) = delete;
	AtomicFile& operator=(const AtomicFile&) = delete;
	AtomicFile& operator=(AtomicFile&&) = delete;

	/** The target. */
	const std::string& path() const { return path_; }

	/** Where to write to until commit(), for writers that open files by name. */
	const std::string& temporaryPath() const { return temporary_; }

	/** A binary stream into the temporary file, opened on first use. */
	std::ostream& stream();

	/** Closes the stream and makes sure that all was written, but does not rename yet: several files can be finished
	 * before the first of them appears. Throws std::runtime_error as the constructor does. */
	void finish();

	/** finish(), then renames the temporary file onto the target, and waits until the disk has both. Throws as the
	 * constructor does; the target is then as it was, or complete but perhaps not yet on the disk. */
	void commit();

 private:
	std::string path_;
	std::string temporary_;  ///< empty once committed
	std::ofstream stream_;
	bool finished_ = false;
};

}  // namespace ridgemap
