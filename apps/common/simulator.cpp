// SPDX-License-Identifier: BSD-3-Clause
#include "simulator.h"

#include <algorithm>
#include <limits>

namespace ridgemap::apps
{
namespace
{
constexpr double pieceLength = 0.02;  // [m]
constexpr double pi = 3.14159265358979323846;

/** Range along a unit direction to a segment. */
double castAt(const Segment& s, const Point2& o, double dx, double dy)
{
	const double ex = s.b.x - s.a.x, ey = s.b.y - s.a.y;
	const double det = ex * dy - ey * dx;
	if (det == 0) return std::numeric_limits<double>::infinity();
	const double ax = s.a.x - o.x, ay = s.a.y - o.y;
	const double t = (ex * ay - ey * ax) / det, u = (dx * ay - dy * ax) / det;
	return t > 0 && u >= 0 && u <= 1 ? t : std::numeric_limits<double>::infinity();
}

/** Range along a unit direction to a disc. */
double castAt(const Point2& centre, double radius, const Point2& o, double dx, double dy)
{
	const double cx = centre.x - o.x, cy = centre.y - o.y;
	const double along = cx * dx + cy * dy, beside = cx * dy - cy * dx;
	if (std::abs(beside) > radius) return std::numeric_limits<double>::infinity();
	const double t = along - std::sqrt(radius * radius - beside * beside);
	return t > 0 ? t : std::numeric_limits<double>::infinity();
}

double wrapped(double angle)
{
	return angle - 2 * pi * std::floor((angle + pi) / (2 * pi));
}

}  // namespace

Simulator::Simulator(const Scene& scene, std::uint64_t seed) : scene_(scene), random_(seed)
{
	for (std::size_t i = 0; i < scene_.surfaces.size(); i++)
	{
		const Segment& s = scene_.surfaces[i].shape;
		const int n = std::max(1, int(std::ceil(s.length() / pieceLength)));
		for (int k = 0; k < n; k++)
			pieces_.push_back({i, double(k) / n, double(k + 1) / n, s.at((k + 0.5) / n), false});
	}
}

double Simulator::cast(const Point2& origin, double dx, double dy, double time) const
{
	double range = std::numeric_limits<double>::infinity();
	for (const Surface& s : scene_.surfaces)
		if (s.opaque() && s.when.at(time)) range = std::min(range, castAt(s.shape, origin, dx, dy));
	for (const Mover& m : scene_.movers)
		if (m.when.at(time)) range = std::min(range, castAt(m.at(time), m.radius, origin, dx, dy));
	return range;
}

std::vector<Simulator::Pane> Simulator::panes(const Point2& origin, double dx, double dy, double time,
											  double range) const
{
	std::vector<Pane> result;
	for (const Surface& s : scene_.surfaces)
	{
		if (s.opaque() || !s.when.at(time)) continue;
		const Pane pane{castAt(s.shape, origin, dx, dy), s.returnedAlong(dx, dy)};
		if (pane.range < range && pane.returned > 0) result.push_back(pane);
	}
	std::sort(result.begin(), result.end(), [](const Pane& a, const Pane& b) { return a.range < b.range; });
	return result;
}

double Simulator::echo(const Point2& origin, double dx, double dy, double time)
{
	const double range = cast(origin, dx, dy, time);
	for (const Pane& pane : panes(origin, dx, dy, time, range))
		if (random_.chance(pane.returned)) return pane.range;
	return range;
}

std::vector<Simulator::Piece*> Simulator::look(const Pose& pose, double range, double halfAngle)
{
	std::vector<Piece*> visible;
	for (Piece& p : pieces_)
	{
		const Surface& surface = scene_.surfaces[p.surface];
		const double dx = p.centre.x - pose.x, dy = p.centre.y - pose.y, r = std::hypot(dx, dy);
		if (!surface.when.at(pose.time)) continue;
		if (!(r > 0 && r <= range) || std::abs(wrapped(std::atan2(dy, dx) - pose.phi)) > halfAngle) continue;
		if (cast({pose.x, pose.y}, dx / r, dy / r, pose.time) < r - 1e-6) continue;
		if (!(surface.returnedAlong(dx / r, dy / r) > 0)) continue;
		p.seen = true;
		visible.push_back(&p);
	}
	return visible;
}

double Simulator::returnedFrom(const Piece& piece, const Pose& pose) const
{
	const double x = piece.centre.x - pose.x, y = piece.centre.y - pose.y, r = std::hypot(x, y);
	double share = scene_.surfaces[piece.surface].returnedAlong(x / r, y / r);
	for (const Pane& pane : panes({pose.x, pose.y}, x / r, y / r, pose.time, r - 1e-6)) share *= 1 - pane.returned;
	return share;
}

Measurement Simulator::sample(const PaperSensor& sensor, const Pose& pose, const Piece& piece)
{
	const Point2 p = scene_.surfaces[piece.surface].shape.at(random_.uniform(piece.from, piece.to));
	const double dx = p.x - pose.x, dy = p.y - pose.y, r = std::hypot(dx, dy);
	const double along = sensor.depth.at(r) * random_.normal() / r;
	const double across = sensor.transverse.at(r) * random_.normal() / r;
	return {p.x + along * dx - across * dy, p.y + along * dy + across * dx, pose.x, pose.y};
}

std::vector<Measurement> Simulator::measure(const PaperSensor& sensor, const Pose& pose)
{
	const std::vector<Piece*> visible = look(pose, sensor.view, 4);
	std::vector<double> sum;  // of the cross-sections up to each piece
	double total = 0;
	for (const Piece* p : visible)
	{
		const Segment& s = scene_.surfaces[p->surface].shape;
		const double dx = p->centre.x - pose.x, dy = p->centre.y - pose.y;
		const double turned = std::abs((s.b.x - s.a.x) * dy - (s.b.y - s.a.y) * dx) / std::hypot(dx, dy);
		sum.push_back(total += returnedFrom(*p, pose) * turned * (p->to - p->from));
	}
	std::vector<Measurement> result;
	const std::size_t count = total > 0 ? random_.poisson(sensor.rate) : 0;
	for (std::size_t i = 0; i < count; i++)
		if (random_.chance(sensor.outliers))
		{
			const double r = sensor.view * std::sqrt(random_.uniform()), angle = random_.uniform(0, 2 * pi);
			result.push_back({pose.x + r * std::cos(angle), pose.y + r * std::sin(angle), pose.x, pose.y});
		}
		else
		{
			const auto at = std::upper_bound(sum.begin(), sum.end() - 1, total * random_.uniform()) - sum.begin();
			result.push_back(sample(sensor, pose, *visible[std::size_t(at)]));
		}
	return result;
}

std::vector<double> Simulator::scan(const LidarSensor& sensor, const Pose& pose)
{
	look(pose, sensor.maxRange, 0.5 * sensor.fieldOfView);
	std::vector<double> ranges;
	for (int i = 0; i < sensor.beams; i++)
	{
		const double share = sensor.beams > 1 ? double(i) / (sensor.beams - 1) - 0.5 : 0;
		const double angle = pose.phi + share * sensor.fieldOfView;
		double r = echo({pose.x, pose.y}, std::cos(angle), std::sin(angle), pose.time);
		if (random_.chance(sensor.outliers))
			r = random_.uniform(0.1, sensor.maxRange);
		else if (r <= sensor.maxRange)
			r += sensor.range.at(r) * random_.normal();
		ranges.push_back(r > 0 && r <= sensor.maxRange ? r : 0);
	}
	return ranges;
}

std::vector<Segment> Simulator::truth() const
{
	std::vector<Segment> result;
	for (std::size_t i = 0; i < pieces_.size();)
	{
		const Piece& first = pieces_[i];
		std::size_t last = i;
		while (last + 1 < pieces_.size() && pieces_[last + 1].surface == first.surface &&
			   pieces_[last + 1].seen == first.seen)
			last++;
		const Surface& s = scene_.surfaces[first.surface];
		if (s.when.always()) result.push_back({s.shape.at(first.from), s.shape.at(pieces_[last].to), first.seen});
		i = last + 1;
	}
	return result;
}

std::vector<Pose> posesAlong(const std::vector<Point2>& path, double spacing, double speed)
{
	std::vector<Pose> poses;
	if (path.size() == 1) return {{path[0].x, path[0].y, 0, 0}};
	double before = 0, next = 0;  // arc lengths: start of the leg, next pose
	for (std::size_t i = 1; i < path.size(); i++)
	{
		const Segment leg{path[i - 1], path[i]};
		const double length = leg.length(), phi = std::atan2(leg.b.y - leg.a.y, leg.b.x - leg.a.x);
		for (; next <= before + length && length > 0; next = spacing * double(poses.size()))
		{
			const Point2 p = leg.at((next - before) / length);
			poses.push_back({p.x, p.y, phi, next / speed});
		}
		before += length;
	}
	return poses;
}

}  // namespace ridgemap::apps
