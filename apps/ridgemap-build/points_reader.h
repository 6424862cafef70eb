// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../common/gz_input.h"
#include "frame.h"

namespace ridgemap::apps
{
/** Reads points from text: `x y` or `x y sensorX sensorY` a line [m], separated by commas, semicolons, tabs or blanks;
 * an optional header line, empty lines and comments after `#` are skipped. */
class PointsReader : public FrameReader
{
 public:
	explicit PointsReader(const std::string& path) : input_(path) {}

	bool next(Frame& frame) override;
	double fraction() const override { return input_.fraction(); }
	std::string poseSource() const override { return "none (points of the map frame)"; }

 private:
	GzInput input_;
	std::size_t line_ = 0;   ///< number of the line read last
	bool dataSeen_ = false;  ///< a header may come before the first data line only
	bool headerSeen_ = false;

	/** Reads the next data line; false at the end. */
	bool readPoint(Measurement& point);
	[[noreturn]] void failLine(const std::string& why) const;
};

}  // namespace ridgemap::apps
