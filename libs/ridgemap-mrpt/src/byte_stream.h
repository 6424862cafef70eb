// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace ridgemap
{
/** Numbers and strings as bytes, the same on every machine: integers as seven bits a byte, lowest first. */
class ByteWriter
{
 public:
	void byte(std::uint8_t v) { bytes_.push_back(v); }

	void number(std::uint64_t v)
	{
		for (; v >= 0x80; v >>= 7) byte(std::uint8_t(v | 0x80));
		byte(std::uint8_t(v));
	}

	/** Small magnitudes of either sign become short. */
	void signedNumber(std::int64_t v) { number((std::uint64_t(v) << 1) ^ std::uint64_t(v >> 63)); }

	void text(const std::string& s)
	{
		number(s.size());
		bytes_.insert(bytes_.end(), s.begin(), s.end());
	}

	std::vector<std::uint8_t>& bytes() { return bytes_; }

 private:
	std::vector<std::uint8_t> bytes_;
};

/** Reads what ByteWriter wrote; throws std::runtime_error instead of reading beyond the end. */
class ByteReader
{
 public:
	explicit ByteReader(const std::vector<std::uint8_t>& bytes) : at_(bytes.data()), end_(at_ + bytes.size()) {}

	std::size_t left() const { return std::size_t(end_ - at_); }

	std::uint8_t byte()
	{
		if (at_ == end_) throw std::runtime_error("stored ridge map: the data end too early");
		return *at_++;
	}

	std::uint64_t number()
	{
		std::uint64_t v = 0;
		for (unsigned shift = 0; shift < 64; shift += 7)
		{
			const std::uint64_t b = byte();
			if (shift == 63 && b > 1) break;
			v |= (b & 0x7f) << shift;
			if (b < 0x80) return v;
		}
		throw std::runtime_error("stored ridge map: a number is out of range");
	}

	std::int64_t signedNumber()
	{
		const std::uint64_t v = number();
		return std::int64_t(v >> 1) ^ -std::int64_t(v & 1);
	}

	/** A number of things that take at least `bytesEach` bytes each: never more than the data can hold. */
	std::size_t count(std::size_t bytesEach)
	{
		const std::uint64_t n = number();
		if (n > left() / bytesEach) throw std::runtime_error("stored ridge map: a count is greater than the data");
		return std::size_t(n);
	}

	std::string text()
	{
		const std::size_t n = count(1);
		std::string s(reinterpret_cast<const char*>(at_), n);
		at_ += n;
		return s;
	}

 private:
	const std::uint8_t *at_, *end_;
};

}  // namespace ridgemap
