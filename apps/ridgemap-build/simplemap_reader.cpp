// SPDX-License-Identifier: BSD-3-Clause
#include "simplemap_reader.h"

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDF.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdint>

#include "../common/gz_input.h"
#include "../common/user_error.h"

namespace ridgemap::apps
{
namespace
{
/** MRPT takes memory for as many frames as a file says it holds: refuses numbers that are greater than the file. */
void checkCount(const std::string& path)
{
	constexpr std::uint64_t leastBytes = 32;  // of a frame: the class names of the pose and of the sensory frame
	GzInput input(path);
	std::uint8_t length = 0, count[4] = {};
	std::uint8_t name[129];  // and the version
	if (input.Read(&length, 1) != 1 || (length & 0x80) == 0) return;
	length &= 0x7f;
	if (input.Read(name, length + 1u) != length + 1u || input.Read(count, 4) != 4) return;
	const std::uint64_t frames = count[0] | count[1] << 8 | count[2] << 16 | std::uint64_t(count[3]) << 24;
	const std::uint64_t start = input.getPosition();
	try
	{
		input.drain();
	}
	catch (const UserError&)
	{
		// Damage is found again when the frames are read.
	}
	if (frames > (input.getPosition() - start) / leastBytes + 1)
		throw UserError("'" + path + "' says that it holds more frames than fit into it",
						"record or download it again");
}
}  // namespace

SimpleMapReader::SimpleMapReader(const std::string& path, bool keepGoing) : path_(path), keepGoing_(keepGoing)
{
	checkCount(path);
	mrpt::img::CImage::setImagesPathBase(mrpt::obs::CRawlog::detectImagesDirectory(path));
	try
	{
		load();
	}
	catch (const UserError&)
	{
		// What MRPT had read before the damage is in the map, which has its full size already.
		if (!keepGoing || map_.empty()) throw;
	}
}

void SimpleMapReader::load()
{
	GzInput input(path_);
	try
	{
		auto archive = mrpt::serialization::archiveFrom(input);
		archive >> map_;
		input.drain();
	}
	catch (const UserError&)
	{
		throw;
	}
	catch (const std::exception& e)
	{
		if (input.ranDry()) throw UserError("'" + path_ + "' is truncated", "record or download it again");
		throw UserError("'" + path_ + "' is not a simplemap: " + oneLine(e), "give a file saved by CSimpleMap");
	}
}

void SimpleMapReader::skip(const std::string& what, const std::string& remedy)
{
	if (!keepGoing_) throw UserError("'" + path_ + "' holds " + what, remedy);
	skipped_[what]++;
}

bool SimpleMapReader::next(Frame& frame)
{
	for (; index_ < map_.size(); index_++, observation_ = 0)
	{
		mrpt::poses::CPose3DPDF::Ptr pdf;
		mrpt::obs::CSensoryFrame::Ptr sf;
		map_.get(index_, pdf, sf);
		if (!pdf || !sf)
		{
			skip("frames without pose or observations", "repair it, or use the rest of it by --keep-going");
			continue;
		}
		while (observation_ < sf->size())
		{
			frame = Frame();
			frame.observation = sf->getObservationByIndex(observation_++);
			frame.pose = pdf->getMeanVal();
			if (frame.observation) return true;
			skip("places without an observation", "repair it, or use the rest of it by --keep-going");
		}
		sf->clear();  // a whole log stays in memory otherwise while the map grows
	}
	return false;
}

double SimpleMapReader::fraction() const
{
	return map_.empty() ? 1 : double(index_) / double(map_.size());
}

}  // namespace ridgemap::apps
