// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/serialization/CArchive.h>
#include <ridgemap/CRidgeMap2D.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace ridgemap::test
{
constexpr double pi = 3.14159265358979323846;

/** Measurements of the wall from a to b, with noise across and along. */
inline std::vector<Measurement> wall(const Point2& a, const Point2& b, double perMetre = 400, double noise = 0.015,
									 unsigned seed = 1)
{
	std::mt19937 random(seed);
	std::normal_distribution<double> gauss(0, noise);
	std::uniform_real_distribution<double> uniform(0, 1);
	const double length = std::hypot(b.x - a.x, b.y - a.y);
	std::vector<Measurement> all;
	for (int i = 0; i < int(length * perMetre); i++)
	{
		const double t = uniform(random);
		all.push_back({a.x + t * (b.x - a.x) + gauss(random), a.y + t * (b.y - a.y) + gauss(random)});
	}
	return all;
}

/** Four walls of a room from (-w,-h) to (w,h). */
inline std::vector<Measurement> room(double w = 3, double h = 2, double perMetre = 400)
{
	std::vector<Measurement> all;
	const Point2 corners[] = {{-w, -h}, {w, -h}, {w, h}, {-w, h}, {-w, -h}};
	for (unsigned i = 0; i < 4; i++)
	{
		const auto side = wall(corners[i], corners[i + 1], perMetre, 0.015, 10 + i);
		all.insert(all.end(), side.begin(), side.end());
	}
	return all;
}

/** What a scanner at (x, y, phi) sees of that room, all around, without noise. */
inline mrpt::obs::CObservation2DRangeScan scanOfRoom(double x, double y, double phi, std::size_t rays = 361,
													 double w = 3, double h = 2)
{
	mrpt::obs::CObservation2DRangeScan scan;
	scan.aperture = float(2 * pi);
	scan.rightToLeft = true;
	scan.resizeScan(rays);
	for (std::size_t i = 0; i < rays; i++)
	{
		const double angle = phi - pi + 2 * pi * double(i) / double(rays - 1);
		const double c = std::cos(angle), s = std::sin(angle);
		const double rx = c > 0 ? (w - x) / c : (-w - x) / c, ry = s > 0 ? (h - y) / s : (-h - y) / s;
		scan.setScanRange(i, float(std::min(std::abs(rx), std::abs(ry))));
		scan.setScanRangeValidity(i, true);
	}
	return scan;
}

inline std::vector<std::uint8_t> bytesOf(const mrpt::serialization::CSerializable& object)
{
	mrpt::io::CMemoryStream stream;
	auto archive = mrpt::serialization::archiveFrom(stream);
	archive.WriteObject(object);
	std::vector<std::uint8_t> bytes(stream.getTotalBytesCount());
	stream.Seek(0);
	stream.Read(bytes.data(), bytes.size());
	return bytes;
}

inline void readInto(mrpt::serialization::CSerializable& object, const std::vector<std::uint8_t>& bytes)
{
	mrpt::io::CMemoryStream stream;
	stream.assignMemoryNotOwn(bytes.data(), bytes.size());
	auto archive = mrpt::serialization::archiveFrom(stream);
	archive.ReadObject(&object);
}

inline bool samePolylines(const std::vector<Polyline>& a, const std::vector<Polyline>& b)
{
	if (a.size() != b.size()) return false;
	for (std::size_t i = 0; i < a.size(); i++)
		if (a[i].points != b[i].points || a[i].closed != b[i].closed) return false;
	return true;
}

}  // namespace ridgemap::test
