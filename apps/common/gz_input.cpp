// SPDX-License-Identifier: BSD-3-Clause
#include "gz_input.h"

#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "user_error.h"

namespace ridgemap::apps
{
namespace
{
constexpr unsigned bufferSize = 1 << 17;
constexpr std::size_t maxLineLength = 1 << 20;
}  // namespace

GzInput::GzInput(const std::string& path) : path_(path)
{
	struct stat info;
	if (stat(path.c_str(), &info) != 0)
		throw UserError("cannot read '" + path + "': " + std::strerror(errno), "check the path");
	if (S_ISDIR(info.st_mode)) throw UserError("'" + path + "' is a directory", "name a file in it");
	size_ = std::uint64_t(info.st_size);
	if (S_ISREG(info.st_mode) && size_ == 0) throw UserError("'" + path + "' is empty", "record or download it again");
	errno = 0;
	file_ = gzopen(path.c_str(), "rb");
	if (file_ == nullptr)
		throw UserError("cannot read '" + path + "': " + (errno != 0 ? std::strerror(errno) : "out of memory"),
						"check its permissions");
	gzbuffer(file_, bufferSize);
}

GzInput::~GzInput()
{
	gzclose(file_);
}

void GzInput::failRead()
{
	int code = Z_OK;
	const char* text = gzerror(file_, &code);
	if (code == Z_BUF_ERROR) throw UserError("'" + path_ + "' is truncated", "record or download it again");
	const std::string cause = code == Z_ERRNO ? std::strerror(errno) : text;
	// zlib puts the path in front of its messages.
	const std::string prefix = path_ + ": ";
	throw UserError(
		"'" + path_ + "' cannot be read: " + (cause.rfind(prefix, 0) == 0 ? cause.substr(prefix.size()) : cause),
		"record or download it again");
}

size_t GzInput::Read(void* buffer, size_t count)
{
	size_t done = 0;
	while (done < count)
	{
		const auto part = unsigned(std::min<size_t>(count - done, 1 << 30));
		const int got = gzread(file_, static_cast<char*>(buffer) + done, part);
		if (got < 0) failRead();
		if (got == 0)
		{
			int code = Z_OK;
			gzerror(file_, &code);
			if (code != Z_OK) failRead();
			ranDry_ = true;
			break;
		}
		done += size_t(got);
	}
	return done;
}

bool GzInput::atEnd()
{
	const int c = gzgetc(file_);
	if (c >= 0)
	{
		gzungetc(c, file_);
		return false;
	}
	int code = Z_OK;
	gzerror(file_, &code);
	if (code != Z_OK) failRead();
	return true;
}

void GzInput::drain()
{
	for (char rest[1 << 14]; !atEnd();) Read(rest, sizeof(rest));
}

bool GzInput::readLine(std::string& line)
{
	line.clear();
	char part[4096];
	while (gzgets(file_, part, sizeof(part)) != nullptr)
	{
		line += part;
		if (!line.empty() && line.back() == '\n') break;
		if (line.size() > maxLineLength)
			throw UserError("'" + path_ + "' holds a line of more than 1 MB", "give a text file of numbers");
	}
	int code = Z_OK;
	gzerror(file_, &code);
	if (code != Z_OK) failRead();
	if (line.empty()) return false;
	while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.pop_back();
	return true;
}

double GzInput::fraction() const
{
	const auto at = gzoffset(file_);
	return size_ > 0 && at > 0 ? std::min(1.0, double(at) / double(size_)) : 0;
}

uint64_t GzInput::getPosition() const
{
	return uint64_t(std::max<z_off_t>(0, gztell(file_)));
}

size_t GzInput::Write(const void*, size_t)
{
	throw std::logic_error("GzInput is read-only");
}

uint64_t GzInput::Seek(int64_t, CStream::TSeekOrigin)
{
	throw std::logic_error("GzInput cannot seek");
}

}  // namespace ridgemap::apps
