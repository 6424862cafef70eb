// SPDX-License-Identifier: BSD-3-Clause
// Fig. 3: the error of a straight wall falls with the root of the number of measurements.
#include <ridgemap/standard_error.h>

#include "../common/evaluation.h"
#include "chart.h"
#include "experiments.h"
#include "made_up.h"

namespace ridgemap::apps
{
namespace
{
constexpr double sigma = 0.1, noise = 0.033, length = 10, margin = 0.5;  // [m]
const Segment wall{{0, 0}, {length, 0}};

/** RMSD of the ridges away from the ends of the wall. */
double wallError(double density, std::uint64_t seed)
{
	Random random(seed);
	std::vector<Measurement> points;
	addWall(points, wall, density, noise, random);
	Options options = paperOptions(sigma);
	options.eps = sigma / 5000;                         // a chord within eps smooths what chance does on this scale
	options.straighten = options.correctBends = false;  // of the ridges themselves, without short ones
	RidgeMap map(options);
	map.insert(points);
	DistanceSum sum;
	for (const Polyline& p : clipped(map.walls(), {{margin, -1}, {length - margin, 1}}))
		for (std::size_t i = 1; i < p.points.size(); i++)
			sum += integrateDistance(p.points[i - 1], p.points[i], {wall});
	return sum.rmsd();
}
}  // namespace

Finding straightWall(const Setting& setting)
{
	const std::vector<double> densities{100, 200, 500, 1000, 2000, 5000, 10000, 20000};
	const int sets = setting.repeat(100, 6);
	Finding f;
	f.id = "fig3";
	f.title = "Fig. 3: a straight wall";
	f.table.columns = {"measurements per m", "RMSD mm", "standard error mm", "closed form mm"};
	std::vector<double> logDensity, logError;
	for (const double density : densities)
	{
		std::vector<double> errors;
		for (int i = 0; i < sets; i++)
			errors.push_back(1e3 *
							 wallError(density, setting.seed * 100003 + std::uint64_t(i) * 64 + logDensity.size()));
		const Mean m = meanOf(errors);
		const double kernels = density * std::sqrt(2 * M_PI) * sigma * sigma / std::hypot(sigma, noise);
		f.table.rows.push_back({density, m.value, m.error, 1e3 * std::sqrt(offsetVariance(kernels, noise, sigma))});
		logDensity.push_back(std::log(density));
		logError.push_back(std::log(m.value));
	}
	const LineFit fit = fitLine(logDensity, logError);
	writeCsv(setting.path("fig3.csv"), f.table);
	drawChart(setting, "fig3",
			  format("set logscale xy\nset xlabel 'measurements per metre of wall'\nset ylabel 'RMSD [mm]'\n"
					 "set xrange [70:28000]\nset yrange [0.3:8]\nset ytics (0.3,0.5,1,2,3,5,8)\nset title 'straight "
					 "wall, mean of %d sets'\n"
					 "plot %.9g*x**%.9g w l dt 2 lc rgb '#c62828' t 'fit: slope %.3f +- %.3f', "
					 "'fig3.csv' u 1:4 skip 1 w l lc rgb '#2e7d32' t 'closed form (no fit)', "
					 "'' u 1:2:3 skip 1 w yerrorbars pt 7 ps 1.6 lc rgb '#1f4e9c' t 'measured'",
					 sets, std::exp(fit.intercept), fit.slope, fit.slope, fit.slopeError));
	f.pictures = {"fig3.png"};
	f.claim =
		"The RMSD of a straight wall falls with the density of measurements as rho^-0.5 (mean of 100 random sets).";
	f.result = format(
		"Slope %.4f +- %.4f over %.1f decades of density (mean of %d sets, sigma %g m, noise %g m, eps sigma/5000, "
		"half a metre at each end left out). The closed form of the variance predicts the height of the line, too.",
		fit.slope, fit.slopeError, std::log10(densities.back() / densities.front()), sets, sigma, noise);
	f.verdict = std::abs(fit.slope + 0.5) <= 0.02 ? Verdict::holds : Verdict::differs;
	return f;
}

}  // namespace ridgemap::apps
