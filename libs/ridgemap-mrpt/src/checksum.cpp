// SPDX-License-Identifier: BSD-3-Clause
#include "checksum.h"

#include <array>

namespace ridgemap
{
namespace
{
using Tables = std::array<std::array<std::uint32_t, 256>, 8>;

Tables makeTables()
{
	Tables t{};
	for (std::uint32_t i = 0; i < 256; i++)
	{
		std::uint32_t c = i;
		for (int bit = 0; bit < 8; bit++) c = (c >> 1) ^ ((c & 1) ? 0xEDB88320u : 0u);
		t[0][i] = c;
	}
	for (std::uint32_t i = 0; i < 256; i++)
		for (std::size_t k = 1; k < t.size(); k++) t[k][i] = (t[k - 1][i] >> 8) ^ t[0][t[k - 1][i] & 0xff];
	return t;
}
}  // namespace

std::uint32_t crc32(const std::uint8_t* data, std::size_t size)
{
	static const Tables t = makeTables();
	std::uint32_t c = 0xffffffffu;
	for (; size >= 8; size -= 8, data += 8)
	{
		const std::uint32_t low = c ^ (data[0] | data[1] << 8 | data[2] << 16 | std::uint32_t(data[3]) << 24);
		c = t[7][low & 0xff] ^ t[6][low >> 8 & 0xff] ^ t[5][low >> 16 & 0xff] ^ t[4][low >> 24] ^ t[3][data[4]] ^
			t[2][data[5]] ^ t[1][data[6]] ^ t[0][data[7]];
	}
	for (; size > 0; size--, data++) c = (c >> 8) ^ t[0][(c ^ *data) & 0xff];
	return ~c;
}

}  // namespace ridgemap
