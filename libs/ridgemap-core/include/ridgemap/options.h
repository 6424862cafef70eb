// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace ridgemap
{
/** How the step along a ridge is chosen (paper section V-B). */
enum class StepRule : std::uint8_t
{
	error = 0,  ///< from the verified distance between segment and ridge (default)
	paper = 1   ///< from the relaxation distance: above 0.75 sigma halve, below 0.25 sigma double
};

/** How a measurement that no polyline covers is brought to the ridge (paper section V-A). */
enum class SeedRule : std::uint8_t
{
	projection = 0,  ///< along the eigenvector v1, then Newton's method on the ridge function (default)
	maximum = 1      ///< two-dimensional trust-region Newton method to a local maximum of L
};

/** All parameters of a ridge map. Setting only `sigma` gives a good map.
 * Two maps can be merged, subtracted or compared only when all options are equal. */
struct Options
{
	double sigma = 0.05;   ///< smoothing parameter [m], 1e-3 .. 1e3; choose 2.5-3 times the noise across the wall
	double eps = 0;        ///< bound on the distance of every polyline point to the true ridge [m]; 0: sigma/50
	double lTol = 3;       ///< L_tol: least occupancy on a polyline [kernel peaks], > 0
	double dTol = 4;       ///< d_tol: longest stretch of ridge without a measurement [sigma], 0.5 .. 4
	double cell = 0.25;    ///< edge of a lattice cell [sigma]: 1, 1/2, 1/4 or 1/8; 0: every measurement kept apart
	double cutoff = 5;     ///< kernels farther than this may be left out [sigma], 4 .. 8
	double tileEdge = 16;  ///< edge of a tile, the unit of update [sigma]: a multiple of 4, 12 .. 64
	double maxStep = 2;    ///< longest segment [sigma], 0.1 .. 4
	/** Greatest factor by which a relative error of the density may move a ridge, in sigma, 1 .. 1e6. It grows without
	 * limit at umbilic points, where the place of a ridge is not determined; ridges end where it is exceeded. */
	double maxSensitivity = 50;
	/** Keep a density for every viewing side where the sensor position is known, so that the two faces of a thin wall
	 * stay apart; off: the density of the paper. Takes no effect with `cell` = 0. */
	bool sides = true;
	StepRule stepRule = StepRule::error;       ///< how the step along a ridge is chosen
	SeedRule seedRule = SeedRule::projection;  ///< how initial guesses are found

	double minCurvature =
		0.05;           ///< walls: weaker stretches of ridge, -lambda1/L, are left out [1/sigma^2], 0 .. 1; 0: none
	bool prune = true;  ///< walls: leave out short chains
	double pruneLength = 3;       ///< walls: chains shorter than this are left out [sigma], 0 .. 100
	bool attach = true;           ///< walls: join free ends to the walls beside them
	double attachDistance = 2.2;  ///< walls: farthest that a free end is joined [sigma], 0 .. 5

	/** walls: the two faces of a wall become one line where they are on average nearer than this [sigma], 0 .. 1;
	 * 0: never */
	double mergeDistance = 0.7;

	bool sharpen = true;  ///< walls: put a vertex where the straight arms of a rounded corner meet

	bool trim = true;  ///< walls: move free ends back to where the surface ends

	bool straighten = true;  ///< walls: draw straight and circular stretches as fitted lines and arcs

	bool correctBends =
		true;  ///< walls: move bent stretches out to where the surface is, as ridges lie inside of bends

	bool freeSpace = true;         ///< count the rays that pass; walls: leave out what they pass through
	double freeSpaceTau = 0.5;     ///< walls: least share of hits in hits and passes, 0 .. 1; lower keeps more
	double freeSpaceWindow = 1.5;  ///< walls: hits and passes are summed this far to both sides [sigma], 0 .. 10
	double freeSpaceLeast = 2;     ///< walls: with fewer passes than this nothing is left out, 0 .. 1e6
	double freeSpaceMargin = 2.5;  ///< rays are counted up to this far before their ends [sigma], 1 .. 20

	/** Throws std::invalid_argument with the name, the value and the allowed range of the first field that is off. */
	void validate() const;

	/** eps [m] with its default resolved. */
	double effectiveEps() const { return eps > 0 ? eps : sigma / 50; }

	bool operator==(const Options& o) const;
	bool operator!=(const Options& o) const { return !(*this == o); }
};

/** Largest absolute coordinate that a map takes [m]. */
constexpr double maxCoordinate = 1e6;
/** Largest number of measurements in one lattice cell. */
constexpr std::uint64_t maxCountPerCell = std::uint64_t(1) << 31;
/** Largest number of rays through one cell of the free-space counters. */
constexpr std::uint64_t maxPassesPerCell = std::uint64_t(1) << 48;
/** Rays longer than this are counted up to here only [sigma]. */
constexpr double maxRayLength = 1e5;

}  // namespace ridgemap
