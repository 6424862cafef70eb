// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "tile.h"

namespace ridgemap
{
/** The closed border of one tile in its own frame, with the crossings on it and which of them a piece has reached. */
class TileBorder
{
 public:
	struct Port
	{
		Crossing crossing;  ///< frame of this tile
		int side = 0, index = 0;
		Vec2 inward;  ///< unit tangent of the ridge, into the tile
		bool consumed = false;
	};

	/** Where a segment leaves the tile. */
	struct Exit
	{
		int side = 0;
		double s = 0;  ///< arc length along that side's border
		Vec2 p;
	};

	TileBorder(const TileStore& store, TileKey key);

	/** All crossings in canonical order: bottom, left, top, right, each by arc length. */
	std::vector<Port>& ports() { return ports_; }

	bool contains(Vec2 p) const;
	/** First place where the segment from a (inside or on the border) to b (outside) meets the border. */
	std::optional<Exit> exit(Vec2 a, Vec2 b) const;
	/** The free crossing nearest to an exit, within `tolerance` of it, along `direction` and not on the other side than
	 * `side`, or nullptr. */
	Port* match(const Exit& exit, Vec2 direction, Vec2 side, double tolerance);

 private:
	struct Wall
	{
		Vec2 a, b;
		int side;
		double s0;      ///< arc length of the side at a
		bool reversed;  ///< the side's arc length falls from a to b
	};
	void addSide(const Edge* edge, int side, Vec2 shift, bool reversed, Vec2 defaultFrom, Vec2 defaultTo);

	double edge_;
	std::vector<Wall> walls_;  ///< counter-clockwise
	std::vector<Port> ports_;
};

}  // namespace ridgemap
