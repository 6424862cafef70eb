// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/serialization/CArchive.h>
#include <ridgemap/gz_archive.h>
#include <ridgemap/scene_file.h>

#include <algorithm>

namespace ridgemap
{
namespace
{
/** Half the height that a camera of MRPT's sees at a distance of 1: its field of view is 45 degrees. */
constexpr double halfHeight = 0.41421356;
/** Width over height of the smallest windows, and how much more than the objects is shown. */
constexpr double windowShape = 1.2, margin = 1.1;

void appendPolyline(mrpt::opengl::CSetOfLines& lines, const std::vector<Point2>& points)
{
	for (std::size_t i = 1; i < points.size(); i++)
		lines.appendLine(points[i - 1].x, points[i - 1].y, 0, points[i].x, points[i].y, 0);
}

mrpt::opengl::CSetOfLines::Ptr emptyLines(const char* name, const mrpt::img::TColor& color, double lineWidth)
{
	auto lines = mrpt::opengl::CSetOfLines::Create();
	lines->setName(name);
	lines->setColor_u8(color);
	lines->setLineWidth(float(lineWidth));
	return lines;
}

/** The box around all lines; MRPT refuses to make that of a scene without any. */
mrpt::math::TBoundingBox boxOfLines(const mrpt::opengl::COpenGLScene& scene)
{
	auto box = mrpt::math::TBoundingBox::PlusMinusInfinity();
	scene.visitAllObjects(
		[&](const mrpt::opengl::CRenderizable::Ptr& object)
		{
			const auto lines = std::dynamic_pointer_cast<mrpt::opengl::CSetOfLines>(object);
			if (lines && !lines->empty()) box = box.unionWith(lines->getBoundingBox());
		});
	return box;
}

/** Puts the camera above the middle of the lines, with x to the right and y up. */
void lookDown(mrpt::opengl::COpenGLScene& scene)
{
	const auto box = boxOfLines(scene);
	if (!(box.min.x <= box.max.x)) return;
	const auto middle = 0.5 * (box.min + box.max), size = box.max - box.min;
	auto& camera = scene.getViewport()->getCamera();
	camera.setPointingAt(middle.x, middle.y, 0);
	camera.setZoomDistance(float(std::max(1.0, margin * 0.5 * std::max(size.x / windowShape, size.y) / halfHeight)));
	camera.setAzimuthDegrees(-90);
	camera.setElevationDegrees(90);
	scene.enableFollowCamera(true);
}
}  // namespace

mrpt::opengl::CSetOfLines::Ptr sceneLines(const std::vector<std::vector<Point2>>& polylines, const char* name,
										  const mrpt::img::TColor& color, double lineWidth)
{
	auto lines = emptyLines(name, color, lineWidth);
	for (const auto& points : polylines) appendPolyline(*lines, points);
	return lines;
}

mrpt::opengl::CSetOfLines::Ptr sceneLines(const std::vector<Polyline>& polylines, const char* name,
										  const mrpt::img::TColor& color, double lineWidth)
{
	auto lines = emptyLines(name, color, lineWidth);
	for (const auto& polyline : polylines) appendPolyline(*lines, polyline.points);
	return lines;
}

void writeScene(AtomicFile& file, const std::vector<mrpt::opengl::CRenderizable::Ptr>& objects)
{
	mrpt::opengl::COpenGLScene scene;
	for (const auto& object : objects) scene.insert(object);
	lookDown(scene);
	scene.getViewport()->setCustomBackgroundColor({1, 1, 1});
	writeGzArchive(file, [&](mrpt::serialization::CArchive& out) { out << scene; });
}

}  // namespace ridgemap
