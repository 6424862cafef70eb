// SPDX-License-Identifier: BSD-3-Clause
#include "builder.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <ridgemap/observation_to_measurements.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "../common/user_error.h"
#include "interrupt.h"

namespace ridgemap::apps
{
namespace
{
std::size_t countNotFinite(const mrpt::obs::CObservation& observation)
{
	const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation);
	std::size_t count = 0;
	for (std::size_t i = 0; scan != nullptr && i < scan->getScanSize(); i++)
		count += std::isfinite(scan->getScanRange(i)) ? 0 : 1;
	return count;
}

bool isFinite(const mrpt::poses::CPose3D& pose)
{
	for (const double v : {pose.x(), pose.y(), pose.z(), pose.yaw(), pose.pitch(), pose.roll()})
		if (!std::isfinite(v)) return false;
	return true;
}

/** Calls fn and gives the time it took [ms]. */
template <class Fn>
double timeOf(Fn fn)
{
	const auto start = std::chrono::steady_clock::now();
	fn();
	return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/** Says what an input held instead of measurements. */
[[noreturn]] void failEmpty(const InputReport& r)
{
	if (r.classes.empty())
		throw UserError("'" + r.path + "' holds no measurements", "give a file with points or observations");
	std::string classes;
	std::size_t all = 0;
	for (const auto& [name, count] : r.classes)
	{
		classes += (classes.empty() ? "" : ", ") + std::to_string(count) + " " + name;
		all += count;
	}
	if (r.withoutPose == all)
		throw UserError("'" + r.path + "' and its poses do not overlap in time",
						"give --poses with times in seconds since 1970 as in the log, or leave them out");
	throw UserError(
		"'" + r.path + "' holds no usable measurements, only " + classes,
		"give 2-D scans, 3-D range scans, Velodyne scans, point clouds or sonar ranges within minRange, maxRange, minZ "
		"and maxZ");
}

}  // namespace

Builder::Builder(CRidgeMap2D& map, const Feed& feed, const ResumePoint& earlierRun,
				 std::function<void(const Measurement&)> onMeasurement, Progress& progress)
	: map_(map), feed_(feed), earlierRun_(earlierRun), onMeasurement_(std::move(onMeasurement)), progress_(progress)
{
}

ObservedScan Builder::scanOf(Frame& frame, InputReport& report) const
{
	if (!frame.observation) return {0, std::move(frame.points), {}};
	const auto& observation = *frame.observation;
	report.classes[observation.GetRuntimeClass()->className]++;
	if (!frame.pose)
	{
		report.withoutPose++;
		return {};
	}
	if (!isFinite(*frame.pose))
	{
		if (!feed_.keepGoing)
			throw UserError("'" + report.path + "' holds a pose that is not finite",
							"repair the poses, or --keep-going");
		report.skipped["observations at a pose that is not finite"]++;
		return {};
	}
	const Point2 at{frame.pose->x(), frame.pose->y()};
	if (!canConvertToMeasurements(observation)) return {};
	if (report.robotPath.empty() || report.robotPath.back() != at) report.robotPath.push_back(at);
	report.notFinite += countNotFinite(observation);
	return observedScan(observation, *frame.pose, map_.insertionOptions);
}

void Builder::add(const std::string& path, FrameReader& reader)
{
	inputs_.emplace_back();
	InputReport& report = inputs_.back();
	report.path = path;
	progress_.start(path, "measurements");
	for (Frame frame; goOn() && reader.next(frame);)
	{
		const bool isScan = frame.observation != nullptr;
		try
		{
			ObservedScan scan = scanOf(frame, report);
			report.scans += isScan && !scan.measurements.empty() ? 1 : 0;
			report.measurements += scan.measurements.size();
			for (const Measurement& m : scan.measurements) onMeasurement_(m);
			if (isNew(scan)) take(std::move(scan), isScan);
		}
		catch (const UserError&)
		{
			throw;
		}
		catch (const std::exception& e)
		{
			throw UserError("'" + path + "': " + oneLine(e), "repair or leave out this input");
		}
		progress_.show(reader.fraction(), report.measurements);
	}
	report.poseSource = reader.poseSource();
	progress_.clear();
	report.skipped.insert(reader.skipped().begin(), reader.skipped().end());
	if (report.measurements == 0 && !stopped_) failEmpty(report);
}

void Builder::add(const std::string& path, const CRidgeMap2D& earlier)
{
	if (!goOn()) return;
	inputs_.emplace_back();
	inputs_.back().path = path;
	inputs_.back().poseSource = "none (earlier map)";
	if (done_.maps++ < earlierRun_.maps) return;
	map_.merge(earlier);
	outdated_ = true;
}

bool Builder::goOn()
{
	stopped_ = stopped_ || interruptedBy() != 0;
	return !stopped_;
}

bool Builder::isNew(const ObservedScan& scan)
{
	done_.add(scan);
	if (done_.frames > earlierRun_.frames) return true;
	if (done_.frames == earlierRun_.frames && done_.hash != earlierRun_.hash) failOtherInputs();
	return false;
}

void Builder::failOtherInputs() const
{
	throw UserError("the inputs or options are not those of the interrupted run",
					"resume with the same command line, or start without --resume");
}

void Builder::take(ObservedScan&& scan, bool isScan)
{
	if (scan.empty()) return;
	if (!feed_.shuffleSeed && feed_.batch == 0)
	{
		// Points have no time: only observations fall out of a window.
		if (isScan) return insert([&] { map_.insertScan(scan); }, true);
		return insert([&] { map_.insertMeasurements(scan.measurements); }, false);
	}
	map_.insertFreeRays(scan.freeRays);
	outdated_ = true;
	waiting_.insert(waiting_.end(), scan.measurements.begin(), scan.measurements.end());
	if (feed_.shuffleSeed) return;
	std::size_t done = 0;
	for (; interruptedBy() == 0 && waiting_.size() - done >= feed_.batch; done += feed_.batch)
	{
		const auto first = waiting_.begin() + std::ptrdiff_t(done);
		insert(std::vector<Measurement>(first, first + std::ptrdiff_t(feed_.batch)));
	}
	waiting_.erase(waiting_.begin(), waiting_.begin() + std::ptrdiff_t(done));
}

void Builder::insert(const std::vector<Measurement>& measurements)
{
	insert([&] { map_.insertMeasurements(measurements); }, true);
}

void Builder::insert(const std::function<void()>& change, bool update)
{
	const double milliseconds = timeOf(change);
	updates_.insertions.push_back(milliseconds);
	outdated_ = true;
	if (update && feed_.everyScan) this->update(milliseconds);
}

/** Brings the polylines up to date. */
void Builder::update(double millisecondsBefore)
{
	UpdateResult result;
	const double milliseconds = timeOf([&] { result = map_.update(feed_.threads); });
	outdated_ = false;
	updates_.regions += result.regions.size();
	updates_.vanished += result.vanished.size();
	updates_.appeared += result.appeared.size();
	result.regions.clear();
	result.vanished.clear();
	result.appeared.clear();
	updates_.sum += result;
	updates_.milliseconds.push_back(millisecondsBefore + milliseconds);
}

void Builder::feedShuffled()
{
	std::mt19937_64 random(*feed_.shuffleSeed);
	for (std::size_t i = waiting_.size(); i > 1; i--) std::swap(waiting_[i - 1], waiting_[random() % i]);
	const std::size_t batch = feed_.batch != 0 ? feed_.batch : std::max<std::size_t>(1, (waiting_.size() + 9) / 10);
	progress_.start("shuffled", "measurements");
	for (std::size_t done = 0; done < waiting_.size();)
	{
		// Who wants to stop gets all that was read, but in one piece.
		const std::size_t end = interruptedBy() != 0 ? waiting_.size() : std::min(done + batch, waiting_.size());
		insert(
			std::vector<Measurement>(waiting_.begin() + std::ptrdiff_t(done), waiting_.begin() + std::ptrdiff_t(end)));
		progress_.show(double(end) / double(waiting_.size()), end);
		done = end;
	}
	progress_.clear();
}

void Builder::finish()
{
	if (behindEarlierRun() && !stopped_) failOtherInputs();
	if (feed_.shuffleSeed)
		feedShuffled();
	else if (!waiting_.empty())
		insert(waiting_);
	waiting_ = {};
	if (outdated_) update(0);
}

}  // namespace ridgemap::apps
