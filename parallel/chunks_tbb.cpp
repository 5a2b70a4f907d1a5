// SPDX-License-Identifier: BSD-3-Clause
// Chunks on oneTBB. A global_control is held for the loop, so that eight threads are eight even on a two-core machine.
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "parallel/chunks.hpp"

namespace warren::detail {

void run_chunks(std::size_t chunks, unsigned threads, const void* body, void (*call)(const void*, std::size_t)) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, chunks, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t chunk = range.begin(); chunk != range.end(); ++chunk) call(body, chunk);
        },
        tbb::simple_partitioner());
  });
}

}  // namespace warren::detail
