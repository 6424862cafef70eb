// SPDX-License-Identifier: BSD-3-Clause
// Results of pure functions of lines, kept by the identity of the lines.
#pragma once

#include <ridgemap/types.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <unordered_map>
#include <vector>

namespace ridgemap
{
/** A line that never changes: equal pointers mean equal lines. */
using LinePtr = std::shared_ptr<const Polyline>;
using Lines = std::vector<LinePtr>;

/** Arguments of a function: lines by their identity, everything else by its bits. */
class MemoKey
{
 public:
	MemoKey& add(const LinePtr& line)
	{
		lines_.push_back(line);
		words_.push_back(std::uint64_t(reinterpret_cast<std::uintptr_t>(line.get())));
		return *this;
	}
	MemoKey& add(double v)
	{
		std::uint64_t bits;
		std::memcpy(&bits, &v, sizeof bits);
		words_.push_back(bits);
		return *this;
	}
	MemoKey& add(bool v)
	{
		words_.push_back(v);
		return *this;
	}
	bool operator==(const MemoKey& o) const { return words_ == o.words_; }
	struct Hash
	{
		std::size_t operator()(const MemoKey& k) const
		{
			std::uint64_t h = 0;
			for (const std::uint64_t w : k.words_) h = (h ^ w) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
			return std::size_t(h);
		}
	};

 private:
	std::vector<std::uint64_t> words_;
	Lines lines_;  ///< kept alive, so that their addresses name nothing else
};

/** Remembers results as long as they are asked for between two calls of forgetUnused(). */
template <class Value>
class Memo
{
 public:
	template <class Fn>
	const Value& get(MemoKey key, Fn compute)
	{
		auto found = entries_.find(key);
		if (found == entries_.end())
		{
			computed_++;
			found = entries_.emplace(std::move(key), Entry{compute()}).first;
		}
		Entry& e = found->second;
		e.used = true;
		return e.value;
	}

	/** Number of results that were computed so far. */
	std::size_t computed() const { return computed_; }

	void forgetUnused()
	{
		for (auto it = entries_.begin(); it != entries_.end();)
			if (it->second.used)
			{
				it->second.used = false;
				++it;
			}
			else
				it = entries_.erase(it);
	}

 private:
	struct Entry
	{
		Value value;
		bool used = false;
	};
	std::unordered_map<MemoKey, Entry, MemoKey::Hash> entries_;
	std::size_t computed_ = 0;
};

}  // namespace ridgemap
