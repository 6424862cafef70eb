// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/io/CStream.h>
#include <ridgemap/gz_archive.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace ridgemap
{
namespace
{
class GzOutput : public mrpt::io::CStream
{
 public:
	explicit GzOutput(const AtomicFile& file) : path_(file.path())
	{
		errno = 0;
		file_ = gzopen(file.temporaryPath().c_str(), "wb1");  // the level that MRPT takes
		if (file_ == nullptr) fail();
	}
	~GzOutput() override
	{
		if (file_ != nullptr) gzclose(file_);
	}
	GzOutput(const GzOutput&) = delete;
	GzOutput& operator=(const GzOutput&) = delete;

	/** Writes what is left; only after this all is in the file. */
	void finish()
	{
		errno = 0;
		const int code = gzclose(std::exchange(file_, nullptr));
		if (code != Z_OK) fail();
	}

	size_t Write(const void* buffer, size_t count) override
	{
		for (size_t done = 0; done < count;)
		{
			const auto part = unsigned(std::min<size_t>(count - done, 1 << 30));
			errno = 0;
			const int got = gzwrite(file_, static_cast<const char*>(buffer) + done, part);
			if (got <= 0) fail();
			done += size_t(got);
		}
		return count;
	}
	size_t Read(void*, size_t) override { throw std::logic_error("a file to write to cannot be read"); }
	uint64_t Seek(int64_t, CStream::TSeekOrigin) override { throw std::logic_error("a compressed file cannot seek"); }
	uint64_t getTotalBytesCount() const override { return getPosition(); }
	uint64_t getPosition() const override { return uint64_t(std::max<z_off_t>(0, gztell(file_))); }
	std::string getStreamDescription() const override { return path_; }

 private:
	std::string path_;  ///< of the target, for messages
	gzFile file_ = nullptr;

	[[noreturn]] void fail() const
	{
		throw std::runtime_error("cannot write '" + path_ +
								 "': " + (errno != 0 ? std::strerror(errno) : "write error"));
	}
};
}  // namespace

void writeGzArchive(AtomicFile& file, const std::function<void(mrpt::serialization::CArchive&)>& write)
{
	GzOutput out(file);
	auto archive = mrpt::serialization::archiveFrom(out);
	write(archive);
	out.finish();
}

}  // namespace ridgemap
