// SPDX-License-Identifier: BSD-3-Clause
#include "made_up.h"

#include <numeric>

namespace ridgemap::apps
{
Options paperOptions(double sigma)
{
	Options options;
	options.sigma = sigma;
	options.sides = false;
	return options;
}

void addWall(std::vector<Measurement>& points, const Segment& wall, double density, double noise, Random& random)
{
	for (std::size_t n = random.poisson(density * wall.length()); n > 0; n--)
	{
		const Point2 p = wall.at(random.uniform());
		const double ex = random.normal(), ey = random.normal();
		Measurement m;
		m.x = p.x + noise * ex;
		m.y = p.y + noise * ey;
		points.push_back(m);
	}
}

std::vector<Measurement> HallwayDrive::all() const
{
	std::vector<Measurement> result;
	for (const auto& c : cycles) result.insert(result.end(), c.begin(), c.end());
	return result;
}

HallwayDrive driveHallway(double rate, std::uint64_t seed, double spacing)
{
	HallwayDrive drive;
	drive.scene = hallwayScene();
	drive.poses = posesAlong(drive.scene.path, spacing, 1);
	Simulator simulator(drive.scene, seed);
	PaperSensor sensor;
	sensor.rate = rate;
	for (const Pose& pose : drive.poses) drive.cycles.push_back(simulator.measure(sensor, pose));
	drive.truth = simulator.truth();
	return drive;
}

std::vector<Point2> pointsOf(const std::vector<Measurement>& measurements)
{
	std::vector<Point2> points;
	for (const Measurement& m : measurements) points.push_back({m.x, m.y});
	return points;
}

std::vector<Polyline> clipped(const std::vector<Polyline>& polylines, const Box2& box)
{
	std::vector<Polyline> result;
	for (const Polyline& p : polylines)
	{
		bool open = false;
		for (std::size_t i = 0; i < p.points.size(); i++)
		{
			const Point2& q = p.points[i];
			const bool inside = q.x >= box.min.x && q.x <= box.max.x && q.y >= box.min.y && q.y <= box.max.y;
			if (inside && !open) result.emplace_back();
			if (inside)
			{
				result.back().points.push_back(q);
				result.back().info.push_back(p.info[i]);
			}
			open = inside;
		}
	}
	return result;
}

Mean meanOf(const std::vector<double>& values)
{
	const double n = double(values.size());
	if (values.empty()) return {};
	const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
	double squares = 0;
	for (const double v : values) squares += (v - mean) * (v - mean);
	return {mean, n > 1 ? std::sqrt(squares / (n * (n - 1))) : 0};
}

double quantile(std::vector<double> values, double share)
{
	if (values.empty()) return 0;
	const std::size_t k = std::min(values.size() - 1, std::size_t(share * double(values.size())));
	std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(k), values.end());
	return values[k];
}

LineFit fitLine(const std::vector<double>& x, const std::vector<double>& y)
{
	const double n = double(x.size()), mx = meanOf(x).value, my = meanOf(y).value;
	double sxx = 0, sxy = 0, rest = 0;
	for (std::size_t i = 0; i < x.size(); i++)
	{
		sxx += (x[i] - mx) * (x[i] - mx);
		sxy += (x[i] - mx) * (y[i] - my);
	}
	LineFit fit;
	fit.slope = sxy / sxx;
	fit.intercept = my - fit.slope * mx;
	for (std::size_t i = 0; i < x.size(); i++) rest += std::pow(y[i] - fit.intercept - fit.slope * x[i], 2);
	fit.slopeError = n > 2 ? std::sqrt(rest / (n - 2) / sxx) : 0;
	return fit;
}

}  // namespace ridgemap::apps
