// SPDX-License-Identifier: BSD-3-Clause
#include "scenes.h"

#include <cmath>
#include <cstdlib>

namespace ridgemap::test
{
namespace
{
constexpr double pi = 3.14159265358979323846;

Point2 along(Point2 from, double angle, double length)
{
	return {from.x + length * std::cos(angle), from.y + length * std::sin(angle)};
}
}  // namespace

void SceneBuilder::add(Point2 p)
{
	const double ex = random_.normal(), ey = random_.normal();
	points_.push_back({p.x + noise_ * ex, p.y + noise_ * ey});
}

SceneBuilder& SceneBuilder::wall(Point2 a, Point2 b)
{
	const auto n = std::size_t(std::ceil(std::hypot(b.x - a.x, b.y - a.y) * density_));
	for (std::size_t i = 0; i < n; i++)
	{
		const double t = random_.uniform();
		add({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
	}
	return *this;
}

SceneBuilder& SceneBuilder::arc(Point2 centre, double radius, double fromAngle, double toAngle)
{
	const auto n = std::size_t(std::ceil(radius * std::abs(toAngle - fromAngle) * density_));
	for (std::size_t i = 0; i < n; i++) add(along(centre, random_.uniform(fromAngle, toAngle), radius));
	return *this;
}

SceneBuilder& SceneBuilder::circle(Point2 centre, double radius)
{
	return arc(centre, radius, 0, 2 * pi);
}

SceneBuilder& SceneBuilder::outliers(std::size_t count, Point2 low, Point2 high)
{
	for (std::size_t i = 0; i < count; i++)
	{
		const double x = random_.uniform(low.x, high.x), y = random_.uniform(low.y, high.y);
		points_.push_back({x, y});
	}
	return *this;
}

std::vector<Measurement> SceneBuilder::finish(Point2 shift, double turn) const
{
	std::vector<Measurement> result;
	result.reserve(points_.size());
	const double c = std::cos(turn), s = std::sin(turn);
	for (const Point2& p : points_)
	{
		Measurement m;
		m.x = sigma_ * (c * p.x - s * p.y + shift.x);
		m.y = sigma_ * (s * p.x + c * p.y + shift.y);
		result.push_back(m);
	}
	return result;
}

RandomScene randomScene(std::uint64_t seed, int size)
{
	Random random(seed);
	RandomScene scene;
	scene.seed = seed;
	scene.sigma = 0.05 * std::pow(10, random.uniform(-1, 1));
	const double noise = random.uniform(0.3, 0.5), density = random.uniform(3, 12), extent = 14.0 * std::sqrt(size);
	SceneBuilder builder(random.bits(), scene.sigma, noise, density);
	for (int i = 0; i < size; i++)
	{
		const Point2 p{random.uniform(-extent, extent), random.uniform(-extent, extent)};
		const double angle = random.uniform(0, 2 * pi), length = random.uniform(20, 40), half = 0.5 * length;
		const double radius = random.uniform(4, 10);
		// Junctions meet at 50-130 degrees.
		const double other = angle + random.uniform(0.28, 0.72) * pi;
		switch (random.below(6))
		{
			case 0:
				builder.wall(p, along(p, angle, length));
				scene.what += "wall ";
				break;
			case 1:
				builder.wall(p, along(p, angle, half)).wall(p, along(p, other, half));
				scene.what += "corner ";
				break;
			case 2:
				builder.arc(p, radius, angle, angle + random.uniform(1, 5));
				scene.what += "arc ";
				break;
			case 3:
				builder.circle(p, radius);
				scene.what += "circle ";
				break;
			case 4:
				builder.wall(along(p, angle, -half), along(p, angle, half)).wall(p, along(p, other, half));
				scene.what += "T ";
				break;
			default:
				builder.wall(along(p, angle, -half), along(p, angle, half));
				builder.wall(along(p, other, -half), along(p, other, half));
				scene.what += "X ";
		}
	}
	const double border = extent + 10;
	if (random.chance(0.6))
	{
		const auto count = std::size_t(random.uniform(0.01, 0.15) * density * 35 * size);
		builder.outliers(count, {-border, -border}, {border, border});
		scene.what += "outliers";
	}
	scene.measurements =
		builder.finish({random.uniform(-1e3, 1e3), random.uniform(-1e3, 1e3)}, random.uniform(0, 2 * pi));
	return scene;
}

std::vector<Measurement> exactWall(Point2 a, Point2 b, double spacing)
{
	std::vector<Measurement> result;
	const double length = std::hypot(b.x - a.x, b.y - a.y);
	const int n = int(std::ceil(length / spacing));
	for (int i = 0; i <= n; i++)
	{
		Measurement m;
		m.x = a.x + (b.x - a.x) * i / n;
		m.y = a.y + (b.y - a.y) * i / n;
		result.push_back(m);
	}
	return result;
}

int fromEnvironment(const char* name, int byDefault)
{
	const char* text = std::getenv(name);
	const int value = text ? std::atoi(text) : 0;
	return value > 0 ? value : byDefault;
}

}  // namespace ridgemap::test
