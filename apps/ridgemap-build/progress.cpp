// SPDX-License-Identifier: BSD-3-Clause
#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ridgemap::apps
{
namespace
{
constexpr int barWidth = 30;

/** `12 s` or `3:05 min`. */
std::string duration(double seconds)
{
	char text[32];
	const long s = std::lround(seconds);
	if (s < 100)
		std::snprintf(text, sizeof(text), "%ld s", s);
	else
		std::snprintf(text, sizeof(text), "%ld:%02ld min", s / 60, s % 60);
	return text;
}

}  // namespace

Progress::Progress(bool wanted) : shown_(wanted && isatty(STDERR_FILENO) != 0) {}

void Progress::start(const std::string& task, const std::string& unit)
{
	clear();
	task_ = task;
	unit_ = unit;
	start_ = Clock::now();
	last_ = Clock::time_point();
}

void Progress::show(double fraction, std::size_t count)
{
	const auto now = Clock::now();
	if (!shown_ || now - last_ < std::chrono::milliseconds(100)) return;
	last_ = now;
	const double elapsed = std::chrono::duration<double>(now - start_).count();
	fraction = std::clamp(fraction, 0.0, 1.0);
	const int full = int(fraction * barWidth);
	std::fprintf(stderr, "\r%s [%s%s] %3d %%", task_.c_str(), std::string(full, '#').c_str(),
				 std::string(barWidth - full, '.').c_str(), int(fraction * 100));
	if (elapsed > 0.5) std::fprintf(stderr, "  %.0f %s/s", double(count) / elapsed, unit_.c_str());
	if (elapsed > 0.5 && fraction > 0.01)
		std::fprintf(stderr, "  %s left", duration(elapsed * (1 - fraction) / fraction).c_str());
	std::fputs("\x1b[K", stderr);
	std::fflush(stderr);
	drawn_ = true;
}

void Progress::clear()
{
	if (!drawn_) return;
	std::fputs("\r\x1b[K", stderr);
	std::fflush(stderr);
	drawn_ = false;
}

}  // namespace ridgemap::apps
