// SPDX-License-Identifier: BSD-3-Clause
#include "raster.h"

#include <ridgemap/atomic_file.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace ridgemap::apps
{
namespace
{
constexpr int coarse = 2;        // pixels per shaded sample
constexpr int subpixelBits = 4;  // of OpenCV's coordinates
constexpr int titleHeight = 56;
constexpr int gap = 16;

cv::Vec3b shadeOf(double v, bool coloured)
{
	v = std::min(1.0, std::max(0.0, v));
	const double dark = coloured ? 1 : 0.9;
	const double r = 255 * (1 - dark * v), g = 255 * (1 - (coloured ? 0.75 : dark) * v);
	const double b = 255 * (1 - (coloured ? 0.45 : dark) * v);
	return {uchar(b), uchar(g), uchar(r)};
}
}  // namespace

Raster::Raster(const Box2& box, int width)
	: box_(box),
	  scale_(width / (box.max.x - box.min.x)),
	  image_(int(std::lround((box.max.y - box.min.y) * scale_)), width, CV_8UC3, cv::Scalar(255, 255, 255))
{
}

cv::Point Raster::at(const Point2& p) const
{
	const double one = 1 << subpixelBits;
	return {int(std::lround((p.x - box_.min.x) * scale_ * one)), int(std::lround((box_.max.y - p.y) * scale_ * one))};
}

void Raster::shade(const std::function<double(const Point2&)>& value, bool coloured)
{
	cv::Mat small((image_.rows + coarse - 1) / coarse, (image_.cols + coarse - 1) / coarse, CV_8UC3);
	for (int row = 0; row < small.rows; row++)
		for (int col = 0; col < small.cols; col++)
		{
			const Point2 p{box_.min.x + (col + 0.5) * coarse / scale_, box_.max.y - (row + 0.5) * coarse / scale_};
			small.at<cv::Vec3b>(row, col) = shadeOf(value(p), coloured);
		}
	cv::resize(small, image_, image_.size(), 0, 0, cv::INTER_LINEAR);
}

void Raster::dots(const std::vector<Point2>& points, const cv::Scalar& colour, double radius)
{
	for (const Point2& p : points)
		cv::circle(image_, at(p), int(std::lround(radius * (1 << subpixelBits))), colour, cv::FILLED, cv::LINE_AA,
				   subpixelBits);
}

void Raster::line(const std::vector<Point2>& points, const cv::Scalar& colour, double width)
{
	std::vector<cv::Point> corners;
	for (const Point2& p : points) corners.push_back(at(p));
	cv::polylines(image_, corners, false, colour, int(std::lround(width)), cv::LINE_AA, subpixelBits);
}

void Raster::segments(const std::vector<Segment>& segments, const cv::Scalar& colour, double width)
{
	for (const Segment& s : segments) line({s.a, s.b}, colour, width);
}

void Raster::rectangle(const Box2& b, const cv::Scalar& colour)
{
	line({b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}, b.min}, colour, 3);
}

void Raster::scaleBar(double metres, const std::string& text, bool right, bool bottom)
{
	const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 1, 2, nullptr);
	const int length = int(std::lround(metres * scale_)), width = std::max(length, size.width), margin = 30;
	const int left = right ? image_.cols - margin - width : margin, y = bottom ? image_.rows - margin : margin + 50;
	cv::rectangle(image_, {left - 15, y - 56}, {left + width + 15, y + 18}, colours::white, cv::FILLED);
	const int middle = left + width / 2;
	cv::line(image_, {middle - length / 2, y}, {middle + length / 2, y}, colours::black, 5);
	cv::putText(image_, text, {middle - size.width / 2, y - 20}, cv::FONT_HERSHEY_SIMPLEX, 1, colours::black, 2,
				cv::LINE_AA);
}

cv::Mat Raster::titled(const std::string& title) const
{
	cv::Mat framed;
	cv::copyMakeBorder(image_, framed, titleHeight, 2, 2, 2, cv::BORDER_CONSTANT, colours::white);
	cv::rectangle(framed, {1, titleHeight - 1}, {framed.cols - 2, framed.rows - 2}, cv::Scalar(200, 200, 200), 1);
	cv::putText(framed, title, {6, titleHeight - 18}, cv::FONT_HERSHEY_SIMPLEX, 1.05, colours::black, 2, cv::LINE_AA);
	return framed;
}

void writeRow(const std::string& path, const std::vector<cv::Mat>& images, int width)
{
	int height = 0;
	for (const cv::Mat& m : images) height = std::max(height, m.rows);
	cv::Mat row(height, 0, CV_8UC3);
	for (std::size_t i = 0; i < images.size(); i++)
	{
		cv::Mat padded;
		cv::copyMakeBorder(images[i], padded, 0, height - images[i].rows, i > 0 ? gap : 0, 0, cv::BORDER_CONSTANT,
						   colours::white);
		if (i == 0)
			row = padded;
		else
			cv::hconcat(row, padded, row);
	}
	const double scale = double(width) / row.cols;
	if (scale < 1) cv::resize(row, row, {}, scale, scale, cv::INTER_AREA);
	std::vector<unsigned char> bytes;
	cv::imencode(".png", row, bytes);
	AtomicFile file(path);
	file.stream().write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
	file.commit();
}

}  // namespace ridgemap::apps
