// SPDX-License-Identifier: BSD-3-Clause
#include "rawlog_reader.h"

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/serialization/CArchive.h>
#include <ridgemap/observation_to_measurements.h>

#include "../common/user_error.h"

namespace ridgemap::apps
{
namespace
{
using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CRawlog;
using mrpt::obs::CSensoryFrame;
using mrpt::serialization::CSerializable;

/** Reads the next object of the log, which may be null; false at the end. `count` is the number of objects before. */
bool readObject(GzInput& input, std::size_t count, CSerializable::Ptr& object)
{
	if (input.atEnd()) return false;
	try
	{
		auto archive = mrpt::serialization::archiveFrom(input);
		object = archive.ReadObject();
		return true;
	}
	catch (const std::exception& e)
	{
		const std::string after = " after " + std::to_string(count) + " objects";
		if (input.ranDry() || oneLine(e).find("is truncated;") != std::string::npos)
			throw UserError("'" + input.path() + "' is truncated" + after, "record or download it again");
		if (count == 0)
			throw UserError("'" + input.path() + "' is not a rawlog: " + oneLine(e), "give a file recorded by MRPT");
		throw UserError("'" + input.path() + "' is damaged" + after + ": " + oneLine(e), "record or download it again");
	}
}

/** Calls f with every part of the log: actions, sensory frames and single observations. */
template <class F>
void forParts(const CSerializable::Ptr& object, F&& f)
{
	if (const auto log = std::dynamic_pointer_cast<CRawlog>(object))
		for (const auto& part : *log) f(part);
	else
		f(object);
}

/** What a log knows about odometry. */
struct OdometryScan
{
	PoseTrack track;       ///< of CObservationOdometry
	bool actions = false;  ///< some action holds a movement
};

void scanPart(const CSerializable::Ptr& part, OdometryScan& scan)
{
	const auto observe = [&](const CObservation::Ptr& observation)
	{
		if (const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation))
			scan.track.add(timeOf(*odometry), mrpt::poses::CPose3D(odometry->odometry));
	};
	if (const auto action = std::dynamic_pointer_cast<CActionCollection>(part))
	{
		mrpt::poses::CPose3D increment;
		scan.actions = scan.actions || action->getFirstMovementEstimationMean(increment);
	}
	else if (const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(part))
		for (const auto& observation : *frame) observe(observation);
	else if (part)
		observe(std::dynamic_pointer_cast<CObservation>(part));
}

/** Sees all objects of the log, up to damage if `keepGoing`. */
void scanLog(const std::string& path, bool keepGoing, OdometryScan& scan)
{
	GzInput input(path);
	try
	{
		CSerializable::Ptr object;
		for (std::size_t count = 0; readObject(input, count, object); count++)
			forParts(object, [&](const CSerializable::Ptr& part) { scanPart(part, scan); });
	}
	catch (const UserError&)
	{
		if (!keepGoing) throw;
	}
}

std::unique_ptr<PoseSource> makeOdometryPoses(const std::string& path, bool keepGoing)
{
	OdometryScan scan;
	scanLog(path, keepGoing, scan);
	if (scan.actions) return makeActionPoses();
	if (scan.track.empty())
		throw UserError("'" + path + "' holds no odometry", "leave out --odometry, or give --poses");
	scan.track.finish();
	return makeTrackPoses(std::make_shared<PoseTrack>(std::move(scan.track)), "odometry");
}

std::unique_ptr<PoseSource> makePoses(const std::string& path, const PoseChoice& choice, bool keepGoing)
{
	if (choice.track) return makeTrackPoses(choice.track, "pose file");
	if (choice.odometry) return makeOdometryPoses(path, keepGoing);
	return makeIcpPoses(choice.map, choice.config);
}

/** Reads what is stored outside of the log, where it is of use here. */
void loadExternal(const CObservation& observation, const std::string& path)
{
	if (!canConvertToMeasurements(observation)) return;
	try
	{
		observation.load();
	}
	catch (const std::exception& e)
	{
		throw UserError("'" + path + "' refers to data outside of it that cannot be read: " + oneLine(e),
						"put the directory of the external images beside the rawlog");
	}
}

}  // namespace

RawlogReader::RawlogReader(const std::string& path, const PoseChoice& choice, bool keepGoing)
	: input_(path), keepGoing_(keepGoing), poses_(makePoses(path, choice, keepGoing))
{
	mrpt::img::CImage::setImagesPathBase(CRawlog::detectImagesDirectory(path));
}

bool RawlogReader::readNext(CSerializable::Ptr& object)
{
	try
	{
		if (!readObject(input_, objects_, object)) return false;
		objects_++;
		return true;
	}
	catch (const UserError&)
	{
		// Objects have no marks by which to find the next one behind damage.
		if (!keepGoing_ || objects_ == 0) throw;
		skipped_["interruptions by damage, behind which nothing was read"]++;
		return false;
	}
}

void RawlogReader::skip(const std::string& what)
{
	if (!keepGoing_)
		throw UserError("'" + input_.path() + "' holds " + what + " (object " + std::to_string(objects_) + ")",
						"repair it, or use the rest of it by --keep-going");
	skipped_[what]++;
}

bool RawlogReader::isUsable(const CObservation::Ptr& observation)
{
	if (!observation)
	{
		skip("places without an object");
		return false;
	}
	if (observation->timestamp == INVALID_TIMESTAMP) return true;
	const double time = timeOf(*observation);
	const std::string sensor = std::string(observation->GetRuntimeClass()->className) + ' ' + observation->sensorLabel;
	const auto [last, isFirst] = lastTimes_.emplace(sensor, time);
	if (!isFirst && time < last->second)
	{
		skip("observations with times that run backwards");
		return false;
	}
	last->second = time;
	return true;
}

bool RawlogReader::next(Frame& frame)
{
	while (queue_.empty())
	{
		CSerializable::Ptr object;
		if (!readNext(object)) return false;
		try
		{
			forParts(object, [this](const CSerializable::Ptr& part) { take(part); });
		}
		catch (const UserError&)
		{
			throw;
		}
		catch (const std::exception& e)
		{
			throw UserError("no poses for '" + input_.path() + "': " + oneLine(e), "give --poses or --odometry");
		}
	}
	frame = std::move(queue_.front());
	queue_.pop_front();
	return true;
}

void RawlogReader::take(const CSerializable::Ptr& part)
{
	if (const auto action = std::dynamic_pointer_cast<CActionCollection>(part))
		poses_->see(action);
	else if (const auto sensoryFrame = std::dynamic_pointer_cast<CSensoryFrame>(part))
	{
		for (std::size_t i = sensoryFrame->size(); i-- > 0;)
			if (!isUsable(sensoryFrame->getObservationByIndex(i))) sensoryFrame->eraseByIndex(i);
		for (const auto& observation : *sensoryFrame) loadExternal(*observation, input_.path());
		poses_->see(sensoryFrame);
		for (const auto& observation : *sensoryFrame) enqueue(observation);
	}
	else if (const auto observation = std::dynamic_pointer_cast<CObservation>(part))
	{
		if (!isUsable(observation)) return;
		loadExternal(*observation, input_.path());
		poses_->see(observation);
		enqueue(observation);
	}
	else
		skip(part ? std::string("objects of the class ") + part->GetRuntimeClass()->className
				  : "places without an object");
}

void RawlogReader::enqueue(const CObservation::Ptr& observation)
{
	Frame frame;
	frame.observation = observation;
	frame.pose = poses_->poseOf(*observation);
	queue_.push_back(std::move(frame));
}

}  // namespace ridgemap::apps
