// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/CRidgeMap2D.h>

#include <memory>
#include <string>

#include "frame.h"
#include "rawlog_reader.h"

namespace ridgemap::apps
{
/** The kinds of file that ridgemap-build reads. */
enum class InputKind
{
	simplemap,
	rawlog,
	points,
	ridgemap
};

/** The kind by the extension, `.gz` at the end left out. Throws UserError for an unknown one. */
InputKind kindOf(const std::string& path);

/** Opens an input of any kind but a ridge map.
 * @param keepGoing what cannot be used of rawlogs and simplemaps is left out and counted, instead of an error */
std::unique_ptr<FrameReader> openReader(const std::string& path, const PoseChoice& poses, bool keepGoing = false);

}  // namespace ridgemap::apps
