// SPDX-License-Identifier: BSD-3-Clause
// Saving that fails, is killed, or finds no room: the old file or the new one, whole.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <thread>

#include "stored_files.h"

using namespace ridgemap;
using namespace ridgemap::test;
namespace fs = std::filesystem;

namespace
{
/** What fsync() below was asked to write, in order. */
std::vector<std::string>& syncs()
{
	static std::vector<std::string> all;
	return all;
}

bool& syncFails()
{
	static bool fails = false;
	return fails;
}
}  // namespace

/** Takes the place of the C library's in this program. */
extern "C" int fsync(int fd)
{
	std::error_code ignored;
	syncs().push_back(fs::read_symlink("/proc/self/fd/" + std::to_string(fd), ignored).string());
	if (!syncFails()) return int(syscall(SYS_fsync, fd));
	errno = EIO;
	return -1;
}

TEST(AtomicFiles, FileAndThenFolderAreOnTheDisk)
{
	const Folder folder;
	CRidgeMap2D map;
	map.insertMeasurements({{1, 2}});
	syncs().clear();
	saveRidgeMap(folder / "a.ridgemap", map);
	ASSERT_EQ(syncs().size(), 2u);
	EXPECT_EQ(syncs()[0].find(folder / "a.ridgemap.tmp-"), 0u) << syncs()[0];
	EXPECT_EQ(syncs()[1] + "/a.ridgemap", folder / "a.ridgemap");
}

TEST(AtomicFiles, ADiskThatFailsIsAnErrorThatLeavesTheOldFile)
{
	const Folder folder;
	const std::string path = folder / "a.ridgemap";
	CRidgeMap2D map;
	saveRidgeMap(path, map);
	const Bytes before = contentOf(path);
	map.insertMeasurements({{1, 2}});
	syncFails() = true;
	EXPECT_THROW(saveRidgeMap(path, map), std::exception);
	syncFails() = false;
	EXPECT_TRUE(contentOf(path) == before);
	EXPECT_EQ(folder.files(), 1u) << "a temporary file stays";
}

TEST(AtomicFiles, AProcessKilledWhileItSavesLeavesTheOldMapOrTheNewOne)
{
	const Folder folder;
	const std::string path = folder / "a.ridgemap";
	const CRidgeMap2D map = mapOfRoom(4000);
	CRidgeMap2D old;
	old.insertMeasurements({{1, 2}});
	const Bytes before = bytesOf(old), after = bytesOf(map);
	const auto start = std::chrono::steady_clock::now();
	saveRidgeMap(path, map);
	const auto takes = std::chrono::steady_clock::now() - start;
	saveRidgeMap(path, old);
	int killed = 0;
	const int times = 100;
	for (int i = 0; i < times; i++)
	{
		const pid_t child = fork();
		if (child == 0)
		{
			saveRidgeMap(path, map);
			_exit(0);
		}
		std::this_thread::sleep_for(2 * i * takes / times);
		kill(child, SIGKILL);
		int status = 0;
		waitpid(child, &status, 0);
		killed += WIFSIGNALED(status);
		const std::optional<Bytes> now = loaded(path);
		ASSERT_TRUE(now == before || now == after) << i;
		if (now == after) saveRidgeMap(path, old);
	}
	std::cout << killed << " of " << times << " were killed before they had saved\n";
	EXPECT_GT(killed, 5);
}

TEST(FullDisk, LeavesTheOldFile)
{
	// A limit on the size of files acts as a full disk does.
	const Folder folder;
	const std::string path = folder / "a.ridgemap";
	const CRidgeMap2D map = mapOfRoom();
	CRidgeMap2D old;
	old.insertMeasurements({{1, 2}});
	saveRidgeMap(path, map);
	const std::size_t size = fs::file_size(path);
	saveRidgeMap(path, old);
	const Bytes before = contentOf(path);
	std::signal(SIGXFSZ, SIG_IGN);
	rlimit unlimited{};
	ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &unlimited), 0);
	for (std::size_t room = 0; room < size; room += 1 + size / 200)
	{
		rlimit limit = unlimited;
		limit.rlim_cur = room;
		ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
		EXPECT_THROW(saveRidgeMap(path, map), std::exception) << "room for " << room << " of " << size << " bytes";
		setrlimit(RLIMIT_FSIZE, &unlimited);
		ASSERT_TRUE(contentOf(path) == before) << "room for " << room << " of " << size << " bytes";
		ASSERT_EQ(folder.files(), 1u) << "a temporary file stays";
	}
	saveRidgeMap(path, map);
	EXPECT_TRUE(loaded(path) == bytesOf(map));
}
