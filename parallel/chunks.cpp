// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/chunks.hpp"

#include "parallel/trace.hpp"
#include "parallel/worker_crew.hpp"

namespace warren::detail {

void run_chunks(std::size_t chunks, unsigned threads, const void* body, void (*call)(const void*, std::size_t)) {
  static WorkerCrew crew;
  SharedLoop loop(chunks, threads, body, call);
  crew.run(loop);
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
