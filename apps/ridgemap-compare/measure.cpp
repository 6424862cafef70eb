// SPDX-License-Identifier: BSD-3-Clause
#include "measure.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/tfest/TMatchingPair.h>
#include <ridgemap/observation_to_measurements.h>
#include <ridgemap/polyline_index.h>
#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

namespace ridgemap::apps
{
namespace
{
constexpr double reach = 0.1;     // distances beyond count apart [m]
constexpr double covered = 0.03;  // truth with a surface this near is complete [m]
constexpr std::size_t mostQueries = 200;

double microseconds(const std::function<void()>& task)
{
	const auto start = std::chrono::steady_clock::now();
	task();
	return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

double quantile(std::vector<double> v, double q)
{
	if (v.empty()) return 0;
	std::sort(v.begin(), v.end());
	return v[std::min(v.size() - 1, std::size_t(std::ceil(q * double(v.size()))) - (q > 0 ? 1 : 0))];
}

Times timesOf(const std::vector<double>& us)
{
	Times t;
	if (us.empty()) return t;
	t.cold = us.front();
	const std::vector<double> warm(us.begin() + (us.size() > 1 ? 1 : 0), us.end());
	t.median = quantile(warm, 0.5);
	t.p99 = quantile(warm, 0.99);
	const auto tenth = std::ptrdiff_t(std::max<std::size_t>(1, us.size() / 10));
	const double first = quantile({us.begin(), us.begin() + tenth}, 0.5);
	t.growth = first > 0 ? quantile({us.end() - tenth, us.end()}, 0.5) / first : 1;
	return t;
}

Distances distancesOf(const std::vector<double>& all)
{
	Distances d;
	d.count = all.size();
	d.histogram.assign(bars, 0);
	double sum = 0;
	std::size_t near = 0;
	for (const double v : all)
	{
		d.histogram[std::min(bars - 1, std::size_t(std::min(v, 1e3) / barWidth))] += 1.0 / double(all.size());
		if (v > reach) continue;
		sum += v * v;
		near++;
	}
	d.median = quantile(all, 0.5);
	d.rms = near > 0 ? std::sqrt(sum / double(near)) : 0;
	d.beyond = all.empty() ? 0 : 1 - double(near) / double(all.size());
	return d;
}

void measureBytes(const mrpt::maps::CMetricMap& map, Figures& f)
{
	mrpt::io::CMemoryStream stream;
	mrpt::serialization::archiveFrom(stream) << map;
	f.serialized = stream.getTotalBytesCount();
	uLongf size = compressBound(uLong(f.serialized));
	std::vector<Bytef> packed(size);
	compress(packed.data(), &size, static_cast<const Bytef*>(stream.getRawBufferData()), uLong(f.serialized));
	f.compressed = size;
}

/** Queries at the poses of up to 200 scans, a little beside them, as a robot that is not sure yet asks. */
void measureQueries(const Contestant& c, const std::vector<PosedScan>& scans, Figures& f)
{
	std::vector<double> likelihood, matching;
	const std::size_t step = std::max<std::size_t>(1, scans.size() / mostQueries);
	mrpt::maps::TMatchingParams params;
	params.maxDistForCorrespondence = 0.3f;
	for (std::size_t i = 0; i < scans.size(); i += step)
	{
		const auto pose = scans[i].pose + mrpt::poses::CPose3D(0.03, 0.02, 0, 0.01, 0, 0);
		likelihood.push_back(microseconds([&] { (void)c.map().computeObservationLikelihood(*scans[i].scan, pose); }));
		mrpt::maps::CSimplePointsMap points;
		points.insertionOptions.minDistBetweenLaserPoints = 0;
		points.insertObservation(*scans[i].scan);
		mrpt::tfest::TMatchingPairList pairs;
		mrpt::maps::TMatchingExtraResults extra;
		matching.push_back(microseconds(
			[&] { c.map().determineMatching2D(&points, mrpt::poses::CPose2D(pose), pairs, params, extra); }));
	}
	f.likelihood = timesOf(likelihood);
	f.matching = timesOf(matching);
}

void compareWithTruth(Contestant& c, const std::vector<Segment>& truth, Figures& f)
{
	std::vector<Polyline> lines;
	for (const Segment& s : truth)
	{
		lines.emplace_back();
		lines.back().points = {s.a, s.b};
	}
	const PolylineIndex index(lines, 0.1);
	std::vector<double> errors;
	for (const Point2& p : c.surface())
		if (const auto nearest = index.nearest(p)) errors.push_back(nearest->distance);
	f.surface = distancesOf(errors);
	std::size_t all = 0, found = 0;
	for (const Segment& s : truth)
		if (s.seen)
		{
			const auto n = std::size_t(std::ceil(s.length() / 0.01));
			for (std::size_t k = 0; k < n; k++, all++)
				found += c.distance(s.at((double(k) + 0.5) / double(n))) <= covered ? 1 : 0;
		}
	f.completeness = all > 0 ? double(found) / double(all) : 0;
}
}  // namespace

Figures measure(Contestant& c, const std::vector<PosedScan>& scans, const std::vector<Segment>& truth)
{
	Figures f;
	f.name = c.name();
	std::vector<double> insertion;
	for (const PosedScan& s : scans) insertion.push_back(microseconds([&] { c.insert(s); }));
	f.insertion = timesOf(insertion);
	f.memory = c.memory();
	measureBytes(c.map(), f);
	measureQueries(c, scans, f);
	if (truth.empty()) return f;
	c.prepareDistances();
	compareWithTruth(c, truth, f);
	return f;
}

Distances crossValidate(const Contestant& kind, const std::vector<PosedScan>& scans, std::size_t folds)
{
	std::vector<double> residuals;
	for (std::size_t fold = 0; fold < folds; fold++)
	{
		const auto map = kind.fresh();
		for (std::size_t i = 0; i < scans.size(); i++)
			if (i % folds != fold) map->insert(scans[i]);
		map->prepareDistances();
		for (std::size_t i = fold; i < scans.size(); i += folds)
			for (const Measurement& m : observationToMeasurements(*scans[i].scan, scans[i].pose, TInsertionOptions()))
				residuals.push_back(map->distance({m.x, m.y}));
	}
	return distancesOf(residuals);
}

}  // namespace ridgemap::apps
