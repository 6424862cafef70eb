// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/CRidgeMap2D.h>

#include <string>

namespace ridgemap::apps
{
/** Loads a map that ridgemap-build or a program of MRPT's wrote. Throws UserError naming the file. */
CRidgeMap2D loadMap(const std::string& path);

}  // namespace ridgemap::apps
