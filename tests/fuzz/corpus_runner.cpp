// SPDX-License-Identifier: BSD-3-Clause
// Runs a fuzz target without libFuzzer: on its seeds, on the files given, and on random changes of both.
//   TARGET [-runs=N] [-seed=N] [-write=DIRECTORY] [FILE...]
// With -write, the seeds are written as files for libFuzzer, and nothing is run.
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "fuzz_target.h"

namespace
{
using Bytes = std::vector<std::uint8_t>;

/** A few of the changes that fuzzers make: bits, bytes, cuts, repeats, numbers at the edges, parts of others. */
Bytes changed(Bytes bytes, const std::vector<Bytes>& all, std::mt19937& random)
{
	const auto below = [&](std::size_t n) { return n == 0 ? 0 : std::size_t(random() % n); };
	for (std::size_t n = 1 + below(4); n > 0; n--)
	{
		const std::size_t at = below(bytes.size());
		switch (below(7))
		{
			case 0:
				if (!bytes.empty()) bytes[at] ^= std::uint8_t(1u << below(8));
				break;
			case 1:
				if (!bytes.empty()) bytes[at] = std::uint8_t(random());
				break;
			case 2:
				bytes.resize(at);
				break;
			case 3:
				bytes.insert(bytes.begin() + long(at), 1 + below(10), std::uint8_t(below(3) == 0 ? 0xff : random()));
				break;
			case 4:
				bytes.erase(bytes.begin() + long(at), bytes.begin() + long(at + below(bytes.size() - at)));
				break;
			case 5:
			{
				const Bytes part(bytes.begin() + long(at), bytes.begin() + long(at + below(bytes.size() - at)));
				bytes.insert(bytes.begin() + long(below(bytes.size())), part.begin(), part.end());
				break;
			}
			default:
			{
				const Bytes& other = all[below(all.size())];
				const std::size_t from = below(other.size());
				bytes.resize(at);
				bytes.insert(bytes.end(), other.begin() + long(from), other.end());
			}
		}
		if (bytes.size() > 20000) bytes.resize(20000);
	}
	return bytes;
}

/** An input that takes longer than this [s] is taken for one without end: SIGALRM ends the program. */
constexpr unsigned longest = 100;

void runOne(const Bytes& bytes)
{
	alarm(longest);
	LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
	alarm(0);
}

int writeSeeds(const std::string& directory)
{
	int n = 0;
	for (const Bytes& bytes : ridgemap::fuzz::seeds())
		std::ofstream(directory + "/seed-" + std::to_string(n++), std::ios::binary)
			.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
	return n == 0;
}
}  // namespace

int main(int argc, char** argv)
{
	long runs = 1000;
	unsigned seed = 1;
	std::vector<Bytes> corpus = ridgemap::fuzz::seeds();
	for (int i = 1; i < argc; i++)
		if (std::strncmp(argv[i], "-runs=", 6) == 0)
			runs = std::atol(argv[i] + 6);
		else if (std::strncmp(argv[i], "-seed=", 6) == 0)
			seed = unsigned(std::atol(argv[i] + 6));
		else if (std::strncmp(argv[i], "-write=", 7) == 0)
			return writeSeeds(argv[i] + 7);
		else
		{
			std::ifstream in(argv[i], std::ios::binary);
			corpus.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
		}
	corpus.emplace_back();
	for (const Bytes& bytes : corpus) runOne(bytes);
	for (long run = 0; run < runs; run++)
	{
		// Each run has a generator of its own, so that one can be repeated alone.
		std::mt19937 random(seed + unsigned(run));
		runOne(changed(corpus[random() % corpus.size()], corpus, random));
	}
	std::printf("%zu seeds and %ld random inputs, seeds %u to %ld\n", corpus.size(), runs, seed, long(seed) + runs - 1);
	return 0;
}
