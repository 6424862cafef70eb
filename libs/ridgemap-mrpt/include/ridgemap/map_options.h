// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/config/CLoadableOptions.h>
#include <mrpt/img/TColor.h>
#include <ridgemap/options.h>

#include <string>
#include <vector>

namespace ridgemap
{
/** Section `_creationOpts`: the parameters of the algorithm. Fixed once a map holds measurements. */
struct TCreationOptions : public mrpt::config::CLoadableOptions, public Options
{
	TCreationOptions() = default;
	TCreationOptions(const Options& o) : Options(o) {}

	/** Loads the keys that are present. Throws std::exception naming the key, the value and what is allowed for values
	 * out of range, unknown words and unknown keys; the options are then as before. The same holds for the other
	 * sections. */
	void loadFromConfigFile(const mrpt::config::CConfigFileBase& source, const std::string& section) override;
	/** Writes all keys with comments. */
	void saveToConfigFile(mrpt::config::CConfigFileBase& target, const std::string& section) const override;
	void dumpToTextStream(std::ostream& out) const override;
};

/** Section `_insertOpts`: which points of an observation become measurements. */
struct TInsertionOptions : public mrpt::config::CLoadableOptions
{
	double minZ = 0.1;                ///< least height of points of 3-D sensors, map frame [m]
	double maxZ = 2.0;                ///< greatest height of points of 3-D sensors, map frame [m]
	double minRange = 0.05;           ///< least distance from the sensor [m]
	double maxRange = 80;             ///< greatest distance from the sensor [m]
	double minDistBetweenPoints = 0;  ///< a point nearer to the one before it is left out [m]; 0: all are kept
	double planarityTolerance = 5;    ///< greatest angle of the plane of a 2-D scan to the horizontal [deg]
	double freeRayRange = 0;  ///< beams of 2-D scans without return count as free up to this far [m]; 0: not at all
	unsigned keepScans = 0;   ///< observations to keep, older ones are taken out again; 0: all
	double keepSeconds = 0;   ///< age of observations to keep, by the newest one [s]; 0: any age

	/** Throws std::invalid_argument with name, value and range of the first field that is off. */
	void validate() const;
	void loadFromConfigFile(const mrpt::config::CConfigFileBase& source, const std::string& section) override;
	void saveToConfigFile(mrpt::config::CConfigFileBase& target, const std::string& section) const override;
	void dumpToTextStream(std::ostream& out) const override;
};

/** Which polylines the likelihood of a scan looks at. */
enum class LikelihoodTarget : std::uint8_t
{
	ridges = 0,  ///< the strict ridges (default)
	walls = 1    ///< the walls
};

/** Section `_likelihoodOpts`: beam-end mixture, log(zRand/zMax + zHit*hit) summed over the beams, with
 * hit = exp(-d^2/(2 sigmaHit^2)) of the distance d to the nearest polyline, or L/(L + lTol) of the continuous occupancy
 * L at the end of the beam. */
struct TLikelihoodOptions : public mrpt::config::CLoadableOptions
{
	double zHit = 0.95;                                  ///< weight of beams that end on a polyline
	double zRand = 0.05;                                 ///< weight of beams that end anywhere
	double zMax = 80;                                    ///< range over which the latter are spread [m]
	double sigmaHit = 0.2;                               ///< spread of beam ends about a polyline [m]
	double maxDistance = 0.3;                            ///< distances to polylines are capped at this [m]
	unsigned decimation = 10;                            ///< one of this number of beams is used
	LikelihoodTarget target = LikelihoodTarget::ridges;  ///< which polylines
	bool useOccupancy = false;                           ///< the continuous occupancy instead of the distance
	/** Beam ends are looked up in square cells with this edge [sigma], so distances are off by up to 0.71 of it; 0:
	 * exact, and several times slower. */
	double pitch = 0.25;
	/** Beams of 2-D scans without return count, too, by the first of this many metres: hit is then the least share of
	 * rays that passed, over the places on their way of which anything is known, and 1/2 for the part of the way of
	 * which nothing is; 0: not at all. Takes an evaluation of the density every 2 sigma. */
	double freeBeamRange = 0;

	/** Throws std::invalid_argument with name, value and range of the first field that is off. */
	void validate() const;
	void loadFromConfigFile(const mrpt::config::CConfigFileBase& source, const std::string& section) override;
	void saveToConfigFile(mrpt::config::CConfigFileBase& target, const std::string& section) const override;
	void dumpToTextStream(std::ostream& out) const override;
};

/** Section `_renderOpts`: what the 3-D scene shows. */
struct TRenderOptions : public mrpt::config::CLoadableOptions
{
	bool showWalls = true;                                       ///< draw the walls
	bool showRidges = false;                                     ///< draw the strict ridges
	bool showMeasurements = false;                               ///< draw the centroid of every lattice cell
	mrpt::img::TColor wallColor{0x10, 0x20, 0x60};               ///< colour of the walls
	mrpt::img::TColor ridgeColor{0xd0, 0x30, 0x10};              ///< colour of the ridges
	mrpt::img::TColor measurementColor{0x80, 0x80, 0x80, 0x80};  ///< colour of the measurements
	double lineWidth = 2;                                        ///< width of the lines [pixels]
	double pointSize = 1;                                        ///< size of the points [pixels]

	/** Throws std::invalid_argument with name, value and range of the first field that is off. */
	void validate() const;
	void loadFromConfigFile(const mrpt::config::CConfigFileBase& source, const std::string& section) override;
	void saveToConfigFile(mrpt::config::CConfigFileBase& target, const std::string& section) const override;
	void dumpToTextStream(std::ostream& out) const override;
};

/** How a scan is brought onto the map by determineMatching2D(). */
enum class MatchingMethod : std::uint8_t
{
	lines = 0,  ///< the alignment with the lines of the polylines is solved inside, and returned as pairs (default)
	feet = 1    ///< every point is paired with its foot on the nearest polyline
};

/** Section `_matchingOpts`: what a scan is matched with, and how. See point_to_line_matching.h for the formulas. */
struct TMatchingOptions : public mrpt::config::CLoadableOptions
{
	MatchingMethod method = MatchingMethod::lines;            ///< how
	LikelihoodTarget matchTarget = LikelihoodTarget::ridges;  ///< which polylines; walls are drawn for people
	bool matchSides = true;          ///< lines that are turned away from the robot are no targets
	double pointSpacing = 1;         ///< greatest distance of points along polylines [sigma]
	bool fallback = true;            ///< measurements without a polyline near are targets, too
	double fallbackDistance = 3;     ///< nearer to a polyline than this they are not [sigma]
	double maxGate = 2;              ///< no pair is farther apart, whatever the program allows [m]
	double robustShare = 0.33;       ///< scale of the robust weights, as a share of the distance the program allows
	double robustLeast = 0.03;       ///< least scale of the robust weights [m]
	unsigned solverIterations = 20;  ///< most steps of one solution
	double nearGate = 0.25;          ///< gate of the first start [m]
	double startShare = 0.85;        ///< no turned starts if a narrow and a wide gate agree with this share of points
	unsigned yawStarts = 3;          ///< further starts on each side, turned about the sensor; 0: none
	double yawStep = 8;              ///< turn from one start to the next [deg]
	double yawLeastGate = 1;         ///< further starts only while the program allows at least this distance [m]
	double yawMargin = 0.05;         ///< share of its score by which another start must win
	/** Scores of poses that are off the start by d are multiplied by (1 + (d/startSpread)^2)^(-startPower u^2), where u
	 * is the share of the scan that the map does not explain there [m] */
	double startSpread = 0.3;
	double startPower = 1;  ///< see startSpread; 0: the distance from the start does not matter
	/** If none of these fits: so many poses on each side, forwards and sideways and turned by half of yawStep, are
	 * looked at for better starts. For maps that hold all that can be seen: into what a map does not hold yet, odometry
	 * leads better. 0: none */
	unsigned shiftStarts = 0;
	double shiftStep = 0.2;  ///< distance from one of these to the next [m]
	double slideReach = 0;   ///< starts this far along where the scan says least, as in hallways; for the same maps [m]
	double slideMargin = 0.005;  ///< share of its score by which such a start must win
	bool yawFirstOnly = true;    ///< further starts only on the first call of an alignment

	/** Throws std::invalid_argument with name, value and range of the first field that is off. */
	void validate() const;
	void loadFromConfigFile(const mrpt::config::CConfigFileBase& source, const std::string& section) override;
	void saveToConfigFile(mrpt::config::CConfigFileBase& target, const std::string& section) const override;
	void dumpToTextStream(std::ostream& out) const override;
};

/** All options of a CRidgeMap2D: one INI section each, `<prefix>_creationOpts` and so on. */
struct MapOptions
{
	TCreationOptions creation;
	TInsertionOptions insertion;
	TLikelihoodOptions likelihood;
	TRenderOptions render;
	TMatchingOptions matching;

	/** Throws std::exception with name, value and range of the first field that is off. */
	void validate() const;

	/** Loads the five sections; missing sections and keys leave the present values. Throws as their own loaders do; all
	 * options are then as before. */
	void loadFromConfigFile(const mrpt::config::CConfigFileBase& source, const std::string& sectionPrefix);

	/** Writes the five sections with comments. */
	void saveToConfigFile(mrpt::config::CConfigFileBase& target, const std::string& sectionPrefix) const;

	/** The five sections as the text of a commented INI file. */
	std::string toIniText(const std::string& sectionPrefix) const;

	/** Sets one option by its key (case and underscores do not matter: `L_tol` is `lTol`). Throws std::invalid_argument
	 * naming what is allowed for wrong values, and the nearest keys for an unknown one; the options are then as before.
	 * How the options go together (eps with sigma, minZ with maxZ) is left to validate(), so that the order of several
	 * calls does not matter. */
	void setOption(const std::string& key, const std::string& value);

	/** The value of one option as text, exact. Throws as setOption(). */
	std::string getOption(const std::string& key) const;

	/** All keys in the order of the sections; no key occurs twice. */
	static std::vector<std::string> keys();
};

/** A complete commented INI file with the default options: `[<mapSection>]` with `ridgeMap_count = 1`, ready for MRPT
 * programs, and the sections `[<mapSection>_ridgeMap_00_creationOpts]` and so on. */
std::string defaultIniText(const std::string& mapSection = "map");

}  // namespace ridgemap
