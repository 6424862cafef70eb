// SPDX-License-Identifier: BSD-3-Clause
// Interrupted runs save what there is, say so, and can be continued to the same bytes.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "test_support.h"

namespace ridgemap::test
{
namespace
{
/** Runs ridgemap-build, sends it a signal after a while and gives its return code. */
int runAndSignal(std::vector<std::string> arguments, int signal, int milliseconds, const std::string& errPath)
{
	arguments.insert(arguments.begin(), RIDGEMAP_BUILD_PROGRAM);
	std::vector<char*> argv;
	for (std::string& a : arguments) argv.push_back(a.data());
	argv.push_back(nullptr);
	const pid_t child = fork();
	if (child == 0)
	{
		dup2(open(errPath.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDERR_FILENO);
		execv(argv[0], argv.data());
		_exit(127);
	}
	std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
	kill(child, signal);
	int status = 0;
	waitpid(child, &status, 0);
	return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

class Interrupted : public ::testing::Test
{
 protected:
	const TempDir dir;
	std::string input;

	void SetUp() override
	{
		input = dir / "drive.simplemap";
		writeSimplemap(input, simulateDrive(600));
	}

	/** Interrupts runs, each continued by the next, until one is complete, and compares with a run without that. */
	void expectSameBytes(const std::vector<std::string>& more, int signal)
	{
		std::vector<std::string> arguments{input, "--every-scan", "-q"};
		arguments.insert(arguments.end(), more.begin(), more.end());
		auto whole = arguments, broken = arguments;
		whole.insert(whole.end(), {"-o", dir / "whole"});
		broken.insert(broken.end(), {"-o", dir / "broken"});
		const auto start = std::chrono::steady_clock::now();
		ASSERT_EQ(runBuild(whole).code, 0);
		const int takes = int((std::chrono::steady_clock::now() - start) / std::chrono::milliseconds(1));
		int interrupts = 0, code = 1;
		for (int run = 0; run < 60 && code != 0; run++)
		{
			const std::string err = dir / "err";
			code = runAndSignal(broken, signal, 5 + takes * (run + 1) / 12, err);
			const bool resumable = std::filesystem::exists(dir / "broken.resume");
			if (code != 0)
			{
				ASSERT_TRUE(code == 128 + signal || code == 1000 + signal) << code << ": " << readFile(err);
			}
			if (code == 128 + signal)
			{
				EXPECT_NE(readFile(err).find("interrupted by"), std::string::npos) << readFile(err);
			}
			if (!resumable && broken.back() == "--resume") break;  // all had been read when the signal came
			if (!resumable) continue;
			if (code == 128 + signal) interrupts++;
			// What was saved is a map.
			EXPECT_EQ(runInfo({dir / "broken.ridgemap"}).code, 0);
			if (broken.back() != "--resume") broken.emplace_back("--resume");
		}
		EXPECT_GT(interrupts, 0);
		if (broken.back() != "--resume") return;
		if (std::filesystem::exists(dir / "broken.resume"))
		{
			ASSERT_EQ(runBuild(broken).code, 0);
		}
		EXPECT_FALSE(std::filesystem::exists(dir / "broken.resume"));
		for (const char* suffix :
			 {".ridgemap", "_ridges.csv", "_walls.csv", "_measurements.csv", ".png", ".svg", ".3Dscene"})
			EXPECT_TRUE(readFile(dir / ("whole" + std::string(suffix))) ==
						readFile(dir / ("broken" + std::string(suffix))))
				<< suffix;
	}
};
}  // namespace

TEST_F(Interrupted, byTermAndResumed)
{
	expectSameBytes({}, SIGTERM);
}

TEST_F(Interrupted, byIntWithBatches)
{
	expectSameBytes({"--batch", "70"}, SIGINT);
}

TEST_F(Interrupted, withSlidingWindow)
{
	expectSameBytes({"--keep-last", "40"}, SIGTERM);
}

TEST_F(Interrupted, otherInputsAreNotResumed)
{
	int code = 0;
	for (int wait = 40; wait < 20000 && !std::filesystem::exists(dir / "a.resume"); wait += wait / 2)
		code = runAndSignal({input, "--every-scan", "-q", "-o", dir / "a"}, SIGTERM, wait, dir / "err");
	ASSERT_EQ(code, 143);
	ASSERT_TRUE(std::filesystem::exists(dir / "a.resume"));
	const std::string before = readFile(dir / "a.ridgemap");
	auto other = simulateDrive(601);
	other.erase(other.begin());  // it begins where the interrupted one did, and that may be all that was read
	writeSimplemap(dir / "other.simplemap", other);
	const RunResult r = runBuild({dir / "other.simplemap", "--resume", "-o", dir / "a"});
	EXPECT_EQ(r.code, 1);
	EXPECT_NE(r.err.find("not those of the interrupted run"), std::string::npos) << r.err;
	const RunResult s = runBuild({input, "--sigma", "0.07", "--resume", "-o", dir / "a"});
	EXPECT_NE(s.err.find("not those of the interrupted run"), std::string::npos) << s.err;
	EXPECT_TRUE(readFile(dir / "a.ridgemap") == before);
	// A damaged state is noticed.
	std::string state = readFile(dir / "a.resume");
	state[state.size() / 2] = char(state[state.size() / 2] ^ 4);
	writeFile(dir / "a.resume", state);
	EXPECT_EQ(runBuild({input, "--resume", "-o", dir / "a"}).code, 1);
}

TEST_F(Interrupted, nothingToResume)
{
	const RunResult r = runBuild({input, "--resume", "-o", dir / "none"});
	EXPECT_EQ(r.code, 1);
	EXPECT_NE(r.err.find("none.resume"), std::string::npos) << r.err;
}

}  // namespace ridgemap::test
