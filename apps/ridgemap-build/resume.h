// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/CRidgeMap2D.h>
#include <ridgemap/atomic_file.h>
#include <ridgemap/observation_to_measurements.h>

#include <cstdint>
#include <string>

namespace ridgemap::apps
{
/** How far a run has come through its inputs. The frames before are recognised by a hash when it is continued. */
struct ResumePoint
{
	std::uint64_t frames = 0;  ///< frames that the map holds, over all inputs
	std::uint64_t hash = 0;    ///< of what was seen in them
	std::uint64_t maps = 0;    ///< earlier maps that were merged

	/** Counts a frame. */
	void add(const ObservedScan& scan);
};

/** Fills PREFIX.resume: all that an interrupted run needs to be continued. */
void writeResume(AtomicFile& file, const ResumePoint& point, const CRidgeMap2D& map);

/** What writeResume() wrote. */
struct InterruptedRun
{
	ResumePoint point;
	CRidgeMap2D map;
};
/** Throws UserError if there is no such file, or if it is damaged. */
InterruptedRun readResume(const std::string& path);

}  // namespace ridgemap::apps
