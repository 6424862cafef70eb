// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace ridgemap
{
/** A point in the plane, map frame [m]. */
struct Point2
{
	double x = 0;
	double y = 0;

	friend bool operator==(const Point2& a, const Point2& b) { return a.x == b.x && a.y == b.y; }
	friend bool operator!=(const Point2& a, const Point2& b) { return !(a == b); }
};

/** One measured surface point (mu_i, paper section III) and, where it is known, the sensor that saw it.
 * The sensor position is not used by the density; it tells which way the ray took, which was free (Options::freeSpace).
 * Without it, or with the sensor at the measured point, the measurement casts no ray. */
struct Measurement
{
	double x = 0;                                               ///< measured point, map frame [m]
	double y = 0;                                               ///< measured point, map frame [m]
	double sensorX = std::numeric_limits<double>::quiet_NaN();  ///< sensor position, map frame [m]; NaN: unknown
	double sensorY = std::numeric_limits<double>::quiet_NaN();  ///< sensor position, map frame [m]; NaN: unknown
};

/** A ray that met nothing: free from the sensor to a point, map frame [m]. */
struct FreeRay
{
	double sensorX = 0, sensorY = 0;  ///< where it starts
	double x = 0, y = 0;              ///< how far it is known to be free
};

/** Axis-aligned box in the map frame [m]; empty while min > max. */
struct Box2
{
	Point2 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
	Point2 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

	bool empty() const { return !(min.x <= max.x && min.y <= max.y); }
	void extend(const Point2& p);
	void extend(const Box2& b);
};

/** Why a ridge trace, and so a polyline, ends where it ends (paper section V-C; borders: doc/algorithm.md). */
enum class StopReason : std::uint8_t
{
	crossing = 0,      ///< reached a registered crossing of the tile border; the polyline goes on in the next tile
	closedLoop,        ///< came back to its own start
	belowThreshold,    ///< the continuous occupancy fell below L_tol
	noMeasurement,     ///< no projected measurement within d_tol
	notARidge,         ///< the ridge criterion (5)-(8) fails: umbilic point, flat or repulsive direction
	hitPolyline,       ///< ran into a polyline that already stands
	unregisteredExit,  ///< left its tile where the border has no crossing
	noConvergence,     ///< the relaxation did not converge at the smallest step
	workLimit,         ///< the bound on nodes per trace was reached
	passedThrough,     ///< walls: rays passed through what follows
	count_             ///< number of reasons, not a reason
};

/** Short name of a reason, for reports. */
const char* toString(StopReason reason);

/** What a vertex of a wall was made by. */
enum class VertexOrigin : std::uint8_t
{
	ridge = 0,  ///< lies on the ridge, but for the curvature correction where that is on
	corner,     ///< where two parts of a wall meet beyond the bend of the ridge
	end,        ///< a free end, moved to where the surface ends
	junction,   ///< led to another wall
	run         ///< on a fitted line or arc
};

/** Shape of a stretch of wall. */
enum class WallShape : std::uint8_t
{
	curve = 0,  ///< as the ridge runs
	line,       ///< one straight segment, fitted to the whole stretch
	arc         ///< segments along one circular arc, fitted to the whole stretch
};

/** What is known at a vertex of a polyline. */
struct VertexInfo
{
	float occupancy = 0;  ///< L [kernels]; 0: the vertex was added by a wall pass and lies on no ridge
	float curvature = 0;  ///< -lambda1/L times sigma^2: 1/(1 + (s/sigma)^2) on a straight wall with noise s across it
	/** How far chance may have moved the vertex across the wall, one standard deviation [m]; infinite where that cannot
	 * be told. On ridges see ridgeUncertainty() for what it means and for intervals. On fitted lines and arcs it is
	 * that of the fit, at a corner the larger one of both sides. */
	float standardError = std::numeric_limits<float>::infinity();
	VertexOrigin origin = VertexOrigin::ridge;  ///< walls: what made the vertex
	WallShape shape = WallShape::curve;         ///< walls: of the segment from this vertex to the next

	friend bool operator==(const VertexInfo& a, const VertexInfo& b)
	{
		return a.occupancy == b.occupancy && a.curvature == b.curvature && a.standardError == b.standardError &&
			   a.origin == b.origin && a.shape == b.shape;
	}
};

/** A polyline of the map: consecutive points are joined by straight segments. */
struct Polyline
{
	std::vector<Point2> points;    ///< at least 2; a closed polyline repeats its first point at the end
	std::vector<VertexInfo> info;  ///< one for every point
	bool closed = false;
	/** From which side it was seen: +1 from the left of its direction, -1 from the right; 0: not known, or from both.
	 */
	int side = 0;
	StopReason startReason = StopReason::belowThreshold;  ///< why it ends at points.front()
	StopReason endReason = StopReason::belowThreshold;    ///< why it ends at points.back()
	/** Walls: standard deviation s of the measurements across the wall, estimated from the density [m]; 0: not told. */
	double noise = 0;
	/** Walls: the vertices agree on `noise`; else it is a guess, as on short walls and where surfaces run together. */
	bool noiseSupported = false;

	/** Sum of the segment lengths [m]. */
	double length() const;
};

/** Value and derivatives of the continuous occupancy at a point, in *kernels*: the paper's L times 2 pi sigma^2, so
 * that one isolated measurement has value 1 at its own place. Derivatives are per metre. */
struct OccupancySample
{
	double value = 0;                               ///< L, equation (2) [kernels]
	double gx = 0, gy = 0;                          ///< gradient, equation (3) [kernels/m]
	double hxx = 0, hxy = 0, hyy = 0;               ///< Hessian, equation (4) [kernels/m^2]
	double txxx = 0, txxy = 0, txyy = 0, tyyy = 0;  ///< third derivatives [kernels/m^3]
};

}  // namespace ridgemap
