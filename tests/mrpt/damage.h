// SPDX-License-Identifier: BSD-3-Clause
// Stored maps taken apart, changed and put together again.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace ridgemap::test
{
using Bytes = std::vector<std::uint8_t>;

/** A stored map: header of MRPT (length and name of the class, version), size, content, CRC-32, closing byte. */
struct StoredMap
{
	std::uint8_t version = 0;
	Bytes content;

	static std::size_t headerSize() { return 1 + className().size() + 1; }
	static std::string className() { return "ridgemap::CRidgeMap2D"; }

	/** Takes what bytesOf() gave apart. */
	static StoredMap open(const Bytes& bytes)
	{
		const std::size_t around = headerSize() + 8 + 4 + 1;
		if (bytes.size() < around) throw std::logic_error("this is no stored map");
		const auto first = bytes.begin() + long(headerSize() + 8);
		return {bytes[headerSize() - 1], Bytes(first, first + long(bytes.size() - around))};
	}

	/** With a size and a CRC-32 that fit the content. */
	Bytes sealed() const
	{
		Bytes out;
		out.push_back(std::uint8_t(0x80 | className().size()));
		for (const char c : className()) out.push_back(std::uint8_t(c));
		out.push_back(version);
		append(out, content.size(), 8);
		out.insert(out.end(), content.begin(), content.end());
		append(out, slowCrc32(content), 4);
		out.push_back(0x88);
		return out;
	}

 private:
	static void append(Bytes& out, std::uint64_t v, int bytes)
	{
		for (int i = 0; i < bytes; i++) out.push_back(std::uint8_t(v >> (8 * i)));
	}

	/** Bit by bit from the definition: an oracle for the fast one, too. */
	static std::uint32_t slowCrc32(const Bytes& bytes)
	{
		std::uint32_t crc = 0xffffffffu;
		for (const std::uint8_t b : bytes)
		{
			crc ^= b;
			for (int i = 0; i < 8; i++) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
		}
		return ~crc;
	}
};

/** A number as stored maps hold it: seven bits a byte, lowest first. */
inline Bytes varint(std::uint64_t v)
{
	Bytes out;
	for (; v >= 0x80; v >>= 7) out.push_back(std::uint8_t(v | 0x80));
	out.push_back(std::uint8_t(v));
	return out;
}

/** How often to repeat something: the default in quick runs, more where the environment says so. */
inline int repetitions(const char* variable, int byDefault)
{
	const char* text = std::getenv(variable);
	return text != nullptr && std::atoi(text) > 0 ? std::atoi(text) : byDefault;
}

}  // namespace ridgemap::test
