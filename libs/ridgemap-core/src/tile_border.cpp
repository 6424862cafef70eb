// SPDX-License-Identifier: BSD-3-Clause
#include "tile_border.h"

#include <algorithm>
#include <cmath>

namespace ridgemap
{
namespace
{
/** Farthest that a detour takes a border away from its nominal line [sigma]. */
constexpr double largestDetour = 2.6;
}  // namespace

TileBorder::TileBorder(const TileStore& store, TileKey key) : edge_(store.tileEdge())
{
	const Tile* here = store.find(key);
	const Tile* right = store.find({key.x + 1, key.y});
	const Tile* above = store.find({key.x, key.y + 1});
	const Tile* diagonal = store.find({key.x + 1, key.y + 1});
	const auto corner = [](const Tile* t) { return t ? t->corner : Vec2{}; };
	const Vec2 sw = corner(here), se = Vec2{edge_, 0} + corner(right), nw = Vec2{0, edge_} + corner(above),
			   ne = Vec2{edge_, edge_} + corner(diagonal);
	walls_.reserve(4);
	addSide(here ? &here->bottom : nullptr, bottomSide, {0, 0}, false, sw, se);
	addSide(right ? &right->left : nullptr, rightSide, {edge_, 0}, false, se, ne);
	addSide(above ? &above->bottom : nullptr, topSide, {0, edge_}, true, nw, ne);
	addSide(here ? &here->left : nullptr, leftSide, {0, 0}, true, sw, nw);
	std::sort(ports_.begin(), ports_.end(),
			  [](const Port& a, const Port& b) { return a.side != b.side ? a.side < b.side : a.index < b.index; });
}

void TileBorder::addSide(const Edge* edge, int side, Vec2 shift, bool reversed, Vec2 defaultFrom, Vec2 defaultTo)
{
	const std::size_t first = walls_.size();
	const auto addWall = [&](Vec2 from, Vec2 to, double s) { walls_.push_back({from, to, side, s, false}); };
	if (edge && edge->path.size() >= 2)
	{
		double s = 0;
		for (std::size_t i = 1; i < edge->path.size(); i++)
		{
			addWall(edge->path[i - 1] + shift, edge->path[i] + shift, s);
			s += norm(edge->path[i] - edge->path[i - 1]);
		}
	}
	else
		addWall(defaultFrom, defaultTo, 0);
	if (reversed)
	{
		for (std::size_t i = first; i < walls_.size(); i++)
		{
			Wall& w = walls_[i];
			w = {w.b, w.a, side, w.s0 + norm(w.b - w.a), true};
		}
		std::reverse(walls_.begin() + std::ptrdiff_t(first), walls_.end());
	}
	if (!edge) return;
	for (std::size_t k = 0; k < edge->crossings.size(); k++)
	{
		Port port;
		port.crossing = edge->crossings[k];
		port.crossing.p = port.crossing.p + shift;
		port.side = side;
		port.index = int(k);
		port.inward = port.crossing.tangent;
		for (std::size_t i = first; i < walls_.size(); i++)
		{
			const Wall& w = walls_[i];
			const double d = (port.crossing.s - w.s0) * (reversed ? -1 : 1);
			if (d < -1e-9 || d > norm(w.b - w.a) + 1e-9) continue;
			// The tile lies to the left of its counter-clockwise border.
			if (cross(w.b - w.a, port.inward) < 0) port.inward = -port.inward;
			break;
		}
		ports_.push_back(port);
	}
}

bool TileBorder::contains(Vec2 p) const
{
	const double m = largestDetour;
	if (p.x > m && p.y > m && p.x < edge_ - m && p.y < edge_ - m) return true;
	if (p.x < -m || p.y < -m || p.x > edge_ + m || p.y > edge_ + m) return false;
	bool inside = false;
	for (const Wall& w : walls_)
	{
		if ((w.a.y > p.y) == (w.b.y > p.y)) continue;
		const double x = w.a.x + (p.y - w.a.y) / (w.b.y - w.a.y) * (w.b.x - w.a.x);
		if (p.x < x) inside = !inside;
	}
	return inside;
}

std::optional<TileBorder::Exit> TileBorder::exit(Vec2 a, Vec2 b) const
{
	const Vec2 d = b - a;
	std::optional<Exit> best;
	double bestU = 2;
	for (const Wall& w : walls_)
	{
		const Vec2 e = w.b - w.a;
		const double den = cross(d, e);
		if (!(den > 0)) continue;  // the segment leaves only through walls that it crosses from their left
		const double u = cross(w.a - a, e) / den, t = cross(w.a - a, d) / den;
		if (u < -1e-9 || u > 1 || t < -1e-9 || t > 1 + 1e-9 || u >= bestU) continue;
		bestU = u;
		const double along = t * norm(e);
		best = Exit{w.side, w.reversed ? w.s0 - along : w.s0 + along, a + u * d};
	}
	return best;
}

TileBorder::Port* TileBorder::match(const Exit& exit, Vec2 direction, Vec2 side, double tolerance)
{
	Port* best = nullptr;
	for (Port& port : ports_)
	{
		if (port.side != exit.side || port.consumed || dot(port.inward, direction) > -0.3) continue;
		if (dot(port.crossing.normal, side) < 0) continue;
		const double d = norm(port.crossing.p - exit.p);
		if (d > tolerance) continue;
		tolerance = d;
		best = &port;
	}
	return best;
}

}  // namespace ridgemap
