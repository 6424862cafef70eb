// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <ridgemap/CRidgeMap2D.h>

namespace ridgemap
{
namespace
{
void drawPolylines(const std::vector<Polyline>& polylines, const char* name, const mrpt::img::TColor& color,
				   double lineWidth, mrpt::opengl::CSetOfObjects& scene)
{
	auto lines = mrpt::opengl::CSetOfLines::Create();
	for (const auto& polyline : polylines)
		for (std::size_t i = 1; i < polyline.points.size(); i++)
		{
			const Point2 &a = polyline.points[i - 1], &b = polyline.points[i];
			lines->appendLine(a.x, a.y, 0, b.x, b.y, 0);
		}
	lines->setName(name);
	lines->setColor_u8(color);
	lines->setLineWidth(float(lineWidth));
	scene.insert(lines);
}

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
	if (o.showRidges) drawPolylines(ridges(), "ridges", o.ridgeColor, o.lineWidth, outObj);
	if (o.showWalls) drawPolylines(walls(), "walls", o.wallColor, o.lineWidth, outObj);
}

}  // namespace ridgemap
