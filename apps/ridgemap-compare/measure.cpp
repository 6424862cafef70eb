// SPDX-License-Identifier: BSD-3-Clause
#include "measure.h"

#include <malloc.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/tfest/TMatchingPair.h>
#include <ridgemap/observation_to_measurements.h>
#include <ridgemap/polyline_index.h>
#include <time.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "quantile.h"

namespace ridgemap::apps
{
namespace
{
constexpr double reach = 0.1;      // distances beyond count apart [m]
constexpr double measured = 0.05;  // truth with the end of a beam this near was seen [m]
constexpr double covered = 0.03;   // truth with a surface this near is complete [m]
constexpr std::size_t mostQueries = 200;

/** Time that the processor spent on the program, all of its threads [us]: other programs do not count. */
double processorTime()
{
	timespec t{};
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return 1e6 * double(t.tv_sec) + 1e-3 * double(t.tv_nsec);
}

double microseconds(const std::function<void()>& task)
{
	const double start = processorTime();
	task();
	return processorTime() - start;
}

/** Of the whole program [bytes]. */
std::size_t heapInUse()
{
	const auto info = mallinfo2();
	return info.uordblks + info.hblkhd;
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

struct Bytes
{
	std::size_t serialized = 0, compressed = 0;
};

Bytes bytesOf(const mrpt::maps::CMetricMap& map)
{
	mrpt::io::CMemoryStream stream;
	mrpt::serialization::archiveFrom(stream) << map;
	const auto n = stream.getTotalBytesCount();
	uLongf size = compressBound(uLong(n));
	std::vector<Bytef> packed(size);
	compress(packed.data(), &size, static_cast<const Bytef*>(stream.getRawBufferData()), uLong(n));
	return {std::size_t(n), std::size_t(size)};
}

void measureBytes(const Contestant& c, Figures& f)
{
	const Bytes map = bytesOf(c.map());
	f.serialized = map.serialized;
	f.compressed = map.compressed;
	const auto reduced = c.forLocalization();
	f.onRobot = reduced ? bytesOf(*reduced).compressed : map.compressed;
}

QueryTimes queryTimesOf(const std::vector<double>& fresh, const std::vector<double>& again)
{
	return {timesOf(fresh), quantile(again, 0.5)};
}

/** Queries at the poses of up to 200 scans, a little beside them, as a robot that is not sure yet asks. Each twice: the
 * first time, nothing at this place is in a cache. */
void measureQueries(const Contestant& c, const std::vector<PosedScan>& scans, Figures& f)
{
	std::vector<double> likelihood[2], matching[2];
	const std::size_t step = std::max<std::size_t>(1, scans.size() / mostQueries);
	mrpt::maps::TMatchingParams params;
	params.maxDistForCorrespondence = 0.3f;
	for (std::size_t i = 0; i < scans.size(); i += step)
	{
		const auto pose = scans[i].pose + mrpt::poses::CPose3D(0.03, 0.02, 0, 0.01, 0, 0);
		const auto scan = thinned(*scans[i].scan, std::size_t(-1));
		mrpt::maps::CSimplePointsMap points;
		points.insertionOptions.minDistBetweenLaserPoints = 0;
		points.insertObservation(*scan);
		mrpt::tfest::TMatchingPairList pairs;
		mrpt::maps::TMatchingExtraResults extra;
		for (std::vector<double>& times : likelihood)
			times.push_back(microseconds([&] { (void)c.map().computeObservationLikelihood(*scan, pose); }));
		for (std::vector<double>& times : matching)
			times.push_back(microseconds(
				[&] { c.map().determineMatching2D(&points, mrpt::poses::CPose2D(pose), pairs, params, extra); }));
	}
	f.likelihood = queryTimesOf(likelihood[0], likelihood[1]);
	f.matching = queryTimesOf(matching[0], matching[1]);
}

std::vector<Measurement> endsOf(const PosedScan& s)
{
	return observationToMeasurements(*s.scan, s.pose, TInsertionOptions());
}

/** Share of the truth with a surface of the map near. Of the truth counts what is said to be seen and has the end of a
 * beam near. */
double completenessOf(const Contestant& c, const std::vector<Segment>& truth, const std::vector<PosedScan>& scans)
{
	mrpt::maps::CSimplePointsMap ends;
	for (const PosedScan& s : scans)
		for (const Measurement& m : endsOf(s)) ends.insertPointFast(float(m.x), float(m.y), 0);
	ends.mark_as_modified();
	std::size_t all = 0, found = 0;
	for (const Segment& s : truth)
	{
		if (!s.seen || ends.empty()) continue;
		const auto n = std::size_t(std::ceil(s.length() / 0.01));
		for (std::size_t k = 0; k < n; k++)
		{
			const Point2 p = s.at((double(k) + 0.5) / double(n));
			float squared = 0;
			ends.kdTreeClosestPoint2D(float(p.x), float(p.y), squared);
			if (std::sqrt(double(squared)) > measured) continue;
			all++;
			found += c.distance(p) <= covered ? 1 : 0;
		}
	}
	return all > 0 ? double(found) / double(all) : 0;
}

void compareWithTruth(Contestant& c, const std::vector<Segment>& truth, const std::vector<PosedScan>& scans, Figures& f)
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
	f.completeness = completenessOf(c, truth, scans);
}

/** Builds the map without each N-th scan and appends the distances of those to it. */
std::unique_ptr<Contestant> holdOut(const ContestantKind& kind, const Material& m, std::size_t fold,
									std::vector<double>& residuals)
{
	auto map = kind.make();
	for (std::size_t i = 0; i < m.scans.size(); i++)
		if (i % m.folds != fold) map->insert(m.scans[i]);
	map->prepareDistances();
	for (std::size_t i = fold; i < m.scans.size(); i += m.folds)
		for (const Measurement& end : endsOf(m.scans[i])) residuals.push_back(map->distance({end.x, end.y}));
	return map;
}

void measureLocalization(const Contestant& c, const std::vector<PosedScan>& pass, Figures& f)
{
	f.localization = localise(c.map(), pass);
	const auto reduced = c.forLocalization();
	f.onRobotLocalization = reduced ? localise(*reduced, pass) : f.localization;
}

void crossValidate(const ContestantKind& kind, const Material& m, Figures& f)
{
	std::vector<double> residuals;
	for (std::size_t fold = 0; fold < m.folds; fold++)
	{
		const auto map = holdOut(kind, m, fold, residuals);
		if (fold > 0 || !m.secondPass.empty()) continue;
		std::vector<PosedScan> unseen;
		for (std::size_t i = fold; i < m.scans.size(); i += m.folds) unseen.push_back(m.scans[i]);
		measureLocalization(*map, unseen, f);
	}
	f.heldOut = distancesOf(residuals);
}
}  // namespace

Measured measure(const ContestantKind& kind, const Material& m)
{
	std::vector<double> insertion;
	insertion.reserve(m.scans.size());
	const std::size_t heapBefore = heapInUse();
	Measured result{kind.make(), Figures()};
	Contestant& c = *result.map;
	Figures& f = result.figures;
	f.name = kind.name;
	for (const PosedScan& s : m.scans) insertion.push_back(microseconds([&] { c.insert(s); }));
	f.insertion = timesOf(insertion);
	f.memory = c.memory();
	measureQueries(c, m.scans, f);
	f.heap = std::max(heapInUse(), heapBefore) - heapBefore;
	measureBytes(c, f);
	if (!m.secondPass.empty()) measureLocalization(c, m.secondPass, f);
	crossValidate(kind, m, f);
	if (m.truth.empty()) return result;
	c.prepareDistances();
	compareWithTruth(c, m.truth, m.scans, f);
	return result;
}

}  // namespace ridgemap::apps
