// SPDX-License-Identifier: BSD-3-Clause
// path-error ESTIMATE REFERENCE [SKIP]: how far a path is from the true one, after the rigid alignment that brings them
// closest (absolute trajectory error). Both files hold one pose a line, `<time or number> x y phi`, row for row; the
// first SKIP rows of the reference are left out, for paths that start later.
#include <mrpt/io/CFileGZInputStream.h>

#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
struct Pose
{
	double x, y, phi;
};

std::vector<Pose> readPath(const std::string& file)
{
	mrpt::io::CFileGZInputStream in;
	if (!in.open(file)) throw std::runtime_error("cannot open '" + file + "'");
	std::string text(1 << 16, '\0'), all;
	for (std::size_t n; (n = in.Read(text.data(), text.size())) > 0;) all.append(text, 0, n);
	std::vector<Pose> path;
	std::istringstream lines(all);
	for (std::string line; std::getline(lines, line);)
	{
		std::istringstream row(line);
		double time;
		Pose p{};
		if (row >> time >> p.x >> p.y >> p.phi) path.push_back(p);
	}
	return path;
}

/** The planar motion that brings `a` closest to `b` in the sense of least squares, applied to `a`. */
std::vector<Pose> aligned(const std::vector<Pose>& a, const std::vector<Pose>& b)
{
	double ax = 0, ay = 0, bx = 0, by = 0, dot = 0, cross = 0;
	const double n = double(a.size());
	for (std::size_t i = 0; i < a.size(); i++)
	{
		ax += a[i].x / n;
		ay += a[i].y / n;
		bx += b[i].x / n;
		by += b[i].y / n;
	}
	for (std::size_t i = 0; i < a.size(); i++)
	{
		dot += (a[i].x - ax) * (b[i].x - bx) + (a[i].y - ay) * (b[i].y - by);
		cross += (a[i].x - ax) * (b[i].y - by) - (a[i].y - ay) * (b[i].x - bx);
	}
	const double turn = std::atan2(cross, dot), c = std::cos(turn), s = std::sin(turn);
	std::vector<Pose> moved;
	for (const Pose& p : a)
		moved.push_back({bx + c * (p.x - ax) - s * (p.y - ay), by + s * (p.x - ax) + c * (p.y - ay), p.phi + turn});
	return moved;
}

void report(const std::vector<Pose>& estimate, const std::vector<Pose>& reference)
{
	const auto moved = aligned(estimate, reference);
	double sumSqr = 0, greatest = 0, yawSqr = 0;
	for (std::size_t i = 0; i < moved.size(); i++)
	{
		const double d = std::hypot(moved[i].x - reference[i].x, moved[i].y - reference[i].y);
		const double yaw = std::remainder(moved[i].phi - reference[i].phi, 6.283185307179586);
		sumSqr += d * d;
		yawSqr += yaw * yaw;
		greatest = std::max(greatest, d);
	}
	const double n = double(moved.size());
	std::printf("poses %zu  rms %.4f m  greatest %.4f m  rms yaw %.4f deg\n", moved.size(), std::sqrt(sumSqr / n),
				greatest, std::sqrt(yawSqr / n) * 57.29577951308232);
}
}  // namespace

int main(int argc, char** argv)
{
	try
	{
		if (argc != 3 && argc != 4) throw std::runtime_error("usage: path-error ESTIMATE REFERENCE [SKIP]");
		auto estimate = readPath(argv[1]), reference = readPath(argv[2]);
		const std::size_t skip = argc > 3 ? std::min<std::size_t>(std::stoul(argv[3]), reference.size()) : 0;
		reference.erase(reference.begin(), reference.begin() + std::ptrdiff_t(skip));
		if (estimate.size() < 3 || estimate.size() != reference.size())
			throw std::runtime_error("the paths hold " + std::to_string(estimate.size()) + " and " +
									 std::to_string(reference.size()) + " poses: equal numbers are needed");
		report(estimate, reference);
		return 0;
	}
	catch (const std::exception& e)
	{
		std::fprintf(stderr, "path-error: %s\n", e.what());
		return 1;
	}
}
