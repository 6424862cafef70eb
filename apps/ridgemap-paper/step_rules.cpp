// SPDX-License-Identifier: BSD-3-Clause
// The step rule of the paper against the error-controlled one.
#include "chart.h"
#include "experiments.h"
#include "made_up.h"
#include "true_ridge.h"

namespace ridgemap::apps
{
namespace
{
struct RuleFigures
{
	double evaluationsPerMetre = 0, nodesPerMetre = 0;
	std::vector<double> errors;  ///< of points on segments [sigma]
	std::size_t unresolved = 0;  ///< points across which no ridge was found
};

/** Distances to the ridge at 9 inner points of every segment. */
void addErrors(const RidgeMap& map, RuleFigures& figures)
{
	constexpr int inner = 9;
	for (const Polyline& p : map.ridges())
		for (std::size_t i = 1; i < p.points.size(); i++)
			for (int k = 1; k <= inner; k++)
			{
				const Point2 q = Segment{p.points[i - 1], p.points[i]}.at(double(k) / (inner + 1));
				if (const auto d = distanceToRidge(map, q))
					figures.errors.push_back(*d / map.options().sigma);
				else
					figures.unresolved++;
			}
}

RuleFigures figuresOf(const Options& options, int drives, std::uint64_t seed)
{
	RuleFigures figures;
	double evaluations = 0, nodes = 0, metres = 0;
	for (int i = 0; i < drives; i++)
	{
		RidgeMap map(options);
		map.insert(driveHallway(60, seed + std::uint64_t(i)).all());
		evaluations += double(map.update().evaluations);
		for (const Polyline& p : map.ridges())
		{
			metres += p.length();
			nodes += double(p.points.size());
		}
		addErrors(map, figures);
	}
	figures.evaluationsPerMetre = evaluations / metres;
	figures.nodesPerMetre = nodes / metres;
	return figures;
}

}  // namespace

Finding stepRules(const Setting& setting)
{
	const int drives = setting.repeat(10, 1);
	Finding f;
	f.id = "step-rules";
	f.title = "Step rules";
	f.claim =
		"The step is halved when the relaxation moves a node by more than 0.75 sigma, and doubled below 0.25 sigma; "
		"the "
		"approximation can be tuned to arbitrary accuracy.";
	f.table.columns = {"rule (0: eps, 1: paper)",
					   "eps or longest step, sigma",
					   "maximum sigma",
					   "99.9 % sigma",
					   "median sigma",
					   "evaluations per m",
					   "nodes per m",
					   "points",
					   "unresolved"};
	struct Case
	{
		StepRule rule;
		double value;
	};
	for (const Case c : {Case{StepRule::error, 0.1}, Case{StepRule::error, 0.02}, Case{StepRule::error, 0.002},
						 Case{StepRule::paper, 4}, Case{StepRule::paper, 2}, Case{StepRule::paper, 1},
						 Case{StepRule::paper, 0.5}, Case{StepRule::paper, 0.25}})
	{
		Options options = paperOptions(0.1);
		options.stepRule = c.rule;
		if (c.rule == StepRule::error)
			options.eps = c.value * options.sigma;
		else
			options.maxStep = c.value;
		const RuleFigures r = figuresOf(options, drives, setting.seed);
		f.table.rows.push_back({double(c.rule), c.value, quantile(r.errors, 1), quantile(r.errors, 0.999),
								quantile(r.errors, 0.5), r.evaluationsPerMetre, r.nodesPerMetre,
								double(r.errors.size()), double(r.unresolved)});
	}
	writeCsv(setting.path("step-rules.csv"), f.table);
	drawChart(setting, "step-rules",
			  "set logscale xy\nset xlabel 'evaluations of the occupancy per metre of ridge'\n"
			  "set ylabel 'distance of segments to the ridge [sigma]'\nset format y '%g'\nset xrange [50:600]\nset "
			  "yrange [0.0005:2]\nset xtics (50,100,200,300,400,500)\n"
			  "set title 'hallway: accuracy against work'\n"
			  "plot 'step-rules.csv' u 6:($1==0?$3:1/0) skip 1 w lp pt 7 ps 2 lc rgb '#1f4e9c' t 'error-controlled: "
			  "maximum', "
			  "'' u 6:($1==0?$4:1/0) skip 1 w lp pt 6 ps 2 dt 3 lc rgb '#1f4e9c' t '99.9 %', "
			  "'' u 6:($1==1?$3:1/0) skip 1 w lp pt 5 ps 2 lc rgb '#c62828' t 'rule of the paper: maximum', "
			  "'' u 6:($1==1?$4:1/0) skip 1 w lp pt 4 ps 2 dt 3 lc rgb '#c62828' t '99.9 %'");
	f.pictures = {"step-rules.png"};
	const auto& error = f.table.rows[1];
	const auto& paper = f.table.rows[4];
	f.result = format(
		"Distance of points on segments to the nearest place of the ridge, found by an independent Newton's method, in "
		"sigma; %d drives. With eps = 0.02: at most %.3f (99.9 %%: %.3f) for %.0f evaluations per metre. With the rule "
		"of the paper and the same "
		"longest "
		"step of 2 sigma: at most %.2f (99.9 %%: %.2f) for %.0f. A shorter longest step makes the paper's rule more "
		"accurate, "
		"but bounds nothing.",
		drives, error[2], error[3], error[5], paper[2], paper[3], paper[5]);
	bool bounded = true;
	for (const auto& row : f.table.rows) bounded = bounded && (row[0] != double(StepRule::error) || row[2] <= row[1]);
	f.verdict = bounded ? Verdict::beyond : Verdict::differs;
	return f;
}

}  // namespace ridgemap::apps
