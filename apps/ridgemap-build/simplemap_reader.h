// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CSimpleMap.h>

#include "frame.h"

namespace ridgemap::apps
{
/** Reads a CSimpleMap: every observation of its sensory frames at the mean of the pose stored with it. What was read is
 * given back frame by frame. */
class SimpleMapReader : public FrameReader
{
 public:
	/** Loads the whole file: MRPT stores it as one object.
	 * @param keepGoing takes what comes before damage, and leaves out frames without pose or observations */
	explicit SimpleMapReader(const std::string& path, bool keepGoing = false);

	bool next(Frame& frame) override;
	double fraction() const override;
	std::string poseSource() const override { return "simplemap"; }

 private:
	std::string path_;
	const bool keepGoing_;
	mrpt::maps::CSimpleMap map_;
	std::size_t index_ = 0;        ///< of the sensory frame
	std::size_t observation_ = 0;  ///< within the sensory frame

	void load();
	/** Counts what is left out, or throws. */
	void skip(const std::string& what, const std::string& remedy);
};

}  // namespace ridgemap::apps
