// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "../common/segment.h"

namespace ridgemap::apps
{
/** Colours, blue-green-red as OpenCV has them. */
namespace colours
{
const cv::Scalar ridge(40, 40, 200), truth(60, 150, 40), dots(150, 110, 60), path(30, 130, 240), black(30, 30, 30),
	white(255, 255, 255), node(200, 60, 160);
}

/** A picture of a part of the plane, y up. */
class Raster
{
 public:
	/** @param width of the picture [pixels]; the height follows from the box */
	Raster(const Box2& box, int width);

	/** Shades every place by a value of 0 .. 1: white to dark blue, or white to black. */
	void shade(const std::function<double(const Point2&)>& value, bool coloured = true);
	void dots(const std::vector<Point2>& points, const cv::Scalar& colour, double radius);
	void line(const std::vector<Point2>& points, const cv::Scalar& colour, double width);
	void segments(const std::vector<Segment>& segments, const cv::Scalar& colour, double width);
	void rectangle(const Box2& box, const cv::Scalar& colour);
	/** Bar of a length in a corner of the picture, at the right and at the bottom if not said otherwise. */
	void scaleBar(double metres, const std::string& text, bool right = true, bool bottom = true);

	/** Image with a line of text above it. */
	cv::Mat titled(const std::string& title) const;
	double pixelsPerMetre() const { return scale_; }

 private:
	cv::Point at(const Point2& p) const;

	Box2 box_;
	double scale_;
	cv::Mat image_;
};

/** Puts images side by side, scaled to one height, and writes a PNG. */
void writeRow(const std::string& path, const std::vector<cv::Mat>& images, int width);

}  // namespace ridgemap::apps
