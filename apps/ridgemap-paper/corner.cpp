// SPDX-License-Identifier: BSD-3-Clause
// Figs. 4 and 5: the ridge cuts corners.
#include "../common/evaluation.h"
#include "chart.h"
#include "expected_corner.h"
#include "experiments.h"
#include "made_up.h"
#include "raster.h"

namespace ridgemap::apps
{
namespace
{
constexpr double noise = 0.033, arm = 3;  // [m]
const std::vector<Segment> truth{{{0, 0}, {arm, 0}}, {{0, 0}, {0, arm}}};

std::vector<Measurement> measureCorner(double density, std::uint64_t seed)
{
	Random random(seed);
	std::vector<Measurement> points;
	for (const Segment& s : truth) addWall(points, s, density, noise, random);
	return points;
}

RidgeMap cornerMap(double sigma, const std::vector<Measurement>& points)
{
	Options options = paperOptions(sigma);
	options.eps = sigma / 500;
	RidgeMap map(options);
	map.insert(points);
	return map;
}

/** The ridges without the short ones that a few stray measurements make beside a dense wall. */
std::vector<Polyline> longRidges(const RidgeMap& map)
{
	std::vector<Polyline> result;
	for (const Polyline& p : map.ridges())
		if (p.length() > 10 * map.options().sigma) result.push_back(p);
	return result;
}

/** RMSD [mm] of what is nearer to the corner than the radius [m]. */
double errorNearCorner(const std::vector<Polyline>& polylines, double radius = 1)
{
	EvaluationSettings settings;
	settings.cornerRadius = radius;
	return 1e3 * evaluate(polylines, truth, settings).corners.rmsd();
}

/** Distance of the corner to the map. */
double apexGap(const std::vector<Polyline>& polylines)
{
	double gap = 1e9;
	for (const Polyline& p : polylines)
		for (std::size_t i = 1; i < p.points.size(); i++)
			gap = std::min(gap, Segment{p.points[i - 1], p.points[i]}.distance({0, 0}));
	return 1e3 * gap;
}

/** Appends a length to a list in words. */
void append(std::string& list, int digits, double value)
{
	list += format("%s%.*f mm", list.empty() ? "" : ", ", digits, value);
}

cv::Mat cornerPicture(double density, std::uint64_t seed)
{
	const std::vector<Measurement> points = measureCorner(density, seed);
	const RidgeMap map = cornerMap(0.1, points);
	Raster raster({{-0.3, -0.3}, {0.9, 0.9}}, 1000);
	double highest = 0;
	for (double x = 0; x < 1; x += 0.02) highest = std::max(highest, map.occupancy({x, 0}).value);
	raster.shade([&](const Point2& p) { return 0.7 * map.occupancy(p).value / highest; });
	raster.dots(pointsOf(points), colours::dots, density > 300 ? 1.5 : 4);
	raster.segments(truth, colours::truth, 4);
	for (const Polyline& p : map.ridges())
	{
		raster.line(p.points, colours::ridge, 4);
		raster.dots(p.points, colours::ridge, 6);
	}
	raster.scaleBar(0.1, "0.1 m", true, false);
	return raster.titled(format("%.0f measurements per metre", density));
}

}  // namespace

Finding cornerError(const Setting& setting)
{
	const std::vector<double> sigmas{0.05, 0.1, 0.2}, densities{50, 100, 200, 500, 1000, 2000, 5000};
	const int sets = setting.repeat(40, 4);
	Finding f;
	f.id = "fig4";
	f.title = "Fig. 4: a corner";
	f.table.columns = {
		"sigma m",  "measurements per m",      "long ridges mm", "standard error mm", "infinite density mm",
		"walls mm", "walls standard error mm", "all ridges mm",  "apex gap mm",       "predicted mm"};
	std::string at1000, wallsAt1000, limits, nearLimits;
	double worst = 0;
	for (const double sigma : sigmas)
	{
		const std::vector<Polyline> expected{expectedCornerRidge(sigma, noise, arm, 1.5)};
		const double limit = errorNearCorner(expected);
		append(limits, 2, limit);
		append(nearLimits, 1, errorNearCorner(expected, 0.78));
		for (const double density : densities)
		{
			std::vector<double> ridges, all, walls, gaps;
			for (int i = 0; i < sets; i++)
			{
				const RidgeMap map = cornerMap(sigma, measureCorner(density, setting.seed * 7919 + std::uint64_t(i)));
				const std::vector<Polyline> main = longRidges(map);
				ridges.push_back(errorNearCorner(main));
				all.push_back(errorNearCorner(map.ridges()));
				walls.push_back(errorNearCorner(map.walls()));
				gaps.push_back(apexGap(main));
			}
			const double predicted = 1e3 * 0.72 * std::hypot(sigma, noise);
			const Mean r = meanOf(ridges), w = meanOf(walls), g = meanOf(gaps);
			f.table.rows.push_back(
				{sigma, density, r.value, r.error, limit, w.value, w.error, meanOf(all).value, g.value, predicted});
			if (density == densities.back()) worst = std::max(worst, std::abs(g.value / predicted - 1));
			if (density == 1000)
			{
				append(at1000, 1, r.value);
				append(wallsAt1000, 1, w.value);
			}
		}
	}
	writeCsv(setting.path("fig4.csv"), f.table);
	std::string plot;
	const char* colour[] = {"#1f4e9c", "#2e7d32", "#c62828"};
	for (std::size_t i = 0; i < sigmas.size(); i++)
		plot += format(
			"%s'fig4.csv' u 2:($1==%g?$3:1/0):4 skip 1 w yerrorlines pt 7 ps 1.5 lc rgb '%s' t 'ridges, sigma "
			"%g m'",
			i > 0 ? ", " : "plot ", sigmas[i], colour[i], sigmas[i]);
	for (std::size_t i = 0; i < sigmas.size(); i++)
		plot +=
			format(", '' u 2:($1==%g?$6:1/0):7 skip 1 w yerrorlines pt 4 ps 1.5 dt 2 lc rgb '%s' t 'walls, sigma %g m'",
				   sigmas[i], colour[i], sigmas[i]);
	for (std::size_t i = 0; i < sigmas.size(); i++)
		plot += format(", '' u 2:($1==%g?$5:1/0) skip 1 w l dt 3 lw 1.5 lc rgb '#000000' %s", sigmas[i],
					   i == 0 ? "t 'ridges at infinite density, closed form'" : "notitle");
	drawChart(setting, "fig4",
			  format("set logscale xy\nset xlabel 'measurements per metre of wall'\n"
					 "set ylabel 'RMSD within 1 m of the corner [mm]'\nset xrange [40:7000]\nset yrange [0.3:300]\nset "
					 "ytics (0.5,1,2,5,10,20,50,100)\nset key top right maxrows 4 width -4\n"
					 "set title 'corner of 90 degrees, noise %g m, mean of %d sets'\n%s",
					 noise, sets, plot.c_str()));
	f.pictures = {"fig4.png"};
	f.claim =
		"At a corner the RMSD no longer falls with the density: the ridge cuts the corner, less so for a smaller "
		"smoothing parameter.";
	f.result = format(
		"RMSD of ridges longer than 10 sigma within 1 m of the corner at 1000 measurements per metre, for sigma 0.05, "
		"0.1 and 0.2 m: %s; mean of %d sets. It does not fall any more: the systematic error. At infinite density the "
		"occupancy has a closed form, and its ridge, found without our code that traces ridges, has %s. (Far from the "
		"corner there is no error, so the figure falls with the root of the window: within 0.78 m it is %s.) Shorter "
		"ridges, which stray measurements make beside a dense wall when sigma is below twice the noise, are no part of "
		"it; walls leave them out. The gap between corner and ridge is 0.72 sqrt(sigma^2 + s^2) within %.1f %% at 5000 "
		"per metre. The remedy: walls, which put a vertex where the straight arms meet, have %s.",
		at1000.c_str(), sets, limits.c_str(), nearLimits.c_str(), 100 * worst, wallsAt1000.c_str());
	f.verdict = worst <= 0.1 ? Verdict::holds : Verdict::differs;
	return f;
}

Finding cornerFigure(const Setting& setting)
{
	Finding f;
	f.id = "fig5";
	f.title = "Fig. 5: the ridge at a corner";
	writeRow(setting.path("fig5.png"), {cornerPicture(60, setting.seed), cornerPicture(3000, setting.seed)}, 1800);
	f.pictures = {"fig5.png"};
	f.claim =
		"At a low density the noise bends the ridge; at a high density what is left is the systematic cut of the "
		"corner.";
	f.result =
		"Occupancy (blue), measurements (dots), true surface (green) and ridge with its nodes (red), sigma 0.1 m, "
		"noise 0.033 m, eps sigma/500. So it is.";
	return f;
}

}  // namespace ridgemap::apps
