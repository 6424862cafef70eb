// SPDX-License-Identifier: BSD-3-Clause
// What changes a ridge map; what asks it is in ridge_map_queries.cpp.
#include <ridgemap/ridge_map.h>

#include <algorithm>
#include <set>

#include "ridge_map_impl.h"

namespace ridgemap
{
namespace
{
/** Does both or, if the first throws, only what makes up for what was done before. */
template <class Change, class Undo>
void undoIfThrown(Change change, Undo undo)
{
	try
	{
		change();
	}
	catch (...)
	{
		undo();
		throw;
	}
}
}  // namespace

StepTimes& StepTimes::operator+=(const StepTimes& o)
{
	kernels += o.kernels;
	borders += o.borders;
	crossings += o.crossings;
	seeds += o.seeds;
	chains += o.chains;
	return *this;
}

UpdateResult& UpdateResult::operator+=(const UpdateResult& o)
{
	regions.insert(regions.end(), o.regions.begin(), o.regions.end());
	// What appeared and vanished again in between is nobody's business.
	const std::set<PolylineId> ours(appeared.begin(), appeared.end());
	std::set<PolylineId> passing;
	for (const PolylineId id : o.vanished) (ours.count(id) ? (void)passing.insert(id) : vanished.push_back(id));
	appeared.erase(
		std::remove_if(appeared.begin(), appeared.end(), [&](PolylineId id) { return passing.count(id) > 0; }),
		appeared.end());
	appeared.insert(appeared.end(), o.appeared.begin(), o.appeared.end());
	for (std::size_t i = 0; i < stops.size(); i++) stops[i] += o.stops[i];
	tiles += o.tiles;
	evaluations += o.evaluations;
	kernels += o.kernels;
	seeds += o.seeds;
	traces += o.traces;
	seconds += o.seconds;
	return *this;
}

RidgeMap::RidgeMap(const Options& options) : impl_(std::make_unique<Impl>(options)) {}
RidgeMap::~RidgeMap() = default;
RidgeMap::RidgeMap(const RidgeMap& o)
{
	const std::lock_guard<std::mutex> lock(o.impl_->mutex);
	impl_ = std::make_unique<Impl>(*o.impl_);
}
RidgeMap& RidgeMap::operator=(const RidgeMap& o)
{
	if (this != &o) *this = RidgeMap(o);
	return *this;
}
RidgeMap::RidgeMap(RidgeMap&&) noexcept = default;
RidgeMap& RidgeMap::operator=(RidgeMap&&) noexcept = default;

const Options& RidgeMap::options() const
{
	return impl_->options;
}

void RidgeMap::insert(const std::vector<Measurement>& measurements)
{
	// First what can be undone without a doubt.
	impl_->freeSpace.insert(measurements);
	undoIfThrown([&] { impl_->lattice.insert(measurements); }, [&] { impl_->freeSpace.erase(measurements); });
	impl_->changed();
}

void RidgeMap::erase(const std::vector<Measurement>& measurements)
{
	impl_->freeSpace.erase(measurements);
	undoIfThrown([&] { impl_->lattice.erase(measurements); }, [&] { impl_->freeSpace.insert(measurements); });
	impl_->changed();
}

void RidgeMap::insertFreeRays(const std::vector<FreeRay>& rays)
{
	impl_->freeSpace.insert(rays);
	impl_->changed();
}

void RidgeMap::eraseFreeRays(const std::vector<FreeRay>& rays)
{
	impl_->freeSpace.erase(rays);
	impl_->changed();
}

void RidgeMap::merge(const RidgeMap& other)
{
	impl_->requireSameOptions(*other.impl_, "merge with");
	{
		const std::lock_guard<std::mutex> lock(other.impl_->mutex);
		const FreeSpace theirs = other.impl_->freeSpace;
		impl_->freeSpace.merge(theirs);
		undoIfThrown([&] { impl_->lattice.merge(other.impl_->lattice); }, [&] { impl_->freeSpace.subtract(theirs); });
	}
	impl_->changed();
}

void RidgeMap::subtract(const RidgeMap& other)
{
	impl_->requireSameOptions(*other.impl_, "subtract");
	{
		const std::lock_guard<std::mutex> lock(other.impl_->mutex);
		const FreeSpace theirs = other.impl_->freeSpace;
		impl_->freeSpace.subtract(theirs);
		undoIfThrown([&] { impl_->lattice.subtract(other.impl_->lattice); }, [&] { impl_->freeSpace.merge(theirs); });
	}
	impl_->changed();
}

void RidgeMap::clear()
{
	impl_->lattice.clear();
	impl_->freeSpace.clear();
	impl_->chains.clear();
	impl_->changed();
}

bool RidgeMap::empty() const
{
	return impl_->lattice.measurements() == 0 && impl_->freeSpace.empty();
}

UpdateResult RidgeMap::update(unsigned threads)
{
	const std::lock_guard<std::mutex> lock(impl_->mutex);
	UpdateResult result = std::move(impl_->untold);
	impl_->untold = UpdateResult();
	result += impl_->update(threads);
	return result;
}

void RidgeMap::setThreads(unsigned threads)
{
	impl_->threads = threads > 0 ? threads : 1;
}

void RidgeMap::insertCells(const std::vector<CellRecord>& cells)
{
	impl_->lattice.insertCells(cells);
	impl_->changed();
}

void RidgeMap::insertFreeCells(const std::vector<FreeCellRecord>& cells)
{
	impl_->freeSpace.insertCells(cells);
	impl_->changed();
}

}  // namespace ridgemap
