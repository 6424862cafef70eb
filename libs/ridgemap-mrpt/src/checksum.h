// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace ridgemap
{
/** CRC-32 as in zlib and PNG, eight bytes at a time: the bytewise
 * loop of mrpt::system::compute_CRC32() takes longer than all the rest. */
std::uint32_t crc32(const std::uint8_t* data, std::size_t size);

}  // namespace ridgemap
