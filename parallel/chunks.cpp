// SPDX-License-Identifier: BSD-3-Clause
// Loops on oneTBB. It makes its threads on threads, where nobody can catch that the system makes none, and ends the
// program then. So at the first loop plain threads are tried; oneTBB may have as many as came, and makes them at once,
// one by one and on this thread, and none later. Where it can't, loops run on their callers alone.
// A forked process has none of the threads of its parent: its loops are plain ones.
#include "parallel/chunks.hpp"

#include <pthread.h>

#include <atomic>
#include <exception>
#include <latch>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

#include "core/run/trace.hpp"

#ifndef WARREN_PLAIN_CHUNKS
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <optional>
#endif

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

void run_plain_chunks(std::size_t chunks, unsigned threads, FunctionRef<void(std::size_t)> run) {
  std::atomic<std::size_t> next{0};  // each value is handed to one thread
  std::mutex mutex;                  // guards error
  std::exception_ptr error;
  const auto work = [&] {
    for (std::size_t chunk = next++; chunk < chunks; chunk = next++) {
      try {
        run(chunk);
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

#ifdef WARREN_PLAIN_CHUNKS
void run_chunks(std::size_t chunks, unsigned threads, FunctionRef<void(std::size_t)> run) {
  run_plain_chunks(chunks, threads, run);
}
#else
namespace {

/// How many threads of `wanted` the system makes now, side by side; 0 to wanted.
unsigned possible_threads(unsigned wanted) {
  std::latch tried(1);
  const auto wait = [&] { tried.wait(); };
  const std::vector<std::jthread> threads = started(wanted, wait);
  tried.count_down();
  return static_cast<unsigned>(threads.size());
}

/// The threads of the process that help with loops. Never ended, for other threads may compute while the program ends.
class Helpers {
 public:
  /// On how many threads of oneTBB a loop runs that asks for so many, its caller among them; 0: it must make its own,
  /// for nobody has tried so many. The first loop says how many there will be, all cores at least: oneTBB starts
  /// threads wherever its limit is raised, also where nothing may be thrown.
  unsigned usable(unsigned threads) {
    const std::lock_guard lock(mutex_);  // call_once ends the program where it has no memory to pass on what is thrown
    if (tried_ == 0) {
      const unsigned asked = std::max(threads, thread_count(0));
      const unsigned possible = has_room() ? possible_threads(asked - 1) : 0;
      came_ = possible > 0 && make(possible) ? possible : 0;
      tried_ = asked;
    }
    return threads > tried_ ? 0 : std::min(threads, came_ + 1);
  }

 private:
  /// Is there memory for what oneTBB takes at its first use? Some of it is asked for where nobody can say no.
  static bool has_room() {
    constexpr std::size_t bytes = std::size_t{1} << 20;
    void* volatile room = std::malloc(bytes);  // a call that is not left out
    std::free(room);
    return room != nullptr;
  }
  /// Has oneTBB make so many threads. It makes one where a task waits and all others are held by tasks of their own,
  /// and makes it here, where what it throws is caught. False, after which it must not be called, where the system made
  /// fewer, or took more than a second for one.
  bool make(unsigned count) {
    struct Roll {
      std::atomic<unsigned> there{0};
      std::atomic<bool> is_over{false};
      std::atomic<unsigned> gone{0};
    };
    auto roll = std::make_unique<Roll>();
    std::vector<std::unique_ptr<tbb::task_arena> > arenas;
    const auto comes = [](const std::atomic<unsigned>& number, unsigned least) {
      const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(1);
      while (number < least && std::chrono::steady_clock::now() < last) {
        std::this_thread::sleep_for(std::chrono::microseconds(10));
      }
      return number >= least;
    };
    bool is_made = true;
    try {
      limit_.emplace(tbb::global_control::max_allowed_parallelism, count + 1);  // also above the number of cores
      for (unsigned i = 1; i <= count && is_made; ++i) {
        arenas.push_back(std::make_unique<tbb::task_arena>(1, 0));
        arenas.back()->enqueue([roll = roll.get()] {
          ++roll->there;
          roll->is_over.wait(false);
          ++roll->gone;
        });
        is_made = comes(roll->there, i);
      }
    } catch (const std::exception&) {
      is_made = false;
    }
    roll->is_over = true;
    roll->is_over.notify_all();
    if (!comes(roll->gone, is_made ? count : roll->there.load()) || !is_made) {  // a task may still come to its roll
      static_cast<void>(roll.release());
      for (auto& arena : arenas) static_cast<void>(arena.release());
    }
    return is_made;
  }

  std::mutex mutex_;    // guards what follows
  unsigned tried_ = 0;  // 0: not yet
  unsigned came_ = 0;
  std::optional<tbb::global_control> limit_;
};

std::atomic<bool> is_forked{false};

Helpers& helpers() {
  static Helpers& made = []() -> Helpers& {
    ::pthread_atfork(nullptr, nullptr, [] { is_forked = true; });
    return *new Helpers;
  }();
  return made;
}

/// Places for loops, one loop at a time: threads that have just run dry still look for work there when the next loop
/// comes at once. A loop inside of a loop has another one, so nobody who waits takes up another's chunk. Never ended.
class Arenas {
 public:
  /// Calls run() in an arena of so many threads.
  void run(unsigned threads, const auto& run) {
    struct Taken {
      Arenas& all;
      tbb::task_arena* arena;
      ~Taken() {
        const std::lock_guard lock(all.mutex_);
        all.idle_.push_back(arena);  // there is room: take() sees to it
      }
    };
    const Taken taken{*this, take(static_cast<int>(threads))};
    taken.arena->execute(run);
  }

 private:
  tbb::task_arena* take(int threads) {
    const std::lock_guard lock(mutex_);
    const auto fits = [&](const tbb::task_arena* arena) { return arena->max_concurrency() == threads; };
    const auto found =
        std::find_if(idle_.rbegin(), idle_.rend(), fits);  // the last one used, by the same thread perhaps
    if (found == idle_.rend()) {
      idle_.reserve(made_ + 1);
      auto* const arena = new tbb::task_arena(threads);
      ++made_;
      return arena;
    }
    tbb::task_arena* const arena = *found;
    idle_.erase(std::next(found).base());
    return arena;
  }

  std::mutex mutex_;
  std::vector<tbb::task_arena*> idle_;
  std::size_t made_ = 0;
};

Arenas& arenas() {
  static Arenas& made = *new Arenas;
  return made;
}

}  // namespace

void run_chunks(std::size_t chunks, unsigned threads, FunctionRef<void(std::size_t)> run) {
  if (is_forked) return run_plain_chunks(chunks, threads, run);
  const unsigned usable = helpers().usable(threads);
  if (usable <= 1) return run_plain_chunks(chunks, usable == 0 ? threads : 1, run);
  arenas().run(usable, [&] { tbb::parallel_for(std::size_t{0}, chunks, run, tbb::auto_partitioner()); });
}
#endif

void tell_of_chunk(const Execution& execution, std::chrono::steady_clock::time_point begin, std::size_t items) {
  execution.advance(items);
  if (execution.trace == nullptr) return;
  const char* stage = execution.trace->stage();
  execution.trace->record(stage != nullptr ? stage : "chunk", begin, std::chrono::steady_clock::now(), false, items);
}

}  // namespace warren::detail
