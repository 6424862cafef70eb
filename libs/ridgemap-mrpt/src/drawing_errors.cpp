// SPDX-License-Identifier: BSD-3-Clause
// Walls coloured by their standard errors.
#include "drawing_errors.h"

#include <algorithm>
#include <cmath>

namespace ridgemap::drawing
{
namespace
{
constexpr std::size_t classes = 5;
/** From small errors to large; told apart without red and green, too. The last one: no error is known. */
constexpr Color colours[classes + 1] = {{31, 78, 156},  {40, 160, 190}, {120, 190, 90},
										{240, 160, 30}, {178, 24, 43},  {150, 154, 162}};
constexpr Color text{24, 28, 44};

float errorOfSegment(const Polyline& line, std::size_t second)
{
	if (second >= line.info.size()) return std::numeric_limits<float>::infinity();
	return std::max(line.info[second - 1].standardError, line.info[second].standardError);
}
}  // namespace

ErrorScale::ErrorScale(const std::vector<Polyline>& lines)
{
	std::vector<float> errors;
	for (const Polyline& line : lines)
		for (std::size_t i = 1; i < line.points.size(); i++)
			if (const float e = errorOfSegment(line, i); std::isfinite(e) && e > 0) errors.push_back(e);
	if (errors.empty()) return;
	const auto least = errors.begin() + std::ptrdiff_t(errors.size() / 20);
	std::nth_element(errors.begin(), least, errors.end());
	double limit = double(*least);
	while (limits_.size() + 1 < classes)
	{
		limits_.push_back(niceStep(limit));
		limit = 1.5 * limits_.back();
	}
}

std::size_t ErrorScale::classOf(float standardError) const
{
	if (!std::isfinite(standardError)) return classes;
	return std::size_t(std::lower_bound(limits_.begin(), limits_.end(), double(standardError)) - limits_.begin());
}

void ErrorScale::drawLines(Canvas& canvas, const Layout& layout, const std::vector<Polyline>& lines) const
{
	std::vector<std::vector<Point2>> runs[classes + 1];
	for (const Polyline& line : lines)
		for (std::size_t i = 1, last = classes + 1; i < line.points.size(); i++)
		{
			const std::size_t k = classOf(errorOfSegment(line, i));
			if (k != last) runs[k].push_back({line.points[i - 1]});
			runs[k].back().push_back(line.points[i]);
			last = k;
		}
	for (std::size_t k = classes + 1; k-- > 0;)
	{
		std::vector<const std::vector<Point2>*> pointers;
		for (const auto& run : runs[k]) pointers.push_back(&run);
		if (!pointers.empty()) canvas.mapLines(pointers, 5 * layout.unit, colours[k]);
	}
}

void ErrorScale::drawLegend(Canvas& canvas, const Layout& layout, double top) const
{
	const double u = layout.unit, size = 26 * u, cell = 76 * u, right = layout.left + layout.width;
	const double caption = layout.top + layout.height + top * u, bar = caption + 24 * u, labels = bar + 40 * u;
	canvas.text(right, caption, "standard error [mm]", size, Anchor::right, text);
	// Unknown on the right, then the classes from large to small.
	canvas.line(right - cell, bar, right, bar, 16 * u, colours[classes]);
	canvas.text(right - 0.5 * cell, labels, "none", size, Anchor::middle, text);
	for (std::size_t k = 0; k <= limits_.size() && !limits_.empty(); k++)
	{
		const double x = right - (1.4 + double(limits_.size() - k)) * cell;
		canvas.line(x - cell, bar, x, bar, 16 * u, colours[k]);
		if (k < limits_.size())
			canvas.text(x, labels, numberText(1e3 * limits_[k], 1e3 * limits_[k]), size, Anchor::middle, text);
	}
}

}  // namespace ridgemap::drawing
