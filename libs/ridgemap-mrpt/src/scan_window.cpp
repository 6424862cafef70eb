// SPDX-License-Identifier: BSD-3-Clause
#include "scan_window.h"

#include <algorithm>
#include <cstring>
#include <iterator>

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

std::vector<ObservedScan> ScanWindow::push(ObservedScan scan, unsigned keepScans, double keepSeconds)
{
	scans_.push_back(std::move(scan));
	std::vector<ObservedScan> old;
	while (keepScans > 0 && scans_.size() > keepScans)
	{
		old.push_back(std::move(scans_.front()));
		scans_.pop_front();
	}
	if (!(keepSeconds > 0)) return old;
	double newest = scans_.front().time;
	for (const ObservedScan& s : scans_) newest = std::max(newest, s.time);
	// Observations of several sensors need not come in the order of their times.
	const auto kept = std::stable_partition(scans_.begin(), scans_.end(),
											[&](const ObservedScan& s) { return s.time >= newest - keepSeconds; });
	std::move(kept, scans_.end(), std::back_inserter(old));
	scans_.erase(kept, scans_.end());
	return old;
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
