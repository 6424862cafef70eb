// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <ridgemap/atomic_file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace ridgemap
{
namespace
{
[[noreturn]] void fail(const std::string& path, int error)
{
	throw std::runtime_error("cannot write '" + path + "': " + (error != 0 ? std::strerror(error) : "write error"));
}

/** Creates an empty file of its own beside the target; the process and a counter keep simultaneous writers apart. */
std::string createBeside(const std::string& path)
{
	static std::atomic<unsigned> counter{0};
	for (int attempt = 0; attempt < 100; attempt++)
	{
		const std::string name = path + ".tmp-" + std::to_string(getpid()) + "-" + std::to_string(counter++);
		const int fd = open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
		if (fd >= 0)
		{
			close(fd);
			return name;
		}
		if (errno != EEXIST) fail(path, errno);
	}
	fail(path, EEXIST);
}

/** Waits until what was written is on the disk. EINVAL: there is nothing to wait for, such as a pipe. */
void syncToDisk(int fd, const std::string& path)
{
	const int error = fsync(fd) != 0 ? errno : 0;
	close(fd);
	if (error != 0 && error != EINVAL) fail(path, error);
}

/** Without this, a crash of the machine could bring back the old name. */
void syncFolderOf(const std::string& path)
{
	const std::size_t slash = path.rfind('/');
	const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
	const int fd = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
	if (fd >= 0) syncToDisk(fd, path);  // else one may write into the folder but not read it
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path)
{
	struct stat info;
	if (stat(path.c_str(), &info) == 0 && S_ISDIR(info.st_mode)) fail(path, EISDIR);
	temporary_ = createBeside(path);
}

AtomicFile::AtomicFile(AtomicFile&& o) noexcept
	: path_(std::move(o.path_)),
	  temporary_(std::exchange(o.temporary_, std::string())),
	  stream_(std::move(o.stream_)),
	  finished_(o.finished_)
{
}

AtomicFile::~AtomicFile()
{
	if (temporary_.empty()) return;
	if (stream_.is_open()) stream_.close();
	std::remove(temporary_.c_str());
}

std::ostream& AtomicFile::stream()
{
	if (!stream_.is_open())
	{
		errno = 0;
		stream_.open(temporary_, std::ios::binary | std::ios::trunc);
		if (!stream_) fail(path_, errno);
	}
	return stream_;
}

void AtomicFile::finish()
{
	if (finished_) return;
	if (stream_.is_open())
	{
		errno = 0;
		stream_.close();
		if (!stream_) fail(path_, errno);
	}
	// Without this, a crash of the machine after the rename could leave an empty file under the final name.
	const int fd = open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
	if (fd < 0) fail(path_, errno);
	syncToDisk(fd, path_);
	finished_ = true;
}

void AtomicFile::commit()
{
	finish();
	if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, errno);
	temporary_.clear();
	syncFolderOf(path_);
}

}  // namespace ridgemap
