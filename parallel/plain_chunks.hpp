// SPDX-License-Identifier: BSD-3-Clause
// Loops on threads of their own, for the thread sanitizer (Debian's oneTBB gives it false reports) and for forked
// processes. Some tens of microseconds a thread and loop.
#pragma once

#include <cstddef>

namespace warren::detail {

/// How many threads of `wanted` the system makes now, side by side; 0 to wanted.
unsigned possible_threads(unsigned wanted);

/// As run_chunks of chunks.hpp: on up to `threads` threads, on fewer where the system makes no more.
void run_plain_chunks(std::size_t chunks, unsigned threads, const void* body, void (*call)(const void*, std::size_t));

}  // namespace warren::detail
