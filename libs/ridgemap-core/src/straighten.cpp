// SPDX-License-Identifier: BSD-3-Clause
// Straight and circular runs. A ridge follows every chance of its measurements; where a line or an arc explains it
// within these chances, over a stretch many kernels long, that curve is known far better than any vertex.
#include <ridgemap/standard_error.h>

#include <cmath>

#include "bend.h"
#include "runs.h"
#include "wall_path.h"
#include "walls.h"

namespace ridgemap
{
namespace
{
// Lengths in units of se = sqrt(sigma^2 + s^2), the width of the density across the wall.
constexpr double spacing = 0.25;            ///< of samples
constexpr double systematic = 0.01;         ///< error of a ridge that averages do not remove [sigma]
constexpr double largestExcessError = 0.1;  ///< of a place, from what neither noise nor density explain
constexpr double smallestRadius = 2;        ///< of an arc
constexpr double largestTail = 3.5;         ///< between the last run and a made end, that is drawn as part of the run
constexpr double tailReach = 0.5;           ///< farthest that the end may lie from the run for that
constexpr double junctionReach = 1.5;       ///< the same where the end was led to another wall: ridges turn aside there
constexpr double jointReach = 2.5;          ///< farthest that two runs may cross from where they meet
constexpr double sagitta = 0.5;             ///< of the segments of an arc [eps]

/** A stretch between made vertices, or ends, of a line: vertices first..last, samples of what lies on the ridge. */
struct Section
{
	std::size_t first = 0, last = 0;
	std::vector<WallSample> samples;
	std::vector<Run> runs;
};

class Straightener
{
 public:
	Straightener(const Polyline& line, const Options& options)
		: line_(line), options_(options), path_(line), se_(densityWidth(line, options.sigma))
	{
		systematic_ = systematic * options.sigma;
	}

	Polyline run()
	{
		findSections();
		std::vector<WallSample> all;
		for (Section& s : sections_)
		{
			sample(s);
			all.insert(all.end(), s.samples.begin(), s.samples.end());
		}
		const double excess = excessError(all), cap = largestExcessError * se_;
		for (Section& s : sections_)
		{
			for (WallSample& i : s.samples)
				i.variance = std::max(i.variance, std::min(excess * excess * i.variance, cap * cap));
			RunRules rules;
			rules.bounded = isMade(s.first) && isMade(s.last);
			rules.largestCurvature = 1 / (smallestRadius * se_);
			if (s.samples.size() >= 2) s.runs = findRuns(s.samples, rules);
			dropTails(s);
			if (options_.correctBends)
				for (Run& r : s.runs)
					if (r.shape == WallShape::arc) r.curve = unbent(r.curve, options_.sigma);
		}
		return draw();
	}

	/** Vertex of a closed line without corners where its drawing should begin: between two runs. */
	std::size_t bestBeginning() const
	{
		if (!line_.closed || sections_.size() != 1 || sections_[0].runs.size() < 2) return 0;
		const Section& s = sections_[0];
		const double arc = s.samples[s.runs[1].from].arc;
		std::size_t k = 0;
		while (k + 2 < line_.points.size() && path_.arc(k) < arc) k++;
		return k;
	}

 private:
	bool isMade(std::size_t k) const { return line_.info[k].origin != VertexOrigin::ridge; }
	Vec2 point(std::size_t k) const { return {line_.points[k].x, line_.points[k].y}; }

	void findSections()
	{
		for (std::size_t k = 1, first = 0; k < line_.points.size(); k++)
			if (isMade(k) || k + 1 == line_.points.size())
			{
				sections_.push_back({first, k, {}, {}});
				first = k;
			}
	}

	/** Variance of the place of a ridge with this density, by which the runs are weighted and judged. */
	double variance(double occupancy) const
	{
		const double s2 = std::max(0.0, se_ * se_ - options_.sigma * options_.sigma);
		return offsetVariance(std::max(occupancy, 1.0), std::sqrt(s2), options_.sigma) + systematic_ * systematic_;
	}

	void sample(Section& s) const
	{
		const std::size_t a = s.first + isMade(s.first), b = s.last - isMade(s.last);
		if (b <= a || b >= line_.points.size()) return;
		const double from = path_.arc(a), length = path_.arc(b) - from;
		const int n = int(length / (spacing * se_)) + 1;
		if (n < 2) return;
		std::size_t k = a + 1;
		for (int i = 0; i < n; i++)
		{
			const double arc = from + length * i / (n - 1);
			while (k < b && path_.arc(k) < arc) k++;
			const double d = path_.arc(k) - path_.arc(k - 1);
			const double t = d > 0 ? std::min(1.0, (arc - path_.arc(k - 1)) / d) : 0;
			const double la = double(line_.info[k - 1].occupancy), lb = double(line_.info[k].occupancy);
			s.samples.push_back({path_.at(arc), arc, variance(la + t * (lb - la))});
		}
	}

	/** A short bend between a run and a made vertex is of the kernels' making. */
	void dropTails(Section& s) const
	{
		const auto isTail = [&](const Run& tail, const Run& run, std::size_t vertex)
		{
			return tail.shape == WallShape::curve && run.shape == WallShape::line && isMade(vertex) &&
				   s.samples[tail.to - 1].arc - s.samples[tail.from].arc < largestTail * se_ &&
				   std::abs(run.curve.distance(point(vertex))) <
					   (line_.info[vertex].origin == VertexOrigin::junction ? junctionReach : tailReach) * se_;
		};
		if (s.runs.size() > 1 && isTail(s.runs.back(), s.runs[s.runs.size() - 2], s.last)) s.runs.pop_back();
		if (s.runs.size() > 1 && isTail(s.runs[0], s.runs[1], s.first)) s.runs.erase(s.runs.begin());
	}

	Polyline draw()
	{
		result_ = line_;
		result_.points.clear();
		result_.info.clear();
		for (std::size_t i = 0; i < sections_.size(); i++)
		{
			drawBoundary(sections_[i].first, before(i), sections_[i].runs.empty() ? nullptr : &sections_[i].runs[0]);
			drawSection(sections_[i]);
		}
		if (line_.closed)
		{
			result_.points.push_back(result_.points.front());
			result_.info.push_back(result_.info.front());
		}
		else
		{
			const Section& s = sections_.back();
			drawBoundary(s.last, s.runs.empty() ? nullptr : &s.runs.back(), nullptr);
		}
		const std::size_t least = line_.closed ? 4 : 2;
		return result_.points.size() < least ? line_ : result_;
	}

	/** The run that leads to the first vertex of a section. */
	const Run* before(std::size_t section) const
	{
		if (section == 0 && !line_.closed) return nullptr;
		const Section& s = sections_[section > 0 ? section - 1 : sections_.size() - 1];
		return s.runs.empty() ? nullptr : &s.runs.back();
	}

	static bool isRun(const Run* r) { return r && r->shape != WallShape::curve; }

	void add(Vec2 p, VertexInfo info, const Run* a, const Run* b)
	{
		if (isRun(a) || isRun(b)) info.standardError = 0;
		for (const Run* r : {a, b})
			if (isRun(r))
				info.standardError =
					std::max(info.standardError, float(std::sqrt(samplesPerIndependent * r->curve.variance(p))));
		info.shape = b ? b->shape : WallShape::curve;
		const Point2 q{p.x, p.y};
		if (!result_.points.empty() && result_.points.back() == q)
		{
			result_.info.back().shape = info.shape;
			return;
		}
		result_.points.push_back(q);
		result_.info.push_back(info);
	}

	/** A vertex of the line that bounds sections. */
	void drawBoundary(std::size_t k, const Run* a, const Run* b)
	{
		const Vec2 old = point(k);
		VertexInfo info = line_.info[k];
		if (!isRun(a) && !isRun(b))
		{
			add(old, info, a, b);
			return;
		}
		if (!isMade(k)) info = madeVertex(VertexOrigin::run);
		if (isRun(a) && isRun(b))
		{
			if (const auto p = intersection(a->curve, b->curve, old, jointReach * se_))
			{
				add(*p, info, a, b);
				return;
			}
			add(0.5 * (a->curve.project(old) + b->curve.project(old)), info, a, b);
			return;
		}
		add((isRun(a) ? a : b)->curve.project(old), info, a, b);
	}

	/** Everything between the two vertices that bound a section. */
	void drawSection(const Section& s)
	{
		if (s.runs.empty())
		{
			for (std::size_t k = s.first + 1; k < s.last; k++) add(point(k), line_.info[k], nullptr, nullptr);
			return;
		}
		for (std::size_t i = 0; i < s.runs.size(); i++)
		{
			const Run& r = s.runs[i];
			const Run* next = i + 1 < s.runs.size() ? &s.runs[i + 1] : nullptr;
			if (r.shape == WallShape::curve) drawFree(s, i);
			if (r.shape == WallShape::arc) drawArc(s, i);
			if (next) drawJoint(s, r, *next);
		}
	}

	/** Vertices of the ridge over a free stretch. */
	void drawFree(const Section& s, std::size_t i)
	{
		const Run& r = s.runs[i];
		const double from = i > 0 ? s.samples[r.from].arc : -1;
		const double to = i + 1 < s.runs.size() ? s.samples[r.to].arc : 2 * path_.length();
		for (std::size_t k = s.first + 1; k < s.last; k++)
			if (path_.arc(k) > from && path_.arc(k) < to) add(point(k), line_.info[k], nullptr, &r);
	}

	/** Where two runs meet inside a section. */
	void drawJoint(const Section& s, const Run& a, const Run& b)
	{
		const Vec2 old = s.samples[b.from].p;
		const VertexInfo info = madeVertex(VertexOrigin::run);
		if (isRun(&a) && isRun(&b))
		{
			if (const auto p = intersection(a.curve, b.curve, old, jointReach * se_))
				add(*p, info, &a, &b);
			else
				add(0.5 * (a.curve.project(old) + b.curve.project(old)), info, &a, &b);
			return;
		}
		add((isRun(&a) ? a : b).curve.project(old), info, &a, &b);
	}

	/** Inner vertices of an arc, as far apart as half of eps allows. */
	void drawArc(const Section& s, std::size_t i)
	{
		const Run& r = s.runs[i];
		const double radius = 1 / std::abs(r.curve.curvature);
		const double step = std::sqrt(8 * radius * sagitta * options_.effectiveEps());
		const double from = s.samples[r.from].arc, length = s.samples[r.to - 1].arc - from;
		const int n = std::max(2, int(length / step) + 1);
		for (int k = 1; k < n; k++)
			add(r.curve.project(path_.at(from + length * k / n)), madeVertex(VertexOrigin::run), nullptr, &r);
	}

	const Polyline& line_;
	const Options& options_;
	Path path_;
	double se_, systematic_ = 0;
	std::vector<Section> sections_;
	Polyline result_;
};

/** A closed line that begins at another of its vertices. */
Polyline rotated(const Polyline& line, std::size_t k)
{
	Polyline r = line;
	r.points.pop_back();
	r.info.pop_back();
	std::rotate(r.points.begin(), r.points.begin() + std::ptrdiff_t(k), r.points.end());
	std::rotate(r.info.begin(), r.info.begin() + std::ptrdiff_t(k), r.info.end());
	r.points.push_back(r.points.front());
	r.info.push_back(r.info.front());
	return r;
}
}  // namespace

Polyline straightenRuns(const Polyline& line, const Options& options)
{
	if (line.closed)
	{
		std::size_t k = 0;
		while (k + 1 < line.points.size() && line.info[k].origin == VertexOrigin::ridge) k++;
		if (k + 1 < line.points.size()) return Straightener(k > 0 ? rotated(line, k) : line, options).run();
		Straightener first(line, options);
		Polyline result = first.run();
		const std::size_t better = first.bestBeginning();
		return better > 0 ? Straightener(rotated(line, better), options).run() : result;
	}
	return Straightener(line, options).run();
}

}  // namespace ridgemap
