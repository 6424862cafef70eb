// SPDX-License-Identifier: BSD-3-Clause
#include "grid_image.h"

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CArchive.h>
#include <ridgemap/atomic_file.h>
#include <ridgemap/gz_archive.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "../common/user_error.h"

namespace ridgemap::apps
{
namespace
{
constexpr double margin = 0.5;  // [m]
constexpr double mostCells = 4e8;

std::int64_t cellIndex(double v, double resolution)
{
	return std::int64_t(std::floor(v / resolution));
}

/** Where a line crosses the borders of cells along one axis. */
struct Axis
{
	std::int64_t cell;
	std::int64_t step;
	double next;   ///< position along the segment of the next border, 0 .. 1
	double delta;  ///< between borders

	Axis(double a, double b, double resolution)
		: cell(cellIndex(a, resolution)),
		  step(b > a ? 1 : -1),
		  next(std::numeric_limits<double>::infinity()),
		  delta(std::numeric_limits<double>::infinity())
	{
		if (a == b) return;
		const double border = double(cell + (step > 0 ? 1 : 0)) * resolution;
		next = (border - a) / (b - a);
		delta = resolution / std::abs(b - a);
	}

	void advance()
	{
		cell += step;
		next += delta;
	}
};
}  // namespace

GridImage::GridImage(const Box2& box, double resolution) : resolution_(resolution)
{
	const double w = box.max.x - box.min.x + 2 * margin, h = box.max.y - box.min.y + 2 * margin;
	if (w / resolution * (h / resolution) > mostCells)
		throw UserError("a grid of this resolution would have more than 400 million cells",
						"give a greater --resolution");
	x0_ = cellIndex(box.min.x - margin, resolution);
	y0_ = cellIndex(box.min.y - margin, resolution);
	width_ = std::size_t(cellIndex(box.max.x + margin, resolution) - x0_ + 1);
	height_ = std::size_t(cellIndex(box.max.y + margin, resolution) - y0_ + 1);
	cells_.assign(width_ * height_, Cell::unknown);
}

void GridImage::set(std::int64_t x, std::int64_t y, Cell value)
{
	const auto column = std::size_t(x - x0_), row = std::size_t(y - y0_);  // what is below zero becomes too great
	if (column >= width_ || row >= height_) return;
	Cell& cell = cells_[row * width_ + column];
	cell = std::max(cell, value);
}

void GridImage::mark(const Point2& a, const Point2& b, Cell value)
{
	Axis x(a.x, b.x, resolution_), y(a.y, b.y, resolution_);
	set(x.cell, y.cell, value);
	while (std::min(x.next, y.next) <= 1)
	{
		(x.next < y.next ? x : y).advance();
		set(x.cell, y.cell, value);
	}
}

void GridImage::markFree(const std::function<bool(const Point2&)>& isFree)
{
	const Point2 low = origin();
	for (std::size_t row = 0; row < height_; row++)
		for (std::size_t column = 0; column < width_; column++)
		{
			Cell& cell = cells_[row * width_ + column];
			const Point2 centre{low.x + (double(column) + 0.5) * resolution_,
								low.y + (double(row) + 0.5) * resolution_};
			if (cell == Cell::unknown && isFree(centre)) cell = Cell::free;
		}
}

void GridImage::writeGridMap(const std::string& path) const
{
	const Point2 low = origin();
	mrpt::maps::COccupancyGridMap2D grid;
	grid.setSize(float(low.x), float(low.x + double(width_) * resolution_), float(low.y),
				 float(low.y + double(height_) * resolution_), float(resolution_), 0.5f);
	for (std::size_t row = 0; row < height_; row++)
		for (std::size_t column = 0; column < width_; column++)
			if (const Cell c = at(column, row); c != Cell::unknown)
			{
				// The bounds were rounded in single precision: the cell is the one around the centre.
				const float x = float(low.x + (double(column) + 0.5) * resolution_);
				const float y = float(low.y + (double(row) + 0.5) * resolution_);
				grid.setPos(x, y, c == Cell::free ? 1.0f : 0.0f);
			}
	AtomicFile file(path);
	writeGzArchive(file, [&](mrpt::serialization::CArchive& out) { out << grid; });
	file.commit();
}

void GridImage::writeRosMap(const std::string& path) const
{
	const std::filesystem::path picturePath = std::filesystem::path(path).replace_extension(".pgm");
	AtomicFile picture(picturePath.string()), description(path);
	std::ostream& pgm = picture.stream();
	pgm << "P5\n" << width_ << ' ' << height_ << "\n255\n";
	for (std::size_t row = height_; row-- > 0;)
		for (std::size_t column = 0; column < width_; column++)
		{
			constexpr unsigned char gray[] = {205, 254, 0};  // as ROS's map_saver writes them
			pgm.put(char(gray[std::size_t(at(column, row))]));
		}
	std::ostream& yaml = description.stream();
	yaml.precision(12);
	yaml << "image: " << picturePath.filename().string() << "\nresolution: " << resolution_ << "\norigin: ["
		 << origin().x << ", " << origin().y << ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
	picture.finish();
	description.finish();
	picture.commit();
	description.commit();
}

}  // namespace ridgemap::apps
