// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/map_options.h>

#include <array>

namespace ridgemap
{
/** What is known about one option. The tables below are the only place that knows its key, unit, range and meaning;
 * loading, saving, setting, serializing and help are made from them. Defaults come from the structs. */
struct FieldInfo
{
	const char* key;                  ///< key in INI files, the name of the field
	const char* unit;                 ///< "" if it has none
	const char* text;                 ///< one line of help
	double lowest = 0, highest = -1;  ///< allowed range; none while lowest > highest

	bool hasRange() const { return lowest <= highest; }
};

/** The words for the values of an enumeration, in their order. */
template <class E>
struct Words;
template <>
struct Words<StepRule>
{
	static constexpr std::array<const char*, 2> names{"error", "paper"};
};
template <>
struct Words<SeedRule>
{
	static constexpr std::array<const char*, 2> names{"projection", "maximum"};
};
template <>
struct Words<LikelihoodTarget>
{
	static constexpr std::array<const char*, 2> names{"ridges", "walls"};
};
template <>
struct Words<MatchingMethod>
{
	static constexpr std::array<const char*, 2> names{"lines", "feet"};
};

/** Calls visit(info, field) for every field; `o` may be const. The ranges of the creation options are those that
 * Options::validate() enforces. */
template <class O, class V>
void visitFields(const TCreationOptions*, O& o, V&& visit)
{
	visit(FieldInfo{"sigma", "m", "smoothing parameter; 2.5-3 times the noise across the wall", 1e-3, 1e3}, o.sigma);
	visit(FieldInfo{"eps", "m",
					"bound on the distance of a ridge polyline to the true ridge, sigma/10000 to sigma/2; 0: sigma/50"},
		  o.eps);
	visit(FieldInfo{"lTol", "kernel peaks", "L_tol: least occupancy on a polyline", 0.1, 1e9}, o.lTol);
	visit(FieldInfo{"dTol", "sigma", "d_tol: longest stretch of ridge without a measurement", 0.5, 4}, o.dTol);
	visit(FieldInfo{"cell", "sigma", "edge of a lattice cell: 1, 0.5, 0.25 or 0.125; 0: every measurement kept apart"},
		  o.cell);
	visit(FieldInfo{"cutoff", "sigma", "kernels farther than this may be left out", 4, 8}, o.cutoff);
	visit(FieldInfo{"tileEdge", "sigma", "edge of a tile, the unit of update: a multiple of 4", 12, 64}, o.tileEdge);
	visit(FieldInfo{"maxStep", "sigma", "longest segment", 0.1, 4}, o.maxStep);
	visit(FieldInfo{"maxSensitivity", "", "ridges end where a relative error of the density would move them by more", 1,
					1e6},
		  o.maxSensitivity);
	visit(FieldInfo{"sides", "", "keep a density for every viewing side where the sensor position is known"}, o.sides);
	visit(FieldInfo{"stepRule", "", "step along a ridge: from the verified error, or as in the paper"}, o.stepRule);
	visit(FieldInfo{"seedRule", "", "initial guesses: projection onto the ridge, or local maxima as in the paper"},
		  o.seedRule);
	visit(FieldInfo{"minCurvature", "1/sigma^2", "walls: weaker stretches of ridge, -lambda1/L, are left out", 0, 1},
		  o.minCurvature);
	visit(FieldInfo{"prune", "", "walls: leave out short chains"}, o.prune);
	visit(FieldInfo{"pruneLength", "sigma", "walls: chains shorter than this are left out", 0, 100}, o.pruneLength);
	visit(FieldInfo{"attach", "", "walls: join free ends to the walls beside them"}, o.attach);
	visit(FieldInfo{"attachDistance", "sigma", "walls: farthest that a free end is joined", 0, 5}, o.attachDistance);
	visit(FieldInfo{"mergeDistance", "sigma",
					"walls: the two faces of a wall become one line where they are nearer than this; 0: never", 0, 1},
		  o.mergeDistance);
	visit(FieldInfo{"trim", "", "walls: move free ends back to where the surface ends"}, o.trim);
	visit(FieldInfo{"sharpen", "", "walls: put a vertex where the straight arms of a rounded corner meet"}, o.sharpen);
	visit(FieldInfo{"straighten", "", "walls: draw straight and circular stretches as fitted lines and arcs"},
		  o.straighten);
	visit(FieldInfo{"correctBends", "", "walls: move bent stretches out, as ridges lie inside of bends"},
		  o.correctBends);
	visit(FieldInfo{"freeSpace", "", "count the rays that pass; walls: leave out what they pass through"}, o.freeSpace);
	visit(FieldInfo{"freeSpaceTau", "", "walls: least share of hits in hits and passes; lower keeps more", 0, 1},
		  o.freeSpaceTau);
	visit(FieldInfo{"freeSpaceWindow", "sigma", "walls: hits and passes are summed this far to both sides", 0, 10},
		  o.freeSpaceWindow);
	visit(FieldInfo{"freeSpaceLeast", "", "walls: with fewer passes than this nothing is left out", 0, 1e6},
		  o.freeSpaceLeast);
	visit(FieldInfo{"freeSpaceMargin", "sigma", "rays are counted up to this far before their ends", 1, 20},
		  o.freeSpaceMargin);
}

template <class O, class V>
void visitFields(const TInsertionOptions*, O& o, V&& visit)
{
	visit(FieldInfo{"minZ", "m", "least height of points of 3-D sensors, map frame", -1e6, 1e6}, o.minZ);
	visit(FieldInfo{"maxZ", "m", "greatest height of points of 3-D sensors, map frame", -1e6, 1e6}, o.maxZ);
	visit(FieldInfo{"minRange", "m", "least distance from the sensor", 0, 1e6}, o.minRange);
	visit(FieldInfo{"maxRange", "m", "greatest distance from the sensor", 0, 1e6}, o.maxRange);
	visit(FieldInfo{"minDistBetweenPoints", "m", "a point nearer to the one before it is left out; 0: all are kept", 0,
					1e3},
		  o.minDistBetweenPoints);
	visit(FieldInfo{"planarityTolerance", "deg", "greatest angle of the plane of a 2-D scan to the horizontal", 0, 90},
		  o.planarityTolerance);
	visit(FieldInfo{"freeRayRange", "m",
					"beams of 2-D scans without return count as free up to this far; 0: not at all", 0, 1e6},
		  o.freeRayRange);
	visit(FieldInfo{"keepScans", "", "observations to keep, older ones are taken out again; 0: all", 0, 1e9},
		  o.keepScans);
	visit(FieldInfo{"keepSeconds", "s", "age of observations to keep, by the newest one; 0: any age", 0, 1e9},
		  o.keepSeconds);
}

template <class O, class V>
void visitFields(const TLikelihoodOptions*, O& o, V&& visit)
{
	visit(FieldInfo{"zHit", "", "weight of beams that end on a polyline", 0, 1e3}, o.zHit);
	visit(FieldInfo{"zRand", "", "weight of beams that end anywhere", 1e-9, 1e3}, o.zRand);
	visit(FieldInfo{"zMax", "m", "range over which the latter are spread", 1e-3, 1e6}, o.zMax);
	visit(FieldInfo{"sigmaHit", "m", "spread of beam ends about a polyline", 1e-4, 1e3}, o.sigmaHit);
	visit(FieldInfo{"maxDistance", "m", "distances to polylines are capped at this", 0, 1e3}, o.maxDistance);
	visit(FieldInfo{"decimation", "", "one of this number of beams is used", 1, 100000}, o.decimation);
	visit(FieldInfo{"target", "", "which polylines"}, o.target);
	visit(FieldInfo{"useOccupancy", "", "the continuous occupancy L at beam ends, L/(L + lTol), not their distance"},
		  o.useOccupancy);
	visit(FieldInfo{"pitch", "sigma", "beam ends are looked up in cells with this edge; 0: exact, and slower", 0, 100},
		  o.pitch);
	visit(FieldInfo{"freeBeamRange", "m",
					"beams of 2-D scans without return count by what rays passed this far; 0: not", 0, 1e6},
		  o.freeBeamRange);
}

template <class O, class V>
void visitFields(const TRenderOptions*, O& o, V&& visit)
{
	visit(FieldInfo{"showWalls", "", "draw the walls"}, o.showWalls);
	visit(FieldInfo{"showRidges", "", "draw the strict ridges"}, o.showRidges);
	visit(FieldInfo{"showMeasurements", "", "draw the centroid of every lattice cell"}, o.showMeasurements);
	visit(FieldInfo{"wallColor", "", "colour of the walls, RRGGBB or RRGGBBAA"}, o.wallColor);
	visit(FieldInfo{"ridgeColor", "", "colour of the ridges"}, o.ridgeColor);
	visit(FieldInfo{"measurementColor", "", "colour of the measurements"}, o.measurementColor);
	visit(FieldInfo{"lineWidth", "pixels", "width of the lines", 0.1, 100}, o.lineWidth);
	visit(FieldInfo{"pointSize", "pixels", "size of the points", 0.1, 100}, o.pointSize);
}

template <class O, class V>
void visitFields(const TMatchingOptions*, O& o, V&& visit)
{
	visit(FieldInfo{"method", "", "align with lines inside, or pair with feet"}, o.method);
	visit(FieldInfo{"matchTarget", "", "which polylines scans are matched with"}, o.matchTarget);
	visit(FieldInfo{"matchSides", "", "lines that are turned away from the robot are no targets"}, o.matchSides);
	visit(FieldInfo{"pointSpacing", "sigma", "greatest distance of points along polylines", 0.1, 100}, o.pointSpacing);
	visit(FieldInfo{"fallback", "", "measurements without a polyline near are targets, too"}, o.fallback);
	visit(FieldInfo{"fallbackDistance", "sigma", "nearer to a polyline than this they are not", 0, 100},
		  o.fallbackDistance);
	visit(FieldInfo{"maxGate", "m", "no pair is farther apart, whatever the program allows", 1e-3, 1e3}, o.maxGate);
	visit(FieldInfo{"robustShare", "", "scale of the robust weights, as a share of the distance the program allows",
					1e-3, 100},
		  o.robustShare);
	visit(FieldInfo{"robustLeast", "m", "least scale of the robust weights", 1e-4, 100}, o.robustLeast);
	visit(FieldInfo{"solverIterations", "", "most steps of one solution", 1, 1000}, o.solverIterations);
	visit(FieldInfo{"nearGate", "m", "the start given is first tried with this gate", 1e-3, 1e3}, o.nearGate);
	visit(FieldInfo{"startShare", "",
					"no turned starts if a narrow and a wide gate agree, and this share of the points fits", 0, 10},
		  o.startShare);
	visit(FieldInfo{"yawStarts", "", "further starts on each side, turned about the sensor; 0: none", 0, 90},
		  o.yawStarts);
	visit(FieldInfo{"yawStep", "deg", "turn from one start to the next", 0.1, 90}, o.yawStep);
	visit(FieldInfo{"yawLeastGate", "m", "further starts only while the program allows at least this distance", 0, 1e3},
		  o.yawLeastGate);
	visit(FieldInfo{"yawMargin", "", "share of its score by which another start must win", 0, 10}, o.yawMargin);
	visit(FieldInfo{"startSpread", "m",
					"starts are off by about this: where little of the scan fits, poses farther away count less", 1e-3,
					1e3},
		  o.startSpread);
	visit(FieldInfo{"startPower", "", "how much less; 0: the distance does not matter", 0, 10}, o.startPower);
	visit(FieldInfo{"shiftStarts", "",
					"poses on each side, forwards and sideways, to look at for starts; for finished maps; 0: none", 0,
					20},
		  o.shiftStarts);
	visit(FieldInfo{"shiftStep", "m", "distance from one of these to the next", 1e-3, 1e3}, o.shiftStep);
	visit(
		FieldInfo{"slideReach", "m",
				  "starts this far along where the scan says least, as in hallways; for finished maps; 0: none", 0, 10},
		o.slideReach);
	visit(FieldInfo{"slideMargin", "", "share of its score by which such a start must win", 0, 10}, o.slideMargin);
	visit(FieldInfo{"yawFirstOnly", "", "further starts only on the first call of an alignment"}, o.yawFirstOnly);
}

/** visitFields() for the table that belongs to the type of `o`. */
template <class O, class V>
void forEachField(O& o, V&& visit)
{
	visitFields(static_cast<const std::remove_const_t<O>*>(nullptr), o, visit);
}

/** Calls visit(suffix, section) for the five sections of `options` (const or not), with their INI suffixes. */
template <class M, class V>
void forEachSection(M& options, V&& visit)
{
	visit("creationOpts", options.creation);
	visit("insertOpts", options.insertion);
	visit("likelihoodOpts", options.likelihood);
	visit("renderOpts", options.render);
	visit("matchingOpts", options.matching);
}

}  // namespace ridgemap
