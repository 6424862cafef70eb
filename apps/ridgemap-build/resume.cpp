// SPDX-License-Identifier: BSD-3-Clause
#include "resume.h"

#include <mrpt/serialization/CArchive.h>
#include <ridgemap/gz_archive.h>

#include <cstring>
#include <filesystem>

#include "../common/gz_input.h"
#include "../common/user_error.h"

namespace ridgemap::apps
{
namespace
{
constexpr char magic[] = "ridgemap-build resume 1\n";

void mix(std::uint64_t& hash, double v)
{
	std::uint64_t bits;
	std::memcpy(&bits, &v, sizeof(bits));
	hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
	hash ^= hash >> 32;
}
}  // namespace

void ResumePoint::add(const ObservedScan& scan)
{
	frames++;
	mix(hash, scan.time);
	mix(hash, double(scan.measurements.size()));
	for (const Measurement& m : scan.measurements)
		for (const double v : {m.x, m.y, m.sensorX, m.sensorY}) mix(hash, v);
	for (const FreeRay& r : scan.freeRays)
		for (const double v : {r.x, r.y, r.sensorX, r.sensorY}) mix(hash, v);
}

void writeResume(AtomicFile& file, const ResumePoint& point, const CRidgeMap2D& map)
{
	writeGzArchive(file,
				   [&](mrpt::serialization::CArchive& out)
				   {
					   out.WriteBuffer(magic, sizeof(magic));
					   out << point.frames << point.hash << point.maps << map;
				   });
}

InterruptedRun readResume(const std::string& path)
{
	if (!std::filesystem::exists(path))
		throw UserError("there is no '" + path + "' to resume",
						"leave --resume out: the earlier run was not interrupted");
	GzInput(path).drain();  // notices damage that the map's own checks do not cover
	GzInput input(path);
	try
	{
		auto archive = mrpt::serialization::archiveFrom(input);
		char start[sizeof(magic)] = {};
		if (input.Read(start, sizeof(start)) != sizeof(start) || std::memcmp(start, magic, sizeof(magic)) != 0)
			throw std::runtime_error("it is of another program or version");
		InterruptedRun run;
		archive >> run.point.frames >> run.point.hash >> run.point.maps >> run.map;
		return run;
	}
	catch (const std::exception& e)
	{
		throw UserError("cannot resume from '" + path + "': " + oneLine(e), "remove it and start without --resume");
	}
}

}  // namespace ridgemap::apps
