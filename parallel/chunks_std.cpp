// SPDX-License-Identifier: BSD-3-Clause
// Chunks on std::jthread, for ThreadSanitizer (the packaged libtbb gives false reports). Workers draw chunk numbers
// from one counter; the first exception is kept and ends the loop.
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "parallel/chunks.hpp"

namespace warren::detail {

void run_chunks(std::size_t chunks, unsigned threads, const void* body, void (*call)(const void*, std::size_t)) {
  std::atomic<std::size_t> next{0};  // each value is handed to one worker
  std::mutex mutex;                  // guards first_error
  std::exception_ptr first_error;
  const auto work = [&] {
    for (std::size_t chunk = next++; chunk < chunks; chunk = next++) {
      try {
        call(body, chunk);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!first_error) first_error = std::current_exception();
        next = chunks;
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    for (unsigned i = 1; i < threads && i < chunks; ++i) workers.emplace_back(work);
    work();
  }
  if (first_error) std::rethrow_exception(first_error);
}

}  // namespace warren::detail
