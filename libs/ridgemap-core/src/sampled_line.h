// SPDX-License-Identifier: BSD-3-Clause
// Lines with the evidence for and against them along their way.
#pragma once

#include <ridgemap/types.h>

#include <vector>

#include "free_space.h"
#include "wall_path.h"

namespace ridgemap
{
/** Hits and passes at one place of a line. */
struct Evidence
{
	double hits = 0, passes = 0;
};

/** A line with places at even distances along it. The line must outlive it. */
class SampledLine
{
 public:
	static constexpr double spacing = 0.5;  ///< of places along a line, at most [sigma]

	SampledLine(const Polyline& line, const FreeSpace& space, double sigma);

	std::size_t size() const { return evidence_.size(); }
	double step() const { return step_; }
	double length() const { return path_.length(); }

	/** Sums over the places within `reach` places of place i, and how many these are. */
	Evidence sum(std::size_t i, int reach, int& count) const;

	/** The stretch from arc length a to b as a line of its own; over the seam of a closed line if b is beyond its
	 * length. */
	Polyline stretch(double a, double b) const;

 private:
	Evidence evidenceAt(double s, std::size_t& node, const FreeSpace& space, double sigma) const;
	void fillOccupancies();
	Vec2 behind(double s) const;
	double occupancyBetween(std::size_t node, double s) const;
	VertexInfo infoAt(double s) const;

	const Polyline& line_;
	Path path_;
	double step_ = 0;
	std::vector<double> occupancies_;  ///< of the vertices
	std::vector<Evidence> evidence_;
};

}  // namespace ridgemap
