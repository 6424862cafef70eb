// SPDX-License-Identifier: BSD-3-Clause
#include "simplemap_reader.h"

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDF.h>
#include <mrpt/serialization/CArchive.h>

#include "../common/gz_input.h"
#include "../common/user_error.h"

namespace ridgemap::apps
{
SimpleMapReader::SimpleMapReader(const std::string& path) : path_(path)
{
	GzInput input(path);
	mrpt::img::CImage::setImagesPathBase(mrpt::obs::CRawlog::detectImagesDirectory(path));
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
		if (input.ranDry()) throw UserError("'" + path + "' is truncated", "record or download it again");
		throw UserError("'" + path + "' is not a simplemap: " + oneLine(e), "give a file saved by CSimpleMap");
	}
}

bool SimpleMapReader::next(Frame& frame)
{
	for (; index_ < map_.size(); index_++, observation_ = 0)
	{
		mrpt::poses::CPose3DPDF::Ptr pdf;
		mrpt::obs::CSensoryFrame::Ptr sf;
		map_.get(index_, pdf, sf);
		if (!pdf || !sf || observation_ >= sf->size()) continue;
		frame = Frame();
		frame.observation = sf->getObservationByIndex(observation_++);
		frame.pose = pdf->getMeanVal();
		return true;
	}
	return false;
}

double SimpleMapReader::fraction() const
{
	return map_.empty() ? 1 : double(index_) / double(map_.size());
}

}  // namespace ridgemap::apps
