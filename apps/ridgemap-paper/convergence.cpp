// SPDX-License-Identifier: BSD-3-Clause
// Every trace ends for a documented reason.
#include <numeric>

#include "experiments.h"
#include "made_up.h"

namespace ridgemap::apps
{
namespace
{
/** Walls, arcs and outliers at random: many junctions, bends and ends. Lengths in metres, sigma 0.1 m. */
std::vector<Measurement> randomScene(Random& random)
{
	std::vector<Measurement> points;
	const double noise = random.uniform(0.01, 0.05);
	for (int i = 0; i < 8; i++)
	{
		const Point2 p{random.uniform(0, 12), random.uniform(0, 12)};
		const double angle = random.uniform(0, 2 * M_PI), length = random.uniform(1, 6);
		const double density = random.uniform(20, 300);
		if (random.chance(0.6))
		{
			addWall(points, {p, {p.x + length * std::cos(angle), p.y + length * std::sin(angle)}}, density, noise,
					random);
			continue;
		}
		Scene arc;
		const double radius = random.uniform(0.2, 2), turn = random.uniform(1, 6.2);
		arc.addArc(p, radius, angle, angle + turn);
		for (const Segment& s : arc.surfaces) addWall(points, s, density, noise, random);
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
}  // namespace

Finding convergence(const Setting& setting)
{
	Finding f;
	f.id = "convergence";
	f.title = "Convergence";
	f.claim = "The construction converges unconditionally.";
	const std::size_t wanted = setting.quick ? 30000 : 1000000;
	std::array<std::size_t, std::size_t(StopReason::count_)> stops{};
	std::size_t ends = 0, scenes = 0, metres = 0;
	Random random(setting.seed + 14);
	for (; ends < wanted; scenes++)
	{
		Options options;
		options.sigma = 0.1;
		RidgeMap map(options);
		map.insert(randomScene(random));
		const UpdateResult u = map.update();
		for (std::size_t i = 0; i < stops.size(); i++) stops[i] += u.stops[i];
		ends = std::accumulate(stops.begin(), stops.end(), std::size_t(0));
		for (const Polyline& p : map.ridges()) metres += std::size_t(p.length());
	}
	f.result = format("%zu ends of traces in %zu random scenes of walls, arcs and outliers (%zu m of ridge): ", ends,
					  scenes, metres);
	for (std::size_t i = 0; i < stops.size(); i++)
		f.result += format("%s%zu %s", i > 0 ? ", " : "", stops[i], toString(StopReason(i)));
	const std::size_t failed =
		stops[std::size_t(StopReason::noConvergence)] + stops[std::size_t(StopReason::workLimit)];
	f.result += format(". Not converged, or stopped by the bound on work: %zu, %.2g per million.", failed,
					   1e6 * double(failed) / double(ends));
	f.verdict = failed == 0 ? Verdict::holds : Verdict::differs;
	return f;
}

}  // namespace ridgemap::apps
