// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/observation_to_measurements.h>

#include <deque>
#include <vector>

#include "byte_stream.h"

namespace ridgemap
{
/** The scans that a map with a sliding window has to take out again some time. */
class ScanWindow
{
 public:
	/** What has to go when a scan is added: all but the last `keepScans`, and all older than `keepSeconds` before the
	 * newest time seen; 0: no such limit. The scan that is added may be among them. */
	std::vector<const ObservedScan*> outdatedBy(const ObservedScan& scan, unsigned keepScans, double keepSeconds) const;

	/** Adds the newest scan and forgets what it makes outdated. */
	void push(const ObservedScan& scan, unsigned keepScans, double keepSeconds);

	/** Forgets a scan that was taken out by itself. Nothing happens if it is not here. */
	void forget(const ObservedScan& scan);
	/** Puts a scan in the place of another, if that is here. */
	void replace(const ObservedScan& before, ObservedScan after);

	bool empty() const { return scans_.empty(); }
	void clear() { scans_.clear(); }
	/** Equal to the bit. */
	bool operator==(const ScanWindow& o) const;

	void write(ByteWriter& out) const;
	/** Throws std::runtime_error for data that end too early. */
	static ScanWindow read(ByteReader& in);

 private:
	std::deque<ObservedScan>::iterator find(const ObservedScan& scan);

	std::deque<ObservedScan> scans_;
};

}  // namespace ridgemap
