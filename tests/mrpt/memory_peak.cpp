// SPDX-License-Identifier: BSD-3-Clause
#include "memory_peak.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace
{
std::atomic<std::size_t> held{0}, peak{0}, start{0};

// The sanitizers bring allocators of their own, which must see all that is taken and given back: nothing is counted
// then.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
void* counted(void* p)
{
	if (p == nullptr) return nullptr;
	const std::size_t now = held += malloc_usable_size(p);
	for (std::size_t seen = peak; now > seen && !peak.compare_exchange_weak(seen, now);) continue;
	return p;
}

void release(void* p)
{
	if (p == nullptr) return;
	held -= malloc_usable_size(p);
	std::free(p);
}
#endif
}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

void* operator new(std::size_t n)
{
	if (void* p = counted(std::malloc(n))) return p;
	throw std::bad_alloc();
}
void* operator new(std::size_t n, std::align_val_t alignment)
{
	const auto a = std::size_t(alignment);
	if (void* p = counted(std::aligned_alloc(a, (n + a - 1) / a * a))) return p;
	throw std::bad_alloc();
}
void operator delete(void* p) noexcept
{
	release(p);
}
void operator delete(void* p, std::size_t) noexcept
{
	release(p);
}
void operator delete(void* p, std::align_val_t) noexcept
{
	release(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept
{
	release(p);
}
#endif

namespace ridgemap::test
{
void restartMemoryPeak()
{
	start = held.load();
	peak = held.load();
}

std::size_t memoryPeak()
{
	return peak - start;
}

}  // namespace ridgemap::test
