// SPDX-License-Identifier: BSD-3-Clause
// Chunks on oneTBB. Each calling thread keeps the arena of its last loop: workers that have just run dry still look for
// work there when the next loop comes at once.
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <optional>

#include "parallel/chunks.hpp"

namespace warren::detail {
namespace {

/// An arena that is used for one loop at a time; a loop inside of a loop gets one of its own.
class Arena {
 public:
  void run(unsigned threads, const auto& loop) {
    const auto count = static_cast<int>(threads);
    if (busy_) {
      tbb::task_arena(count).execute(loop);
      return;
    }
    if (!arena_ || arena_->max_concurrency() != count) arena_.emplace(count);
    const InUse in_use(busy_);
    arena_->execute(loop);
  }

 private:
  class InUse {
   public:
    explicit InUse(bool& busy) : busy_(busy) { busy_ = true; }
    ~InUse() { busy_ = false; }
    InUse(const InUse&) = delete;
    InUse& operator=(const InUse&) = delete;

   private:
    bool& busy_;
  };

  std::optional<tbb::task_arena> arena_;
  bool busy_ = false;
};

}  // namespace

void run_chunks(std::size_t chunks, unsigned threads, const void* body, void (*call)(const void*, std::size_t)) {
  constexpr auto parallelism = tbb::global_control::max_allowed_parallelism;
  const tbb::global_control limit(parallelism, threads);  // so that eight are eight even on a two-core machine
  thread_local Arena arena;
  arena.run(threads, [&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, chunks, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t chunk = range.begin(); chunk != range.end(); ++chunk) call(body, chunk);
        },
        tbb::simple_partitioner());
  });
}

}  // namespace warren::detail
