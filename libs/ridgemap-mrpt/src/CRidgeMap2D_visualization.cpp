// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/scene_file.h>

namespace ridgemap
{
namespace
{
void drawPoints(const std::vector<Point2>& points, const char* name, const mrpt::img::TColor& color, double pointSize,
				mrpt::opengl::CSetOfObjects& scene)
{
	auto cloud = mrpt::opengl::CPointCloud::Create();
	for (const auto& p : points) cloud->insertPoint(float(p.x), float(p.y), 0);
	cloud->setName(name);
	cloud->setColor_u8(color);
	cloud->setPointSize(float(pointSize));
	scene.insert(cloud);
}
}  // namespace

void CRidgeMap2D::getVisualizationInto(mrpt::opengl::CSetOfObjects& outObj) const
{
	if (!genericMapParams.enableSaveAs3DObject) return;
	const TRenderOptions& o = renderOptions;
	if (o.showMeasurements) drawPoints(core().cellCentroids(), "measurements", o.measurementColor, o.pointSize, outObj);
	if (o.showRidges) outObj.insert(sceneLines(ridges(), "ridges", o.ridgeColor, o.lineWidth));
	if (o.showWalls) outObj.insert(sceneLines(walls(), "walls", o.wallColor, o.lineWidth));
}

}  // namespace ridgemap
