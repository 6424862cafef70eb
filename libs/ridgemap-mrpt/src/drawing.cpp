// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "drawing_canvas.h"
#include "drawing_errors.h"

namespace ridgemap::drawing
{
namespace
{
constexpr Color dark{24, 28, 44}, dots{180, 203, 228}, orange{240, 128, 24}, grey{110, 116, 128}, faint{236, 238, 242},
	red{214, 40, 40}, freeShade{232, 245, 228};
constexpr double legendBottom = 145;  ///< below the frame, in units of Layout::unit

/** Lines and paths decide what is shown; measurements only where there is nothing else, because a few stray returns
 * far outside would make the map small. */
Box2 shownBox(const Drawing& d)
{
	Box2 box;
	for (const Polyline& l : d.lines)
		for (const Point2& p : l.points) box.extend(p);
	const bool haveLines = !box.empty();
	for (const auto& path : d.paths)
		for (const Point2& p : path) box.extend(p);
	if (!haveLines)
		for (const Point2& p : d.measurements) box.extend(p);
	if (box.empty()) box.extend(Point2{0, 0});
	const double longer = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
	const double margin = longer > 0 ? 0.025 * longer : 0.5;
	// A straight wall along an axis still gets a page of some height.
	const double padX = std::max(margin, (0.25 * longer - (box.max.x - box.min.x)) / 2);
	const double padY = std::max(margin, (0.25 * longer - (box.max.y - box.min.y)) / 2);
	box.extend(Point2{box.min.x - padX, box.min.y - padY});
	box.extend(Point2{box.max.x + padX, box.max.y + padY});
	return box;
}

/** Distance of grid lines and ticks [m]: about one per 180 pixels of a standard picture. */
double tickStep(const Layout& l)
{
	return niceStep(180 * l.unit / l.scale);
}

template <class F>
void forTicks(double lo, double hi, double step, F&& f)
{
	for (double k = std::ceil(lo / step); k * step <= hi; k++) f(k * step);
}

void drawGrid(Canvas& c, const Layout& l)
{
	const double step = tickStep(l), w = 1.2 * l.unit;
	forTicks(l.box.min.x, l.box.max.x, step,
			 [&](double x) { c.line(l.px(x), l.top, l.px(x), l.top + l.height, w, faint); });
	forTicks(l.box.min.y, l.box.max.y, step,
			 [&](double y) { c.line(l.left, l.py(y), l.left + l.width, l.py(y), w, faint); });
}

void drawAxes(Canvas& c, const Layout& l)
{
	const double u = l.unit, w = 1.5 * u, tick = 9 * u, size = 26 * u;
	const double right = l.left + l.width, bottom = l.top + l.height, step = tickStep(l);
	c.line(l.left, l.top, right, l.top, w, grey);
	c.line(l.left, bottom, right, bottom, w, grey);
	c.line(l.left, l.top, l.left, bottom, w, grey);
	c.line(right, l.top, right, bottom, w, grey);
	forTicks(l.box.min.x, l.box.max.x, step,
			 [&](double x)
			 {
				 c.line(l.px(x), bottom, l.px(x), bottom + tick, w, grey);
				 c.text(l.px(x), bottom + tick + 1.15 * size, numberText(x, step), size, Anchor::middle, grey);
			 });
	forTicks(l.box.min.y, l.box.max.y, step,
			 [&](double y)
			 {
				 c.line(l.left - tick, l.py(y), l.left, l.py(y), w, grey);
				 c.text(l.left - 1.6 * tick, l.py(y) + 0.36 * size, numberText(y, step), size, Anchor::right, grey);
			 });
	c.text(l.left + l.width / 2, bottom + tick + 2.45 * size, "x [m]", size, Anchor::middle, grey);
	c.verticalText(l.left - 100 * u, l.top + l.height / 2, "y [m]", size, grey);
}

void drawWalls(Canvas& c, const Layout& l, const Drawing& d)
{
	if (d.standardErrors)
	{
		const ErrorScale scale(d.lines);
		scale.drawLines(c, l, d.lines);
		scale.drawLegend(c, l, legendBottom + 20);
		return;
	}
	std::vector<const std::vector<Point2>*> lines;
	for (const Polyline& line : d.lines) lines.push_back(&line.points);
	if (!lines.empty()) c.mapLines(lines, 2.8 * l.unit, dark);
}

/** Below the frame on the left: a bar of a round number of metres. */
void drawScaleBar(Canvas& c, const Layout& l)
{
	const double u = l.unit, size = 26 * u, y = l.top + l.height + 108 * u, cap = 9 * u;
	const double metres = niceStep(160 * u / l.scale), length = metres * l.scale;
	c.line(l.left, y, l.left + length, y, 4 * u, dark);
	c.line(l.left, y - cap, l.left, y + cap, 3 * u, dark);
	c.line(l.left + length, y - cap, l.left + length, y + cap, 3 * u, dark);
	c.text(l.left + length + 16 * u, y + 0.36 * size, numberText(metres, metres) + " m", size, Anchor::left, dark);
}

/** Below the frame on the right, from right to left. */
void drawLegend(Canvas& c, const Layout& l, const Drawing& d)
{
	const double u = l.unit, size = 26 * u, y = l.top + l.height + 108 * u;
	double x = l.left + l.width;
	const auto entry = [&](const std::string& name, double width, Color color)
	{
		c.text(x, y + 0.36 * size, name, size, Anchor::right, dark);
		x -= 0.66 * size * double(name.size()) + 16 * u;
		c.line(x - 48 * u, y, x, y, width, color);
		x -= 84 * u;
	};
	if (!d.paths.empty()) entry("robot path", 2 * u, orange);
	if (!d.measurements.empty()) entry("measurements", 8 * u, dots);
	if (!d.freeCells.empty()) entry("free", 16 * u, freeShade);
	if (!d.cleared.empty()) entry("passed through", 3 * u, red);
	if (!d.lines.empty() && !d.standardErrors) entry("walls", 3 * u, dark);
}

}  // namespace

double niceStep(double x)
{
	const double decade = std::pow(10.0, std::floor(std::log10(x)));
	for (const double m : {1.0, 2.0, 5.0})
		if (m * decade >= x * (1 - 1e-9)) return m * decade;
	return 10 * decade;
}

std::string numberText(double v, double step)
{
	const int decimals = std::max(0, int(std::ceil(-std::log10(step) - 1e-9)));
	char s[64];
	std::snprintf(s, sizeof(s), "%.*f", decimals, std::abs(v) < step / 2 ? 0.0 : v);
	return s;
}

Layout makeLayout(const Drawing& drawing)
{
	if (drawing.longerSide < 100 || drawing.longerSide > 8000)
		throw std::invalid_argument("longerSide of a drawing is " + std::to_string(drawing.longerSide) +
									"; it must be 100 .. 8000 pixels");
	Layout l;
	l.box = shownBox(drawing);
	l.unit = drawing.longerSide / 2000.0;
	const double w = l.box.max.x - l.box.min.x, h = l.box.max.y - l.box.min.y;
	l.scale = drawing.longerSide / std::max(w, h);
	l.width = w * l.scale;
	l.height = h * l.scale;
	l.left = 130 * l.unit;
	l.top = (drawing.title.empty() ? 30 : 70) * l.unit;
	l.pageWidth = std::ceil(l.left + l.width + 40 * l.unit);
	l.pageHeight = std::ceil(l.top + l.height + legendBottom * l.unit);
	if (drawing.standardErrors) l.pageHeight += std::ceil(ErrorScale::legendHeight * l.unit);
	return l;
}

std::vector<Point2> thinnedMeasurements(const Layout& l, const std::vector<Point2>& points, double spacing)
{
	const auto columns = std::size_t(std::ceil(l.width / spacing)) + 1;
	const auto rows = std::size_t(std::ceil(l.height / spacing)) + 1;
	std::vector<bool> taken(columns * rows, false);
	for (const Point2& p : points)
	{
		const double x = std::floor((l.px(p.x) - l.left) / spacing), y = std::floor((l.py(p.y) - l.top) / spacing);
		if (x >= 0 && y >= 0 && x < double(columns) && y < double(rows))
			taken[std::size_t(y) * columns + std::size_t(x)] = true;
	}
	const double step = spacing / l.scale;
	std::vector<Point2> centres;
	for (std::size_t y = 0; y < rows; y++)
		for (std::size_t x = 0; x < columns; x++)
			if (taken[y * columns + x])
				centres.push_back({l.box.min.x + (double(x) + 0.5) * step, l.box.max.y - (double(y) + 0.5) * step});
	return centres;
}

void draw(Canvas& c, const Layout& l, const Drawing& d)
{
	drawGrid(c, l);
	// Cells are turned against the picture: dots of 1.2 times their edge leave no gaps.
	if (!d.freeCells.empty()) c.mapDots(d.freeCells, std::max(1.0, 1.2 * d.freeCellEdge * l.scale), freeShade);
	if (!d.measurements.empty()) c.mapDots(d.measurements, 2.4 * l.unit, dots);
	std::vector<const std::vector<Point2>*> lines;
	for (const auto& path : d.paths) lines.push_back(&path);
	if (!lines.empty()) c.mapLines(lines, 1.6 * l.unit, orange);
	lines.clear();
	for (const Polyline& line : d.cleared) lines.push_back(&line.points);
	if (!lines.empty()) c.mapLines(lines, 2.8 * l.unit, red);
	drawWalls(c, l, d);
	drawAxes(c, l);
	drawScaleBar(c, l);
	drawLegend(c, l, d);
	if (!d.title.empty()) c.text(l.left, 46 * l.unit, d.title, 30 * l.unit, Anchor::left, dark);
}

}  // namespace ridgemap::drawing
