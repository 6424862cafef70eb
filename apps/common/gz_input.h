// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/io/CStream.h>

#include <cstdint>
#include <string>

struct gzFile_s;

namespace ridgemap::apps
{
/** Reads a file, gzip-compressed or plain, and notices when it is cut off or damaged, which MRPT's own stream does not.
 * Every error is a UserError that names the file. */
class GzInput : public mrpt::io::CStream
{
 public:
	/** Opens the file; a file that is missing, unreadable, a directory or empty is an error. */
	explicit GzInput(const std::string& path);
	~GzInput() override;
	GzInput(const GzInput&) = delete;
	GzInput& operator=(const GzInput&) = delete;

	const std::string& path() const { return path_; }

	/** True when all bytes were read and the check sum of a compressed file was right. */
	bool atEnd();

	/** Reads on to the end, which checks the whole of a compressed file. */
	void drain();

	/** Next line without its line end (LF or CR LF); false at the end. Longer lines than 1 MB are an error. */
	bool readLine(std::string& line);

	/** Part of the file that was read, 0 .. 1. */
	double fraction() const;

	/** True once a read went past the end: what asked for more was reading an incomplete object. */
	bool ranDry() const { return ranDry_; }

	size_t Read(void* buffer, size_t count) override;
	size_t Write(const void* buffer, size_t count) override;
	uint64_t Seek(int64_t offset, CStream::TSeekOrigin origin) override;
	uint64_t getTotalBytesCount() const override { return size_; }
	uint64_t getPosition() const override;
	std::string getStreamDescription() const override { return path_; }

 private:
	std::string path_;
	gzFile_s* file_ = nullptr;
	std::uint64_t size_ = 0;  ///< of the file as it is on disk
	bool ranDry_ = false;

	[[noreturn]] void failRead();
};

}  // namespace ridgemap::apps
