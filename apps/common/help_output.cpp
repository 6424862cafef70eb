// SPDX-License-Identifier: BSD-3-Clause
#include "help_output.h"

#include <cstdio>
#include <sstream>

#include "user_error.h"

namespace ridgemap::apps
{
namespace
{
constexpr std::size_t pageWidth = 96, indent = 6;

/** Prints paragraphs with lines broken at blanks. */
void printWrapped(const std::string& text, std::size_t left)
{
	std::istringstream paragraphs(text);
	for (std::string paragraph; std::getline(paragraphs, paragraph);)
	{
		std::istringstream words(paragraph);
		std::string line;
		for (std::string word; words >> word;)
		{
			if (!line.empty() && left + line.size() + 1 + word.size() > pageWidth)
			{
				std::printf("%*s%s\n", int(left), "", line.c_str());
				line.clear();
			}
			line += (line.empty() ? "" : " ") + word;
		}
		std::printf("%*s%s\n", int(left), "", line.c_str());
	}
}

/** `-o, --output PREFIX` of TCLAP's `-o <PREFIX>,  --output <PREFIX>`. */
std::string optionName(const TCLAP::Arg& arg)
{
	std::string name = arg.getFlag().empty() || arg.getFlag() == "-" ? "" : "-" + arg.getFlag() + ", ";
	name += "--" + arg.getName();
	const std::string id = arg.longID();
	const auto open = id.rfind('<'), close = id.rfind('>');
	if (open != std::string::npos && close != std::string::npos) name += " " + id.substr(open + 1, close - open - 1);
	return name;
}

}  // namespace

void HelpOutput::usage(TCLAP::CmdLineInterface& cmd)
{
	std::printf("Usage: %s %s [OPTION]...\n\n", program_.c_str(), synopsis_.c_str());
	printWrapped(cmd.getMessage(), 0);
	std::printf("\nOptions:\n");
	for (const TCLAP::Arg* arg : cmd.getArgList())
	{
		const bool isInput = dynamic_cast<const TCLAP::UnlabeledMultiArg<std::string>*>(arg) != nullptr;
		if (isInput || arg->getName() == TCLAP::Arg::ignoreNameString()) continue;
		std::printf("  %s\n", optionName(*arg).c_str());
		printWrapped(arg->getDescription(), indent);
	}
}

void HelpOutput::version(TCLAP::CmdLineInterface& cmd)
{
	std::printf("%s %s\n", program_.c_str(), cmd.getVersion().c_str());
}

void HelpOutput::failure(TCLAP::CmdLineInterface&, TCLAP::ArgException& e)
{
	const std::string argument = e.argId();
	throw UserError(e.error() + (argument.find_first_not_of(' ') == std::string::npos ? "" : ": " + argument),
					"see " + program_ + " --help");
}

void rejectUnknownOptions(const std::vector<std::string>& inputs, const std::string& program)
{
	for (const std::string& input : inputs)
		if (input.size() > 1 && input[0] == '-')
			throw UserError("unknown option '" + input + "'",
							"see " + program + " --help; a file may be given as ./" + input);
}

}  // namespace ridgemap::apps
