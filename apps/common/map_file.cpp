// SPDX-License-Identifier: BSD-3-Clause
#include "map_file.h"

#include "gz_input.h"
#include "user_error.h"

namespace ridgemap::apps
{
CRidgeMap2D loadMap(const std::string& path)
{
	GzInput(path).drain();  // says more clearly what is wrong with a file that is missing, cut off or damaged
	try
	{
		return loadRidgeMap(path);
	}
	catch (const std::exception& e)
	{
		const std::string cause = oneLine(e);
		const bool named = cause.find(path) != std::string::npos;
		throw UserError(named ? cause : "'" + path + "': " + cause, "give a .ridgemap that ridgemap-build wrote");
	}
}

}  // namespace ridgemap::apps
