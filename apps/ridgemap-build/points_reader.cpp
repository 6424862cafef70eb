// SPDX-License-Identifier: BSD-3-Clause
#include "points_reader.h"

#include <ridgemap/options.h>

#include <cctype>
#include <cmath>

#include "../common/number_line.h"
#include "../common/user_error.h"

namespace ridgemap::apps
{
namespace
{
constexpr std::size_t pointsPerFrame = 10000;

/** A header names columns: its first field starts like a word, and is no number such as `nan`. */
bool isHeader(const std::vector<std::string>& fields)
{
	for (const std::string& f : fields)
		if (f.empty() || parseNumber(f) ||
			!(std::isalpha(static_cast<unsigned char>(f[0])) || f[0] == '_' || f[0] == '"'))
			return false;
	return true;
}

}  // namespace

void PointsReader::failLine(const std::string& why) const
{
	throw UserError(input_.path() + ":" + std::to_string(line_) + ": " + why,
					"give 'x y' or 'x y sensorX sensorY' in metres on every line");
}

bool PointsReader::readPoint(Measurement& point)
{
	std::string text;
	while (input_.readLine(text))
	{
		line_++;
		const std::vector<std::string> fields = splitFields(text);
		if (fields.empty()) continue;
		if (!dataSeen_ && !headerSeen_ && isHeader(fields))
		{
			headerSeen_ = true;
			continue;
		}
		if (fields.size() != 2 && fields.size() != 4)
			failLine("expected 2 or 4 numbers, found " + std::to_string(fields.size()) +
					 (fields.size() == 1 ? " field" : " fields"));
		double values[4] = {0, 0, point.sensorX, point.sensorY};
		// As ridgemap-build itself writes it, an unknown sensor position has empty fields.
		const std::size_t known = fields.size() == 4 && fields[2].empty() && fields[3].empty() ? 2 : fields.size();
		for (std::size_t i = 0; i < known; i++)
		{
			const auto v = parseNumber(fields[i]);
			if (!v) failLine("'" + fields[i].substr(0, 40) + "' is not a number");
			if (!std::isfinite(*v)) failLine("'" + fields[i] + "' is not finite");
			if (std::abs(*v) > maxCoordinate) failLine("'" + fields[i] + "' is beyond +-1e6 m");
			values[i] = *v;
		}
		point = {values[0], values[1], values[2], values[3]};
		dataSeen_ = true;
		return true;
	}
	return false;
}

bool PointsReader::next(Frame& frame)
{
	frame = Frame();
	for (Measurement point; frame.points.size() < pointsPerFrame && readPoint(point); point = Measurement())
		frame.points.push_back(point);
	return !frame.points.empty();
}

}  // namespace ridgemap::apps
