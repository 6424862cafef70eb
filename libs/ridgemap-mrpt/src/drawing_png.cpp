// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/atomic_file.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "drawing_canvas.h"

namespace ridgemap
{
namespace
{
using drawing::Anchor;
using drawing::Color;
using drawing::Layout;

constexpr int oversampling = 2;  ///< drawn larger, then averaged: smoother than OpenCV's own anti-aliasing alone
constexpr int shiftBits = 4;     ///< fractional bits of coordinates given to OpenCV
constexpr int font = cv::FONT_HERSHEY_SIMPLEX;

cv::Scalar bgr(Color c)
{
	return cv::Scalar(c.b, c.g, c.r);
}

/** OpenCV's fonts hold ASCII only: every other character becomes one '?'. */
std::string ascii(const std::string& s)
{
	std::string out;
	for (const char ch : s)
	{
		const auto c = static_cast<unsigned char>(ch);
		if (c >= 0x20 && c < 0x7f)
			out += ch;
		else if ((c & 0xc0) != 0x80)
			out += '?';
	}
	return out;
}

class PngCanvas : public drawing::Canvas
{
 public:
	explicit PngCanvas(const Layout& layout)
		: layout_(layout),
		  image_(int(layout.pageHeight) * oversampling, int(layout.pageWidth) * oversampling, CV_8UC3,
				 cv::Scalar(255, 255, 255))
	{
	}

	void mapDots(const std::vector<Point2>& points, double diameter, Color color) override
	{
		cv::Mat map = frame();
		const int d = std::max(1, int(std::lround(diameter * oversampling)));
		for (const Point2& p : drawing::thinnedMeasurements(layout_, points, 1))
		{
			const int x = int(std::floor(mapX(p.x))) - d / 2, y = int(std::floor(mapY(p.y))) - d / 2;
			cv::rectangle(map, cv::Rect(x, y, d, d), bgr(color), cv::FILLED);
		}
	}

	void mapLines(const std::vector<const std::vector<Point2>*>& lines, double width, Color color) override
	{
		cv::Mat map = frame();
		for (const auto* line : lines)
			for (std::size_t i = 1; i < line->size(); i++)
			{
				const Point2 a = (*line)[i - 1], b = (*line)[i];
				drawSegment(map, mapX(a.x), mapY(a.y), mapX(b.x), mapY(b.y), width, color);
			}
	}

	void line(double x1, double y1, double x2, double y2, double width, Color color) override
	{
		drawSegment(image_, x1 * oversampling, y1 * oversampling, x2 * oversampling, y2 * oversampling, width, color);
	}

	void text(double x, double y, const std::string& s, double size, Anchor anchor, Color color) override
	{
		const cv::Size extent = textSize(ascii(s), size);
		const double shift = anchor == Anchor::left ? 0 : anchor == Anchor::middle ? 0.5 : 1;
		putText(image_, ascii(s), x * oversampling - shift * extent.width, y * oversampling, size, color);
	}

	void verticalText(double x, double y, const std::string& s, double size, Color color) override
	{
		const cv::Size extent = textSize(ascii(s), size);
		cv::Mat label(2 * extent.height, extent.width + 8, CV_8UC3, cv::Scalar(255, 255, 255));
		putText(label, ascii(s), 4, 1.5 * extent.height, size, color);
		cv::rotate(label, label, cv::ROTATE_90_COUNTERCLOCKWISE);
		const cv::Rect page(0, 0, image_.cols, image_.rows);
		const cv::Rect place(int(x * oversampling - 1.5 * extent.height), int(y * oversampling) - label.rows / 2,
							 label.cols, label.rows);
		if ((place & page) == place) label.copyTo(image_(place));
	}

	std::vector<std::uint8_t> encode() const
	{
		cv::Mat small;
		cv::resize(image_, small, cv::Size(image_.cols / oversampling, image_.rows / oversampling), 0, 0,
				   cv::INTER_AREA);
		std::vector<std::uint8_t> bytes;
		if (!cv::imencode(".png", small, bytes)) throw std::runtime_error("OpenCV cannot encode PNG pictures");
		return bytes;
	}

 private:
	const Layout& layout_;
	cv::Mat image_;

	/** The part of the image inside the frame, so that OpenCV clips what sticks out. */
	cv::Mat frame()
	{
		const int left = int(layout_.left * oversampling), top = int(layout_.top * oversampling);
		const int width = int(std::ceil(layout_.width * oversampling)),
				  height = int(std::ceil(layout_.height * oversampling));
		return image_(cv::Rect(left, top, std::min(width, image_.cols - left), std::min(height, image_.rows - top)));
	}
	double mapX(double x) const { return layout_.px(x) * oversampling - std::floor(layout_.left * oversampling); }
	double mapY(double y) const { return layout_.py(y) * oversampling - std::floor(layout_.top * oversampling); }

	/** OpenCV rounds widths to whole pixels and anti-aliases; points so far out that they would overflow its
	 * fixed-point coordinates are left out. */
	static void drawSegment(cv::Mat& target, double x1, double y1, double x2, double y2, double width, Color color)
	{
		constexpr double limit = 1e6;
		for (const double v : {x1, y1, x2, y2})
			if (!(std::abs(v) < limit)) return;
		const auto fixed = [](double v) { return int(std::lround((v - 0.5) * (1 << shiftBits))); };
		cv::line(target, {fixed(x1), fixed(y1)}, {fixed(x2), fixed(y2)}, bgr(color),
				 std::max(1, int(std::lround(width * oversampling))), cv::LINE_AA, shiftBits);
	}

	static double fontScale(double size)
	{
		return cv::getFontScaleFromHeight(font, int(0.74 * size * oversampling), 1);
	}
	static int fontThickness(double size) { return std::max(1, int(std::lround(0.09 * size * oversampling))); }
	static cv::Size textSize(const std::string& s, double size)
	{
		int baseline = 0;
		return cv::getTextSize(s, font, fontScale(size), fontThickness(size), &baseline);
	}
	static void putText(cv::Mat& target, const std::string& s, double x, double y, double size, Color color)
	{
		cv::putText(target, s, {int(std::lround(x)), int(std::lround(y))}, font, fontScale(size), bgr(color),
					fontThickness(size), cv::LINE_AA);
	}
};

}  // namespace

std::vector<std::uint8_t> encodePng(const Drawing& drawing)
{
	const Layout layout = drawing::makeLayout(drawing);
	PngCanvas canvas(layout);
	drawing::draw(canvas, layout, drawing);
	return canvas.encode();
}

void writePng(const std::string& path, const Drawing& drawing)
{
	AtomicFile file(path);
	const std::vector<std::uint8_t> bytes = encodePng(drawing);
	file.stream().write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
	file.commit();
}

}  // namespace ridgemap
