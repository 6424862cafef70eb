// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/drawing.h>

#include <string>
#include <vector>

namespace ridgemap::drawing
{
struct Color
{
	int r, g, b;
};

enum class Anchor
{
	left,
	middle,
	right
};

/** Where things are: a frame of the map inside a page in pixels. One map metre is `scale` pixels. */
struct Layout
{
	Box2 box;                              ///< part of the map that is shown [m]
	double scale = 1;                      ///< [pixels/m]
	double left = 0, top = 0;              ///< upper left corner of the frame [pixels]
	double width = 0, height = 0;          ///< of the frame [pixels]
	double pageWidth = 0, pageHeight = 0;  ///< [pixels]
	double unit = 1;  ///< size of small things: text, ticks and lines, relative to a picture of 2000 pixels

	/** Page coordinates of a map point [pixels], y down. */
	double px(double x) const { return left + (x - box.min.x) * scale; }
	double py(double y) const { return top + (box.max.y - y) * scale; }
};

/** What SVG and PNG have to be able to draw; widths and sizes in pixels of the page. */
class Canvas
{
 public:
	virtual ~Canvas() = default;
	/** Dots on the map (coordinates in metres), clipped to the frame. */
	virtual void mapDots(const std::vector<Point2>& points, double diameter, Color color) = 0;
	/** Polylines on the map (coordinates in metres), clipped to the frame. */
	virtual void mapLines(const std::vector<const std::vector<Point2>*>& lines, double width, Color color) = 0;
	/** A straight line on the page. */
	virtual void line(double x1, double y1, double x2, double y2, double width, Color color) = 0;
	/** One line of text on the page, its baseline at y, characters of the given height. */
	virtual void text(double x, double y, const std::string& s, double size, Anchor anchor, Color color) = 0;
	/** Text that reads upwards, its baseline at x, centred on y. */
	virtual void verticalText(double x, double y, const std::string& s, double size, Color color) = 0;
};

/** The next value of the series 1, 2, 5, 10, ... (times powers of ten) that is not below x > 0. */
double niceStep(double x);

/** A number with the decimals that a step of this size needs. */
std::string numberText(double v, double step);

/** Chooses the part of the map to show and the size of the page. */
Layout makeLayout(const Drawing& drawing);

/** Draws everything: the same for every kind of file. */
void draw(Canvas& canvas, const Layout& layout, const Drawing& drawing);

/** At most one point for each square of `spacing` pixels of the frame, at its centre, row by row: what a picture can
 * show of millions of measurements, and the same in whatever order they come. */
std::vector<Point2> thinnedMeasurements(const Layout& layout, const std::vector<Point2>& points, double spacing);

}  // namespace ridgemap::drawing
