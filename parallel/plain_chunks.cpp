// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/plain_chunks.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <latch>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace warren::detail {
namespace {

/// Starts `wanted` threads that run `work`, or as many as the system makes. They are joined with the vector.
std::vector<std::jthread> started(std::size_t wanted, const auto& work) {
  std::vector<std::jthread> threads;
  try {
    threads.reserve(wanted);
    while (threads.size() < wanted) threads.emplace_back([&work] { work(); });
  } catch (const std::system_error&) {  // no more threads now
  } catch (const std::bad_alloc&) {     // nor memory for them
  }
  return threads;
}

}  // namespace

unsigned possible_threads(unsigned wanted) {
  std::latch tried(1);
  const auto wait = [&] { tried.wait(); };
  const std::vector<std::jthread> threads = started(wanted, wait);
  tried.count_down();
  return static_cast<unsigned>(threads.size());
}

void run_plain_chunks(std::size_t chunks, unsigned threads, const void* body, void (*call)(const void*, std::size_t)) {
  std::atomic<std::size_t> next{0};  // each value is handed to one thread
  std::mutex mutex;                  // guards error
  std::exception_ptr error;
  const auto work = [&] {
    for (std::size_t chunk = next++; chunk < chunks; chunk = next++) {
      try {
        call(body, chunk);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
        next = chunks;
      }
    }
  };
  {
    const auto helpers = started(std::min<std::size_t>(threads, chunks) - 1, work);
    work();
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace warren::detail
