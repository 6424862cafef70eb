// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace ridgemap::apps
{
/** A map of square cells: occupied where a line passes, free where a ray went through, else unknown. */
class GridImage
{
 public:
	enum class Cell : std::uint8_t
	{
		unknown,
		free,
		occupied
	};

	/** All cells of the box and a margin around it, unknown. Cell borders are multiples of the resolution [m]. Throws
	 * UserError for a grid of more than 400 million cells. */
	GridImage(const Box2& box, double resolution);

	/** Marks all cells through which the segment passes. Parts outside of the grid are left out. Occupied cells never
	 * become free. */
	void mark(const Point2& a, const Point2& b, Cell value);

	/** Marks the unknown cells as free whose centre is. */
	void markFree(const std::function<bool(const Point2&)>& isFree);

	std::size_t width() const { return width_; }
	std::size_t height() const { return height_; }
	double resolution() const { return resolution_; }
	/** Lower left corner. */
	Point2 origin() const { return {double(x0_) * resolution_, double(y0_) * resolution_}; }
	/** Column from the left, row from below. */
	Cell at(std::size_t column, std::size_t row) const { return cells_[row * width_ + column]; }

	/** COccupancyGridMap2D in a compressed file: 1 free, 0 occupied, 0.5 unknown. */
	void writeGridMap(const std::string& path) const;
	/** Map of ROS: `path` describes it, and the picture beside it has the same name with .pgm. */
	void writeRosMap(const std::string& path) const;

 private:
	double resolution_;
	std::int64_t x0_ = 0, y0_ = 0;  ///< first cell
	std::size_t width_ = 0, height_ = 0;
	std::vector<Cell> cells_;

	void set(std::int64_t x, std::int64_t y, Cell value);
};

}  // namespace ridgemap::apps
