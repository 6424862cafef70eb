// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/CRidgeMap2D.h>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "frame.h"
#include "progress.h"
#include "resume.h"

namespace ridgemap::apps
{
/** In which portions the measurements reach the map. The outcome does not depend on it. */
struct Feed
{
	std::optional<std::uint64_t> shuffleSeed;  ///< random order
	std::size_t batch = 0;                     ///< measurements per insertion; 0: scan by scan
	unsigned threads = 1;
	bool everyScan = false;  ///< polylines are made after every insertion, not once at the end
	bool keepGoing = false;  ///< what cannot be used of an input is left out and counted, instead of an error
};

/** What one input held. */
struct InputReport
{
	std::string path;
	std::string poseSource;
	std::size_t scans = 0;  ///< observations that gave measurements
	std::size_t measurements = 0;
	std::size_t withoutPose = 0;                 ///< observations left out because their pose is not known
	std::size_t notFinite = 0;                   ///< ranges left out because they are NaN or infinite
	std::map<std::string, std::size_t> classes;  ///< observations by class
	std::map<std::string, std::size_t> skipped;  ///< what --keep-going left out, and how much of it
	std::vector<Point2> robotPath;
};

/** What all updates of a run did and how long they took. */
struct UpdateReport
{
	std::vector<double> insertions;  ///< time of every insertion without its update [ms]

	UpdateResult sum;  ///< without regions and names of polylines
	std::size_t regions = 0, vanished = 0, appeared = 0;
	std::vector<double> milliseconds;  ///< time of every update, with that of its insertion if it came after each [ms]
};

/** Feeds a map from readers. */
class Builder
{
 public:
	/** `map` holds what an earlier run had inserted up to `earlierRun`; frames up to there are read, but not inserted.
	 * `onMeasurement` is told every measurement, in the order of the inputs. */
	Builder(CRidgeMap2D& map, const Feed& feed, const ResumePoint& earlierRun,
			std::function<void(const Measurement&)> onMeasurement, Progress& progress);

	/** Feeds the frames of an input, all or up to an interrupt. Throws UserError if there is no measurement in it. */
	void add(const std::string& path, FrameReader& reader);

	/** Merges an earlier map. */
	void add(const std::string& path, const CRidgeMap2D& earlier);

	/** Feeds what is still waiting and brings the map up to date. Call once after the last add(). */
	void finish();

	/** Whether to read on; from the first interrupt on, not. */
	bool goOn();

	/** An interrupt came before all inputs were read: the map holds the frames up to done(). */
	bool stopped() const { return stopped_; }
	const ResumePoint& done() const { return done_; }
	/** An interrupt came before this run was as far as the one that it continues. */
	bool behindEarlierRun() const { return done_.frames < earlierRun_.frames || done_.maps < earlierRun_.maps; }

	const std::vector<InputReport>& inputs() const { return inputs_; }
	const UpdateReport& updates() const { return updates_; }

 private:
	CRidgeMap2D& map_;
	const Feed feed_;
	const ResumePoint earlierRun_;
	ResumePoint done_;
	bool stopped_ = false;
	const std::function<void(const Measurement&)> onMeasurement_;
	Progress& progress_;
	std::vector<InputReport> inputs_;
	UpdateReport updates_;
	std::vector<Measurement> waiting_;  ///< for the next batch, or for shuffling
	bool outdated_ = false;             ///< measurements were inserted without an update

	ObservedScan scanOf(Frame& frame, InputReport& report) const;
	/** Counts a frame; false if the map holds it already. */
	bool isNew(const ObservedScan& scan);
	[[noreturn]] void failOtherInputs() const;
	void take(ObservedScan&& scan, bool isScan);
	/** Inserts by `change` and, if the polylines are to be up to date after it, updates. */
	void insert(const std::function<void()>& change, bool update);
	void insert(const std::vector<Measurement>& measurements);
	void feedShuffled();
	void update(double millisecondsBefore);
};

}  // namespace ridgemap::apps
