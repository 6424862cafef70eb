// SPDX-License-Identifier: BSD-3-Clause
// What fuzz targets share that read text from files.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace ridgemap::fuzz
{
/** A seed: text behind the byte that chooses its reader. */
inline std::vector<std::uint8_t> textSeed(char kind, const std::string& text)
{
	std::vector<std::uint8_t> bytes(text.begin(), text.end());
	bytes.insert(bytes.begin(), std::uint8_t(kind));
	return bytes;
}

/** A file of this process that goes with it. */
class ScratchFile
{
 public:
	explicit ScratchFile(const std::string& extension)
		: path_("/tmp/ridgemap-fuzz-" + std::to_string(getpid()) + extension)
	{
	}
	~ScratchFile() { std::remove(path_.c_str()); }
	ScratchFile(const ScratchFile&) = delete;
	ScratchFile& operator=(const ScratchFile&) = delete;

	/** Its path, after it was written anew. */
	const std::string& with(const std::string& text) const
	{
		std::ofstream(path_, std::ios::binary | std::ios::trunc) << text;
		return path_;
	}

 private:
	std::string path_;
};

}  // namespace ridgemap::fuzz
