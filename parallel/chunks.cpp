// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/chunks.hpp"

#include <pthread.h>

#include <array>
#include <cstddef>
#include <new>

#include "parallel/trace.hpp"
#include "parallel/worker_crew.hpp"

namespace warren::detail {
namespace {

alignas(WorkerCrew) std::array<std::byte, sizeof(WorkerCrew)> room;
WorkerCrew& make_crew() { return *new (room.data()) WorkerCrew; }

/// Of the process. Never ended, for other threads may compute while it ends. A forked process begins with a new one:
/// the threads stay with the parent, and one of them may have held the mutex.
WorkerCrew& crew() {
  static WorkerCrew& made = []() -> WorkerCrew& {
    ::pthread_atfork(nullptr, nullptr, [] { make_crew(); });
    return make_crew();
  }();
  return made;
}

}  // namespace

void run_chunks(std::size_t chunks, unsigned threads, const void* body, void (*call)(const void*, std::size_t)) {
  SharedLoop loop(chunks, threads, body, call);
  crew().run(loop);
}

ChunkTrace::ChunkTrace(const Execution& execution) : execution_(execution) {
  if (execution_.trace != nullptr) begin_ = std::chrono::steady_clock::now();
}

void ChunkTrace::end(std::size_t items) {
  execution_.advance(items);
  if (execution_.trace == nullptr) return;
  const char* stage = execution_.progress != nullptr ? execution_.progress->stage() : nullptr;
  execution_.trace->record(stage != nullptr ? stage : "chunk", begin_, std::chrono::steady_clock::now(), false);
}

}  // namespace warren::detail
