// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>

namespace ridgemap
{
/** Whether others hold what this pointer holds. If not, nobody else can come to hold it, and what others did with it
 * before they let go of it has been done: it may be changed. */
template <class T>
bool isShared(const std::shared_ptr<T>& pointer)
{
	if (pointer.use_count() > 1) return true;
#ifdef __SANITIZE_THREAD__
	std::shared_ptr<T>(pointer).reset();  // the sanitizer knows no fences
#else
	std::atomic_thread_fence(std::memory_order_acquire);  // pairs with the release of the last other holder
#endif
	return false;
}

/** What this pointer holds, for a change: others keep what they hold. */
template <class T>
T& own(std::shared_ptr<T>& pointer)
{
	if (isShared(pointer)) pointer = std::make_shared<T>(*pointer);
	return *pointer;
}

}  // namespace ridgemap
