// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/3rdparty/tclap/CmdLine.h>

#include <string>
#include <vector>

namespace ridgemap::apps
{
/** Help on stdout in a readable form, and wrong usage as a UserError, in place of TCLAP's own output. */
class HelpOutput : public TCLAP::CmdLineOutput
{
 public:
	/** @param synopsis arguments that a usual call has, such as `INPUT... -o PREFIX` */
	HelpOutput(const std::string& program, const std::string& synopsis) : program_(program), synopsis_(synopsis) {}

	void usage(TCLAP::CmdLineInterface& cmd) override;
	void version(TCLAP::CmdLineInterface& cmd) override;
	void failure(TCLAP::CmdLineInterface& cmd, TCLAP::ArgException& e) override;

 private:
	std::string program_, synopsis_;
};

/** Throws UserError for the first input that looks like an option: TCLAP takes unknown options for inputs. */
void rejectUnknownOptions(const std::vector<std::string>& inputs, const std::string& program);

}  // namespace ridgemap::apps
