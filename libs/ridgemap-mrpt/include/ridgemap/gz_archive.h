// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>
#include <ridgemap/atomic_file.h>

#include <functional>

namespace ridgemap
{
/** Writes a compressed archive, byte for byte as MRPT's CFileGZOutputStream does, but notices when the disk is full:
 * that stream forgets what zlib reports when it closes.
 * @param file to be filled; it is not committed here
 * @param write is called once with the archive
 * Throws std::runtime_error naming the path and the cause. */
void writeGzArchive(AtomicFile& file, const std::function<void(mrpt::serialization::CArchive&)>& write);

}  // namespace ridgemap
