// SPDX-License-Identifier: BSD-3-Clause
// What outliers do to a map.
#include "../common/evaluation.h"
#include "experiments.h"
#include "made_up.h"
#include "raster.h"

namespace ridgemap::apps
{
namespace
{
constexpr double sigma = 0.1;
const Box2 area{{-1, -1}, {17, 17}};

std::vector<Measurement> withOutliers(const std::vector<Measurement>& good, double share, Random& random)
{
	// A share of all measurements: each is replaced by one anywhere.
	std::vector<Measurement> points = good;
	for (Measurement& m : points)
	{
		if (!random.chance(share)) continue;
		m = Measurement();
		m.x = random.uniform(area.min.x, area.max.x);
		m.y = random.uniform(area.min.y, area.max.y);
	}
	return points;
}
}  // namespace

Finding outlierShares(const Setting& setting)
{
	Finding f;
	f.id = "outliers";
	f.title = "Outliers";
	f.claim = "L_tol, the desired number of overlapping kernels, filters outliers.";
	f.table.columns = {"measurements", "outliers %", "outliers in a kernel",
					   "L_tol",        "complete %", "RMSD mm of what is within sigma",
					   "spurious m",   "polylines"};
	std::vector<cv::Mat> pictures;
	for (const double rate : {150.0, 1000.0})
		for (const double lTol : {3.0, 12.0})
			for (const double share : {0.0, 0.1, 0.3, 0.5})
			{
				Random random(setting.seed + 17);
				const HallwayDrive drive = driveHallway(rate, setting.seed);
				const std::vector<Measurement> points = withOutliers(drive.all(), share, random);
				Options options = paperOptions(sigma);
				options.lTol = lTol;
				RidgeMap map(options);
				map.insert(points);
				const Evaluation e = evaluate(map.walls(), drive.truth, {sigma, 1, 0.35});
				const double expected = share * double(points.size()) / (18 * 18) * 2 * M_PI * sigma * sigma;
				f.table.rows.push_back({double(points.size()), 100 * share, expected, lTol, 100 * e.completeness(),
										1e3 * e.right.rmsd(), e.spurious, double(map.walls().size())});
				if (lTol != 3 || share == 0) continue;
				Raster raster(area, 700);
				raster.dots(pointsOf(points), cv::Scalar(200, 180, 150), 1);
				for (const Polyline& p : map.walls()) raster.line(p.points, colours::ridge, 2);
				pictures.push_back(raster.titled(format("%zu points, %.0f %% outliers", points.size(), 100 * share)));
			}
	writeRow(setting.path("outliers.png"), {pictures.begin(), pictures.begin() + 3}, 2100);
	writeRow(setting.path("outliers_dense.png"), {pictures.begin() + 3, pictures.end()}, 2100);
	f.pictures = {"outliers.png", "outliers_dense.png"};
	const auto& sparse = f.table.rows[3];
	const auto& dense = f.table.rows[11];
	const auto& denseHigh = f.table.rows[15];
	f.result = format(
		"A share of the measurements is moved to anywhere in 18 m x 18 m. What matters is not the share but the "
		"density: the "
		"number of outliers under one kernel against L_tol. With %.0f measurements, half of them outliers, there are "
		"%.1f "
		"under a kernel: %.1f %% complete, %.1f m spurious. With %.0f there are %.1f, more than L_tol = 3: %.0f m "
		"spurious; "
		"with L_tol = 12, %.1f m. The pictures are for L_tol = 3. (Walls are shown; where rays passed, as in "
		"the hallway itself, false ones are left out.)",
		sparse[0], sparse[2], sparse[4], sparse[6], dense[0], dense[2], dense[6], denseHigh[6]);
	f.verdict = Verdict::beyond;
	return f;
}

}  // namespace ridgemap::apps
