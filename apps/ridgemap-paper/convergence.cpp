// SPDX-License-Identifier: BSD-3-Clause
// Every trace ends for a documented reason.
#include <numeric>

#include "experiments.h"
#include "made_up.h"

namespace ridgemap::apps
{
namespace
{
/** Lets the measurements from a number on be seen from one place. */
void seeFrom(const Point2& sensor, std::vector<Measurement>& points, std::size_t from)
{
	for (std::size_t i = from; i < points.size(); i++)
	{
		points[i].sensorX = sensor.x;
		points[i].sensorY = sensor.y;
	}
}

/** Walls, arcs and outliers at random: many junctions, bends and ends. Lengths in metres, sigma 0.1 m.
 * @param seen whether the measurements of surfaces have a sensor position, one a surface */
std::vector<Measurement> randomScene(Random& random, bool seen)
{
	std::vector<Measurement> points;
	const double noise = random.uniform(0.01, 0.05);
	for (int i = 0; i < 8; i++)
	{
		const Point2 p{random.uniform(0, 12), random.uniform(0, 12)};
		const double angle = random.uniform(0, 2 * M_PI), length = random.uniform(1, 6);
		const double density = random.uniform(20, 300);
		Scene surface;
		if (random.chance(0.6))
			surface.addWall(p, {p.x + length * std::cos(angle), p.y + length * std::sin(angle)});
		else
		{
			const double radius = random.uniform(0.2, 2), turn = random.uniform(1, 6.2);
			surface.addArc(p, radius, angle, angle + turn);
		}
		const std::size_t before = points.size();
		for (const Surface& s : surface.surfaces) addWall(points, s.shape, density, noise, random);
		if (seen) seeFrom({random.uniform(0, 12), random.uniform(0, 12)}, points, before);
	}
	for (std::size_t n = random.below(2000); n > 0; n--)
	{
		Measurement m;
		m.x = random.uniform(-1, 13);
		m.y = random.uniform(-1, 13);
		points.push_back(m);
	}
	return points;
}

/** How traces ended in random scenes. */
struct Ends
{
	UpdateResult sum;
	std::size_t scenes = 0, unstitched = 0;
	double metres = 0;  ///< of ridge

	std::size_t operator[](StopReason r) const { return sum.stops[std::size_t(r)]; }
	std::size_t failed() const { return (*this)[StopReason::noConvergence] + (*this)[StopReason::workLimit]; }
};

Ends traceScenes(std::size_t traces, bool seen, std::uint64_t seed)
{
	Ends ends;
	Random random(seed);
	for (; ends.sum.traces < traces; ends.scenes++)
	{
		Options options;
		options.sigma = 0.1;
		RidgeMap map(options);
		map.insert(randomScene(random, seen));
		ends.sum += map.update();
		ends.unstitched += map.statistics().unstitchedCrossings;
		for (const Polyline& p : map.ridges()) ends.metres += p.length();
	}
	return ends;
}

}  // namespace

Finding convergence(const Setting& setting)
{
	Finding f;
	f.id = "convergence";
	f.title = "Convergence";
	f.claim = "The construction converges unconditionally.";
	const std::size_t wanted = setting.quick ? 30000 : 1000000;
	const Ends plain = traceScenes(wanted, false, setting.seed + 14);
	const Ends sided = traceScenes(wanted / 10, true, setting.seed + 15);
	f.table.columns = {"viewing sides", "traces", "ends"};
	for (std::size_t i = 0; i < plain.sum.stops.size(); i++) f.table.columns.push_back(toString(StopReason(i)));
	for (const Ends* e : {&plain, &sided})
	{
		const auto& stops = e->sum.stops;
		f.table.rows.push_back({double(e == &sided), double(e->sum.traces),
								double(std::accumulate(stops.begin(), stops.end(), std::size_t(0)))});
		for (const std::size_t n : stops) f.table.rows.back().push_back(double(n));
	}
	f.result = format(
		"%zu traces in %zu random scenes of walls, arcs and outliers (%.0f m of ridge). Not converged at the smallest "
		"step, or stopped by the bound on work: %zu. All others end where the occupancy falls below L_tol, where "
		"measurements end, where the ridge criterion fails (umbilic points, flat or repelling places), at another "
		"polyline or at the border of a tile, where the next tile goes on; %zu of them at a place of the border where "
		"the scan had missed the crossing, so that nothing goes on there. %zu crossings join nothing. With a density "
		"for every viewing side, which is not the paper's, and sensors anywhere, also behind what they see: %zu of "
		"%zu traces do not converge, %zu end at a missed crossing, and %zu crossings join nothing.",
		plain.sum.traces, plain.scenes, plain.metres, plain.failed(), plain[StopReason::unregisteredExit],
		plain.unstitched, sided.failed(), sided.sum.traces, sided[StopReason::unregisteredExit], sided.unstitched);
	f.verdict = plain.failed() == 0 ? Verdict::holds : Verdict::differs;
	return f;
}

}  // namespace ridgemap::apps
