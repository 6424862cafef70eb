// SPDX-License-Identifier: BSD-3-Clause
// Figs. 1 and 2: the method and its scene in pictures.
#include "../common/evaluation.h"
#include "experiments.h"
#include "made_up.h"
#include "raster.h"
#include "true_ridge.h"

namespace ridgemap::apps
{
namespace
{
constexpr double sigma = 0.1;

RidgeMap mapOf(const std::vector<Measurement>& measurements)
{
	Options options = paperOptions(sigma);
	RidgeMap map(options);
	map.insert(measurements);
	return map;
}

/** Occupancy as a shade: the root shows sparse places, too. */
void shadeOccupancy(Raster& raster, const RidgeMap& map, double full)
{
	raster.shade([&](const Point2& p) { return 0.85 * std::sqrt(map.occupancy(p).value / full); });
}

/** Dark where the ridge criterion is nearly met, the paler the fewer measurements there are: exp(-4 sigma R/L) times
 * L/full, at most 1. */
void shadeRidgeFunction(Raster& raster, const RidgeMap& map, double full)
{
	raster.shade(
		[&](const Point2& p)
		{
			const OccupancySample o = map.occupancy(p);
			if (o.value < 1e-6) return 0.0;
			const RidgeFunction r = ridgeFunction(o);
			return r.concave ? std::min(1.0, o.value / full) * std::exp(-4 * sigma * r.value / o.value) : 0.0;
		},
		false);
}

}  // namespace

Finding constructionFigure(const Setting& setting)
{
	const HallwayDrive drive = driveHallway(150, setting.seed);
	const RidgeMap map = mapOf(drive.all());
	const Box2 box{{9.2, 5.5}, {10.5, 6.8}};
	Raster occupancy(box, 900), function(box, 900), construction(box, 900);
	shadeOccupancy(occupancy, map, 140);
	occupancy.dots(pointsOf(drive.all()), colours::black, 2.5);
	shadeRidgeFunction(function, map, 40);
	shadeOccupancy(construction, map, 200);
	construction.segments(drive.truth, colours::truth, 3);
	std::size_t nodes = 0;
	for (const Polyline& p : map.ridges())
	{
		construction.line(p.points, colours::ridge, 4);
		construction.dots(p.points, colours::node, 10);
		nodes += p.points.size();
	}
	construction.scaleBar(sigma, "sigma = 0.1 m");
	writeRow(setting.path("fig1.png"),
			 {occupancy.titled("measurements and occupancy L"), function.titled("ridge function R: dark = 0"),
			  construction.titled("ridge: nodes and segments")},
			 2100);
	Finding f;
	f.id = "fig1";
	f.title = "Fig. 1: occupancy, ridge function, construction";
	f.pictures = {"fig1.png"};
	f.claim =
		"Surfaces are the ridges of the continuous occupancy: there the gradient has no part along the direction of "
		"strongest fall. A polyline is stepped along and relaxed onto them.";
	f.result = format(
		"The inner corner of the hallway, sigma %g m. The dark line of the ridge function (shown as exp(-4 sigma R/L), "
		"pale where L is small) "
		"and "
		"the polyline fall together: each node meets the criterion, each segment lies within eps = sigma/50. %zu nodes "
		"in "
		"the whole map.",
		sigma, nodes);
	return f;
}

Finding hallwayFigure(const Setting& setting)
{
	const HallwayDrive drive = driveHallway(150, setting.seed);
	const RidgeMap map = mapOf(drive.all());
	const Box2 all{{-0.7, -0.7}, {16.7, 16.7}}, zoom{{9.4, 5.7}, {10.3, 6.6}};
	Raster scene(all, 900), occupancy(all, 900), walls(all, 900), corner(zoom, 900);
	std::vector<Point2> path;
	for (const Pose& p : drive.poses) path.push_back({p.x, p.y});
	scene.segments(drive.truth, colours::truth, 2);
	scene.dots(pointsOf(drive.all()), colours::dots, 1.2);
	scene.line(path, colours::path, 3);
	scene.scaleBar(2, "2 m", false, false);
	shadeOccupancy(occupancy, map, 60);
	for (const Polyline& p : map.walls()) walls.line(p.points, colours::ridge, 3);
	walls.rectangle(zoom, colours::black);
	shadeOccupancy(corner, map, 300);
	corner.segments(drive.truth, colours::truth, 4);
	for (const Polyline& p : map.ridges())
	{
		corner.line(p.points, colours::ridge, 4);
		corner.dots(p.points, colours::ridge, 7);
	}
	corner.scaleBar(0.1, "0.1 m");
	writeRow(setting.path("fig2.png"),
			 {scene.titled("scene, path, measurements"), occupancy.titled("occupancy L"), walls.titled("map: walls"),
			  corner.titled("zoom: cut corner (ridges)")},
			 2400);
	Finding f;
	f.id = "fig2";
	f.title = "Fig. 2: the hallway";
	f.pictures = {"fig2.png"};
	const Evaluation e = evaluate(map.walls(), drive.truth, {sigma, 1, 0.35});
	const Evaluation strict = evaluate(map.ridges(), drive.truth, {sigma, 1, 0.35});
	f.claim =
		"A robot drives through a hallway 6 m wide with a corner of 90 degrees; the map follows its walls and cuts the "
		"corners.";
	f.result = format(
		"%zu measurements in %zu cycles give %.1f m of wall in %zu polylines: complete to %.2f %%, RMSD %.1f mm within "
		"1 m "
		"of the corners and %.1f mm elsewhere, spurious %.2f m. The strict ridges, which are the paper's map, have "
		"%.1f "
		"mm and %.1f mm.",
		drive.all().size(), drive.cycles.size(), e.all.length, map.walls().size(), 100 * e.completeness(),
		1e3 * e.corners.rmsd(), 1e3 * e.straight.rmsd(), e.spurious, 1e3 * strict.corners.rmsd(),
		1e3 * strict.straight.rmsd());
	f.verdict = e.completeness() > 0.98 ? Verdict::holds : Verdict::differs;
	return f;
}

}  // namespace ridgemap::apps
