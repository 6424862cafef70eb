// SPDX-License-Identifier: BSD-3-Clause
#include "frozen_polylines.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ridgemap
{
namespace
{
constexpr int gridBits = 20;
constexpr double farthest = 1e9;  // [m]

double onGrid(double v)
{
	if (!(std::abs(v) <= farthest))
		throw std::invalid_argument("a coordinate of a polyline is not finite or beyond +-1e9 m");
	return std::ldexp(std::nearbyint(std::ldexp(v, gridBits)), -gridBits);
}

/** Fewest points with which a polyline is one, the repeated first point of a closed one included. */
std::size_t leastPoints(bool closed)
{
	return closed ? 4 : 2;
}

std::int64_t toUnits(double v)
{
	return std::int64_t(std::ldexp(v, gridBits));
}

double fromUnits(std::uint64_t units)
{
	const double v = std::ldexp(double(std::int64_t(units)), -gridBits);
	if (!(std::abs(v) <= farthest)) throw std::runtime_error("stored ridge map: a coordinate is out of range");
	return v;
}
}  // namespace

std::vector<Polyline> toFrozen(const std::vector<Polyline>& lines)
{
	std::vector<Polyline> out;
	for (const Polyline& line : lines)
	{
		Polyline frozen;
		frozen.closed = line.closed;
		for (const Point2& p : line.points)
		{
			const Point2 q{onGrid(p.x), onGrid(p.y)};
			if (frozen.points.empty() || frozen.points.back() != q) frozen.points.push_back(q);
		}
		if (frozen.points.size() < leastPoints(frozen.closed)) continue;
		frozen.info.resize(frozen.points.size());
		out.push_back(std::move(frozen));
	}
	return out;
}

void writeFrozen(ByteWriter& out, const std::vector<Polyline>& lines)
{
	out.number(lines.size());
	std::int64_t x = 0, y = 0;
	for (const Polyline& line : lines)
	{
		out.byte(line.closed);
		const std::size_t n = line.points.size() - (line.closed ? 1 : 0);
		out.number(n);
		for (std::size_t i = 0; i < n; i++)
		{
			const std::int64_t u = toUnits(line.points[i].x), v = toUnits(line.points[i].y);
			out.signedNumber(u - x);
			out.signedNumber(v - y);
			x = u;
			y = v;
		}
	}
}

std::vector<Polyline> readFrozen(ByteReader& in)
{
	constexpr std::size_t bytesPerPoint = 2, bytesPerLine = 2 + 2 * bytesPerPoint;
	std::vector<Polyline> lines(in.count(bytesPerLine));
	std::uint64_t x = 0, y = 0;  // unsigned, for a forged difference must not overflow
	for (Polyline& line : lines)
	{
		line.closed = in.byte() != 0;
		line.points.resize(in.count(bytesPerPoint));
		for (Point2& p : line.points)
		{
			p.x = fromUnits(x += std::uint64_t(in.signedNumber()));
			p.y = fromUnits(y += std::uint64_t(in.signedNumber()));
		}
		if (line.closed && !line.points.empty()) line.points.push_back(line.points.front());
		if (line.points.size() < leastPoints(line.closed))
			throw std::runtime_error("stored ridge map: a polyline has too few points");
		line.info.resize(line.points.size());
	}
	return lines;
}

}  // namespace ridgemap
