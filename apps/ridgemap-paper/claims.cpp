// SPDX-License-Identifier: BSD-3-Clause
// Claims of the paper about changes of a map, as experiments.
#include "experiments.h"
#include "made_up.h"

namespace ridgemap::apps
{
namespace
{
Options optionsOf(double sigma)
{
	Options options;
	options.sigma = sigma;
	return options;
}

bool same(const std::vector<Polyline>& a, const std::vector<Polyline>& b)
{
	if (a.size() != b.size()) return false;
	for (std::size_t i = 0; i < a.size(); i++)
		if (a[i].points != b[i].points || !(a[i].info == b[i].info)) return false;
	return true;
}

bool same(const RidgeMap& a, const RidgeMap& b)
{
	return same(a.ridges(), b.ridges()) && same(a.walls(), b.walls());
}

/** Measurements that lie anywhere in the box of the hallway. */
std::vector<Measurement> anywhere(std::size_t count, Random& random)
{
	std::vector<Measurement> points(count);
	for (Measurement& m : points)
	{
		m.x = random.uniform(-1, 17);
		m.y = random.uniform(-1, 17);
	}
	return points;
}

/** Number of ridges with a length above sigma on the wall. */
std::string describe(const char* what, const RidgeMap& map)
{
	std::string s = format("%s: ", what);
	for (std::size_t i = 0; i < map.walls().size(); i++)
		s += format("%s%.2f m", i > 0 ? " + " : "", map.walls()[i].length());
	return s + (map.walls().empty() ? "nothing" : "");
}

}  // namespace

Finding permutations(const Setting& setting)
{
	Finding f;
	f.id = "permutations";
	f.title = "Invariance under permutation";
	f.claim = "The result does not depend on the order of the measurements.";
	const int orders = setting.repeat(100, 5);
	Random random(setting.seed + 11);
	std::vector<Measurement> points = driveHallway(150, setting.seed).all();
	RidgeMap first(optionsOf(0.1));
	first.insert(points);
	int differing = 0;
	std::size_t updates = 0;
	for (int i = 0; i < orders; i++)
	{
		random.shuffle(points);
		RidgeMap map(optionsOf(0.1));
		for (std::size_t at = 0; at < points.size();)
		{
			const std::size_t n = std::min(points.size() - at, 1 + random.below(points.size() / 4));
			map.insert({points.begin() + std::ptrdiff_t(at), points.begin() + std::ptrdiff_t(at + n)});
			map.update();
			updates++;
			at += n;
		}
		differing += same(map, first) ? 0 : 1;
	}
	f.result = format(
		"The %zu measurements of the hallway in %d random orders, in batches of random size with an update after each "
		"(%zu "
		"updates): %d of the final maps differ from the first in any bit of any coordinate, of ridges or walls.",
		points.size(), orders, updates, differing);
	f.verdict = differing == 0 ? Verdict::holds : Verdict::differs;
	return f;
}

Finding corrections(const Setting& setting)
{
	Finding f;
	f.id = "corrections";
	f.title = "Correction of wrong early surfaces";
	f.claim = "Wrong surfaces made from early outliers are corrected by later measurements.";
	Random random(setting.seed + 12);
	const std::vector<Measurement> good = driveHallway(150, setting.seed).all();
	// Outliers on a false wall near the true one, and anywhere.
	std::vector<Measurement> bad = anywhere(500, random);
	addWall(bad, {{2, 0.25}, {5, 0.25}}, 40, 0.03, random);
	RidgeMap early(optionsOf(0.1)), late(optionsOf(0.1)), clean(optionsOf(0.1));
	early.insert(bad);
	const auto lengthIn = [](const RidgeMap& map, const Box2& box)
	{
		double sum = 0;
		for (const Polyline& p : clipped(map.walls(), box)) sum += p.length();
		return sum;
	};
	const Box2 falseWall{{2, 0.15}, {5, 0.35}};
	const double before = lengthIn(early, falseWall);
	early.insert(good);
	late.insert(good);
	late.update();
	late.insert(bad);
	clean.insert(good);
	const bool equal = same(early, late);
	const double after = lengthIn(early, falseWall);
	early.erase(bad);
	f.result = format(
		"%zu outliers first (among them a false wall 0.25 m in front of the true one, of which %.2f m are mapped), "
		"then "
		"the %zu good measurements: %.2f m of the false wall are left, and the map is %s the map of the good data with "
		"the same outliers fed last. Erasing the outliers then gives %s the map of the good data alone.",
		bad.size(), before, good.size(), after, equal ? "to the bit" : "NOT",
		same(early, clean) ? "to the bit" : "NOT");
	f.verdict = equal && same(early, clean) && after < 0.1 * before ? Verdict::holds : Verdict::differs;
	return f;
}

Finding changes(const Setting& setting)
{
	Finding f;
	f.id = "changes";
	f.title = "Extension, merging, splitting";
	f.claim = "Extension, merging, splitting and updating of surfaces arise by themselves.";
	Random random(setting.seed + 13);
	const auto piece = [&](double from, double to)
	{
		std::vector<Measurement> points;
		addWall(points, {{from, 0}, {to, 0}}, 200, 0.03, random);
		return points;
	};
	RidgeMap map(optionsOf(0.1));
	std::vector<std::size_t> counts;
	const auto note = [&](const char* what)
	{
		f.result += (f.result.empty() ? "" : "; ") + describe(what, map);
		counts.push_back(map.walls().size());
	};
	const std::vector<Measurement> left = piece(0, 2), more = piece(2, 3), right = piece(5, 8), middle = piece(3, 5);
	map.insert(left);
	note("a piece of wall");
	map.insert(more);
	note("extended");
	map.insert(right);
	note("another piece");
	map.insert(middle);
	note("the gap filled");
	map.erase(more);
	note("a part erased again");
	f.result += ".";
	f.verdict = counts == std::vector<std::size_t>{1, 1, 2, 1, 2} ? Verdict::holds : Verdict::differs;
	return f;
}

}  // namespace ridgemap::apps
