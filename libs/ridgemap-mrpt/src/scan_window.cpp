// SPDX-License-Identifier: BSD-3-Clause
#include "scan_window.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>

namespace ridgemap
{
namespace
{
std::uint64_t bitsOf(double v)
{
	std::uint64_t bits;
	std::memcpy(&bits, &v, sizeof(bits));
	return bits;
}

double fromBits(std::uint64_t bits)
{
	double v;
	std::memcpy(&v, &bits, sizeof(v));
	return v;
}

/** The four numbers of each measurement or ray. */
template <class T>
void writeItems(ByteWriter& out, const std::vector<T>& items)
{
	out.number(items.size());
	for (const T& item : items)
		for (const double v : {item.x, item.y, item.sensorX, item.sensorY}) out.number(bitsOf(v));
}

template <class T>
std::vector<T> readItems(ByteReader& in)
{
	std::vector<T> items(in.count(4));
	for (T& item : items)
		for (double* v : {&item.x, &item.y, &item.sensorX, &item.sensorY}) *v = fromBits(in.number());
	return items;
}

/** Equal bits: an unknown sensor equals another. */
template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b)
{
	const auto equal = [](const T& p, const T& q)
	{
		return bitsOf(p.x) == bitsOf(q.x) && bitsOf(p.y) == bitsOf(q.y) && bitsOf(p.sensorX) == bitsOf(q.sensorX) &&
			   bitsOf(p.sensorY) == bitsOf(q.sensorY);
	};
	return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal);
}

bool sameContent(const ObservedScan& a, const ObservedScan& b)
{
	return same(a.measurements, b.measurements) && same(a.freeRays, b.freeRays);
}
}  // namespace

std::vector<const ObservedScan*> ScanWindow::outdatedBy(const ObservedScan& scan, unsigned keepScans,
														double keepSeconds) const
{
	std::vector<const ObservedScan*> all;
	for (const ObservedScan& s : scans_) all.push_back(&s);
	all.push_back(&scan);
	const auto firstKept = all.begin() + (keepScans > 0 && all.size() > keepScans ? long(all.size() - keepScans) : 0);
	if (!(keepSeconds > 0)) return {all.begin(), firstKept};
	double newest = -std::numeric_limits<double>::infinity();
	for (auto s = firstKept; s != all.end(); ++s) newest = std::max(newest, (*s)->time);
	// Observations of several sensors need not come in the order of their times.
	const auto end = std::stable_partition(firstKept, all.end(),
										   [&](const ObservedScan* s) { return !(s->time >= newest - keepSeconds); });
	return {all.begin(), end};
}

void ScanWindow::push(const ObservedScan& scan, unsigned keepScans, double keepSeconds)
{
	auto outdated = outdatedBy(scan, keepScans, keepSeconds);
	std::sort(outdated.begin(), outdated.end(), std::less<>());
	const auto isOutdated = [&](const ObservedScan* s)
	{ return std::binary_search(outdated.begin(), outdated.end(), s, std::less<>()); };
	std::deque<ObservedScan> kept;
	for (ObservedScan& s : scans_)
		if (!isOutdated(&s)) kept.push_back(std::move(s));
	if (!isOutdated(&scan)) kept.push_back(scan);
	scans_ = std::move(kept);
}

std::deque<ObservedScan>::iterator ScanWindow::find(const ObservedScan& scan)
{
	return std::find_if(scans_.begin(), scans_.end(), [&](const ObservedScan& s) { return sameContent(s, scan); });
}

void ScanWindow::forget(const ObservedScan& scan)
{
	const auto found = find(scan);
	if (found != scans_.end()) scans_.erase(found);
}

void ScanWindow::replace(const ObservedScan& before, ObservedScan after)
{
	const auto found = find(before);
	if (found == scans_.end()) return;
	after.time = found->time;
	*found = std::move(after);
}

bool ScanWindow::operator==(const ScanWindow& o) const
{
	const auto equal = [](const ObservedScan& a, const ObservedScan& b)
	{ return bitsOf(a.time) == bitsOf(b.time) && sameContent(a, b); };
	return std::equal(scans_.begin(), scans_.end(), o.scans_.begin(), o.scans_.end(), equal);
}

void ScanWindow::write(ByteWriter& out) const
{
	out.number(scans_.size());
	for (const ObservedScan& s : scans_)
	{
		out.number(bitsOf(s.time));
		writeItems(out, s.measurements);
		writeItems(out, s.freeRays);
	}
}

ScanWindow ScanWindow::read(ByteReader& in)
{
	ScanWindow window;
	for (std::size_t n = in.count(3); n > 0; n--)
	{
		ObservedScan s;
		s.time = fromBits(in.number());
		s.measurements = readItems<Measurement>(in);
		s.freeRays = readItems<FreeRay>(in);
		window.scans_.push_back(std::move(s));
	}
	return window;
}

}  // namespace ridgemap
