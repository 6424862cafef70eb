// SPDX-License-Identifier: BSD-3-Clause
#include "html_notes.h"

#include <ostream>

namespace ridgemap::apps
{
namespace
{
void writeNote(std::ostream& out, const std::string& subject, const std::string& text)
{
	out << "<li><b>" << subject << ".</b> " << text << "</li>\n";
}

void writeLocalizationNote(std::ostream& out, const Report& r)
{
	const FilterSettings s;
	out << "<li><b>Localisation.</b> MRPT's CMonteCarloLocalization2D follows "
		<< (r.secondPass.empty()
				? "the scans held out, in their order, in the map of the other scans (the first of the "
				  "maps of the line above); a second pass of its own can be given by --second-pass"
				: "the scans of the second pass in the map of all scans")
		<< ". The same for all maps: " << s.particles << " particles, standard proposal, systematic resampling, "
		<< s.runs << " runs with the same random numbers, odometry that is the recorded motion with noise, " << s.beams
		<< " beams of every scan, and a likelihood of hits with a spread of " << s.spread << " m up to " << s.farthest
		<< " m. (MRPT's points map takes the mean over the beams where the others take the sum; its variance was "
		   "divided by the number of beams.) Errors are those of the mean of the particles against the recorded poses, "
		   "without the first "
		<< s.settling << " scans; they cannot be better than those poses.</li>\n";
}
}  // namespace

void writeNotes(std::ostream& out, const Report& r)
{
	out << "<h2>How to read this</h2>\n<ul>\n";
	writeNote(out, "Same data",
			  "All maps took in the same scans at the same poses, one after the other, in one thread. No map corrects "
			  "the poses. The grids have their full size from the start, so that they never grow.");
	if (r.fromClouds > 0)
		writeNote(
			out, "Points made scans",
			std::to_string(r.fromClouds) +
				" observations are no scans, and a grid takes nothing else: their points were put onto the nearest "
				"of 7200 beams for all maps. Nothing was measured between the beams, so the "
				"grids do not take it for free; the points map keeps all points.");
	out << "<li><b>Turned.</b> All poses were turned by " << r.rotation
		<< " degrees: walls along the axes of a grid are its easiest or its worst case, depending on where the cell "
		   "borders happen to fall.</li>\n";
	if (r.fromClouds == 0)
		writeNote(
			out, "MRPT's beam angles",
			"MRPT's grid spreads the N beams of a scan over the aperture in steps of aperture/N; its other maps, and "
			"scanners, use aperture/(N-1). The grids without a remark were given scans turned and widened so that "
			"their beams lie where they were measured; the others show MRPT as it is.");
	writeNote(out, "Surface",
			  "That of a grid is the centres of all cells below 0.35 (probability of being free), that of the points "
			  "map its points, that of the ridge map its walls. A cell or point beside a wall counts as an error "
			  "although it is where a measurement was: this is what a user of the surface gets.");
	if (!r.truth.empty())
		writeNote(out, "Complete",
				  "Share of the true surface within 3 cm of the map. Of the truth counts what has the end of a beam "
				  "within 5 cm.");
	if (r.folds > 0)
		writeNote(
			out, "Scans held out",
			std::to_string(r.folds) + " maps of each kind were built, each without one scan in " +
				std::to_string(r.folds) +
				". This favours maps that keep many scattered points, for the nearest of many noisy points is near "
				"by chance: the distance to the true wall would have the noise of the sensor, not zero. So a "
				"smaller figure is not always a better map.");
	if (r.localizes()) writeLocalizationNote(out, r);
	writeNote(out, "Memory",
			  "That of the map alone: cells, or points, or measurements with polylines. Below it, all that the program "
			  "has on the heap after building and querying, with trees and the likelihood cache of the grid. "
			  "Serialized is MRPT's archive; gz is the same compressed by zlib. The ridge map stores its measurements; "
			  "reduced for localisation, it is frozen: its polylines with the fewest vertices that stay within 5 mm.");
	writeNote(
		out, "Likelihood and matching",
		"All beams, 4 cm beside the recorded pose; the points of the scan were made beforehand, where MRPT's maps look "
		"for them. The very first query builds trees. Cold: the first query at "
		"each of up to 200 further places, where the cache of the grid is empty; warm: the same query again. A "
		"particle filter is between the two.");
	writeNote(
		out, "Insertion",
		"With all that makes the scan visible to queries. That of the ridge map depends on how much surface is in "
		"view; that of a grid on the length of the rays in cells.");
	writeNote(out, "Times",
			  "Of the processor of one computer, all threads of the program added; what else runs there disturbs "
			  "caches. Sizes "
			  "and errors are the same everywhere.");
	writeNote(
		out, "Choose a grid where",
		"free space must be known finely from unknown space (planning of paths), or a scan must be taken in as fast "
		"as possible. The ridge map counts the rays that passed in cells of 2 sigma: enough to leave out of the "
		"walls what has gone away, and to tell free from unknown coarsely.");
	out << "</ul>\n";
}

}  // namespace ridgemap::apps
