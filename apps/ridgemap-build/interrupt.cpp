// SPDX-License-Identifier: BSD-3-Clause
#include "interrupt.h"

#include <csignal>

namespace ridgemap::apps
{
namespace
{
volatile std::sig_atomic_t interrupted = 0;

extern "C" void noteInterrupt(int signal)
{
	if (interrupted == 0) interrupted = signal;
	std::signal(signal, SIG_DFL);
}
}  // namespace

void catchInterrupts()
{
	// Who starts a program with a signal ignored, as nohup does, means it.
	for (const int signal : {SIGINT, SIGTERM, SIGHUP})
		if (std::signal(signal, noteInterrupt) == SIG_IGN) std::signal(signal, SIG_IGN);
}

int interruptedBy()
{
	return interrupted;
}

std::string interruptName()
{
	return interrupted == SIGINT ? "SIGINT" : interrupted == SIGTERM ? "SIGTERM" : "SIGHUP";
}

}  // namespace ridgemap::apps
