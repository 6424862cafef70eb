// SPDX-License-Identifier: BSD-3-Clause
// Building plans in SVG: whole files, or the data of one path.

#include <stdexcept>

#include "../../apps/ridgemap-import/plan_readers.h"
#include "fuzz_target.h"
#include "text_input.h"

namespace ridgemap::fuzz
{
std::vector<std::vector<std::uint8_t>> seeds()
{
	return {textSeed(0, "M 1 2 L 3 4 H 5 V 6 Z m 1,1 c 1 2 3 4 5 6 s 1 2 3 4 q 1 2 3 4 t 5 6 z"),
			textSeed(1,
					 "<svg width='10mm' viewBox='0 0 100 50'><g id='walls' transform='rotate(30) scale(2,3)'>"
					 "<line x1='1' y1='2' x2='3' y2='4'/><polyline points='1,2 3,4 5,6'/><rect x='1' y='1' width='3' "
					 "height='4'/><polygon points='0,0 1,0 1,1'/><path d='M0 0L1 1'/></g></svg>")};
}
}  // namespace ridgemap::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
	using namespace ridgemap;
	if (size == 0) return 0;
	const std::string text(data + 1, data + size);
	try
	{
		if (data[0] % 2 == 0)
		{
			apps::parseSvgPath(text);
			return 0;
		}
		static const fuzz::ScratchFile file(".svg");
		apps::readSvg(file.with(text), {});
	}
	catch (const std::exception& e)
	{
		fuzz::require(*e.what() != 0, "errors have a message");
	}
	return 0;
}
