// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "drawing_canvas.h"

namespace ridgemap::drawing
{
/** Colours for the standard errors of walls: classes between round numbers, chosen so that they tell the walls of this
 * picture apart. A stretch of wall has the larger error of its two vertices. */
class ErrorScale
{
 public:
	explicit ErrorScale(const std::vector<Polyline>& lines);

	/** Height below the frame that the legend takes, in units of Layout::unit. */
	static constexpr double legendHeight = 100;

	void drawLines(Canvas& canvas, const Layout& layout, const std::vector<Polyline>& lines) const;
	/** The scale below the frame on the right, `top` pixels below it. */
	void drawLegend(Canvas& canvas, const Layout& layout, double top) const;

 private:
	std::size_t classOf(float standardError) const;

	std::vector<double> limits_;  ///< upper ends of all classes but the last [m], rising
};

}  // namespace ridgemap::drawing
