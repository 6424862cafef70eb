// SPDX-License-Identifier: BSD-3-Clause
// What a fuzz target is: libFuzzer's function. Run by libFuzzer where clang builds it (RIDGEMAP_FUZZ), and by
// corpus_runner.cpp everywhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace ridgemap::fuzz
{
/** Inputs to start from; each target has its own. */
std::vector<std::vector<std::uint8_t>> seeds();

/** A broken promise ends the program, so that the fuzzer keeps the input. */
inline void require(bool holds, const char* what)
{
	if (holds) return;
	std::fprintf(stderr, "broken: %s\n", what);
	std::abort();
}

/** Takes numbers off the input; zeros at its end. */
class Input
{
 public:
	Input(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
	bool empty() const { return at_ == end_; }
	std::uint8_t byte() { return empty() ? 0 : *at_++; }
	std::uint16_t word() { return std::uint16_t(byte() | byte() << 8); }

 private:
	const std::uint8_t *at_, *end_;
};

}  // namespace ridgemap::fuzz
