// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/opengl/CSetOfLines.h>
#include <ridgemap/atomic_file.h>
#include <ridgemap/types.h>

#include <vector>

namespace ridgemap
{
/** Polylines as lines of MRPT's, at z = 0. @param name by which scenes find them @param lineWidth [pixels] */
mrpt::opengl::CSetOfLines::Ptr sceneLines(const std::vector<std::vector<Point2>>& polylines, const char* name,
										  const mrpt::img::TColor& color, double lineWidth);
mrpt::opengl::CSetOfLines::Ptr sceneLines(const std::vector<Polyline>& polylines, const char* name,
										  const mrpt::img::TColor& color, double lineWidth);

/** Writes a .3Dscene that SceneViewer3D opens with everything in view, from above and on white.
 * @param file to be filled; it is not committed here
 * Throws std::runtime_error naming the path and the cause. */
void writeScene(AtomicFile& file, const std::vector<mrpt::opengl::CRenderizable::Ptr>& objects);

}  // namespace ridgemap
