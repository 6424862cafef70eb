// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace ridgemap::apps
{
/** A progress bar with rate and time left on stderr, if that is a terminal. */
class Progress
{
 public:
	/** Shows nothing if `wanted` is false or stderr is no terminal. */
	explicit Progress(bool wanted);
	~Progress() { clear(); }
	Progress(const Progress&) = delete;
	Progress& operator=(const Progress&) = delete;

	/** Starts over with a new task. */
	void start(const std::string& task, const std::string& unit);

	/** Tells how far the task is; draws at most ten times a second.
	 * @param fraction of the task, 0 .. 1
	 * @param count units done, for the rate */
	void show(double fraction, std::size_t count);

	/** Removes the bar, so that other text can be printed. */
	void clear();

 private:
	using Clock = std::chrono::steady_clock;
	bool shown_;
	bool drawn_ = false;
	std::string task_, unit_;
	Clock::time_point start_, last_;
};

}  // namespace ridgemap::apps
