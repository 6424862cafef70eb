// SPDX-License-Identifier: BSD-3-Clause
// Do the 95 % intervals of ridges cover the true wall in 95 % of cases?
#include <ridgemap/standard_error.h>

#include "chart.h"
#include "experiments.h"
#include "made_up.h"

namespace ridgemap::apps
{
namespace
{
constexpr double noise = 0.033;  // [m]

struct Coverage
{
	std::vector<double> covered;    ///< share per wall: walls are independent, places on one are not
	std::vector<double> offsets;    ///< [m]
	std::vector<double> predicted;  ///< standard errors [m]
	std::size_t places = 0, missing = 0;
};

/** The ridge at x, between the nodes beside it. */
bool ridgeAt(const std::vector<Polyline>& ridges, double x, double& y, VertexInfo& info)
{
	for (const Polyline& p : ridges)
		for (std::size_t i = 1; i < p.points.size(); i++)
		{
			const Point2 &a = p.points[i - 1], &b = p.points[i];
			if ((a.x <= x) == (b.x <= x)) continue;
			const double t = (x - a.x) / (b.x - a.x);
			y = a.y + t * (b.y - a.y);
			info.occupancy = float(p.info[i - 1].occupancy + t * (p.info[i].occupancy - p.info[i - 1].occupancy));
			info.curvature = float(p.info[i - 1].curvature + t * (p.info[i].curvature - p.info[i - 1].curvature));
			return true;
		}
	return false;
}

void addWallCoverage(double density, double sigma, std::uint64_t seed, Coverage& c)
{
	Random random(seed);
	std::vector<Measurement> points;
	const double margin = 6 * sigma, length = 40 * sigma;
	addWall(points, {{-margin, 0}, {length + margin, 0}}, density, noise, random);
	Options options = paperOptions(sigma);
	options.eps = sigma / 5000;                         // a chord within eps smooths what chance does on this scale
	options.straighten = options.correctBends = false;  // of the ridges themselves, without short ones
	RidgeMap map(options);
	map.insert(points);
	double covered = 0, found = 0;
	for (double x = 0; x <= length; x += 2 * sigma)
	{
		double y = 0;
		VertexInfo info;
		c.places++;
		if (!ridgeAt(map.walls(), x, y, info))
		{
			c.missing++;
			continue;
		}
		const RidgeUncertainty u = ridgeUncertainty(info, sigma);
		found++;
		covered += std::abs(y) <= u.halfWidth95 ? 1 : 0;
		c.offsets.push_back(y);
		c.predicted.push_back(u.standardError);
	}
	if (found > 0) c.covered.push_back(covered / found);
}

double rootMeanSquare(const std::vector<double>& values)
{
	double sum = 0;
	for (const double v : values) sum += v * v;
	return values.empty() ? 0 : std::sqrt(sum / double(values.size()));
}

}  // namespace

Finding standardErrors(const Setting& setting)
{
	Finding f;
	f.id = "standard-errors";
	f.title = "Standard errors";
	f.claim =
		"Nothing: the error bounds of the paper are about the distance to the ridge, not about how far chance moves "
		"the "
		"ridge.";
	f.table.columns = {"sigma m",        "measurements per m", "kernels",
					   "coverage %",     "standard error %",   "offset mm (rms)",
					   "closed form mm", "stated mm (median)", "missing %"};
	const int walls = setting.repeat(400, 30);
	double lowest = 100, highest = 0;
	for (const double sigma : {0.05, 0.1, 0.2})
		for (const double density : {50.0, 150.0, 500.0, 1500.0, 5000.0})
		{
			Coverage c;
			for (int i = 0; i < walls; i++) addWallCoverage(density, sigma, setting.seed * 65537 + std::uint64_t(i), c);
			const Mean m = meanOf(c.covered);
			const double kernels = density * std::sqrt(2 * M_PI) * sigma * sigma / std::hypot(sigma, noise);
			f.table.rows.push_back({sigma, density, kernels, 100 * m.value, 100 * m.error,
									1e3 * rootMeanSquare(c.offsets),
									1e3 * std::sqrt(offsetVariance(kernels, noise, sigma)),
									1e3 * quantile(c.predicted, 0.5), 100 * double(c.missing) / double(c.places)});
			lowest = std::min(lowest, 100 * m.value);
			highest = std::max(highest, 100 * m.value);
		}
	writeCsv(setting.path("standard-errors.csv"), f.table);
	std::string plot;
	const char* colour[] = {"#1f4e9c", "#2e7d32", "#c62828"};
	const double sigmas[] = {0.05, 0.1, 0.2};
	for (int i = 0; i < 3; i++)
		plot += format(
			"%s'standard-errors.csv' u ($2*%g):($1==%g?$4:1/0):5 skip 1 w yerrorlines pt 7 ps 1.6 lc rgb '%s' t 'sigma "
			"%g m'",
			i > 0 ? ", " : "plot 93 w l dt 2 lc rgb '#888888' notitle, 97 w l dt 2 lc rgb '#888888' t '93 and 97 %', ",
			1 + 0.03 * i, sigmas[i], colour[i], sigmas[i]);
	drawChart(setting, "standard-errors",
			  "set logscale x\nset yrange [88:100]\nset key bottom right\nset xrange [30:8000]\nset xlabel "
			  "'measurements per metre of wall'\n"
			  "set ylabel 'true wall within the 95 % interval [%]'\nset title 'coverage of the 95 % intervals on "
			  "straight walls'\n" +
				  plot);
	f.pictures = {"standard-errors.png"};
	f.result = format(
		"Every node states its standard error from L and lambda1 alone. On straight walls (noise %g m, %d walls per "
		"row) the "
		"95 %% intervals cover the true wall in %.1f to %.1f %% of places, over two decades of density and three "
		"sigmas.",
		noise, walls, lowest, highest);
	f.verdict = Verdict::beyond;
	return f;
}

}  // namespace ridgemap::apps
