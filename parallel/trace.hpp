// SPDX-License-Identifier: BSD-3-Clause
// Records when each stage and each chunk ran and on which thread, for the Chrome trace format. Each thread has a list
// of its own; one mutex guards them all and is held for each append, once a stage or chunk. What takes turns inside of
// a stage (checks in queries, queries in expansion; parallel/stage_account.hpp) is a part of its event and has none of
// its own.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

namespace warren {

class Trace {
 public:
  using Clock = std::chrono::steady_clock;
  struct Event {
    const char* name;  ///< a literal
    double begin_us;   ///< since the trace was made
    double duration_us;
    std::uint32_t thread;  ///< 0 is the thread that made the trace
    bool is_stage;
    std::uint64_t items;  ///< that were done, of a stopped stage that were to be; 0: not known
  };

  Trace() : start_(Clock::now()) { lanes_.push_back({std::this_thread::get_id(), {}}); }

  /// Destructors call it, also while an exception is on its way: where memory is out, events() says so.
  void record(const char* name, Clock::time_point begin, Clock::time_point end, bool is_stage,
              std::uint64_t items = 0) noexcept {
    const auto micros = [](Clock::duration d) { return std::chrono::duration<double, std::micro>(d).count(); };
    const std::lock_guard lock(mutex_);  // never contended for long
    try {
      const std::uint32_t lane = lane_of(std::this_thread::get_id());
      lanes_[lane].events.push_back({name, micros(begin - start_), micros(end - begin), lane, is_stage, items});
    } catch (const std::bad_alloc&) {
      is_whole_ = false;
    }
  }

  /// The stage that runs from now on, whose name chunks get; returns the one before.
  const char* enter(const char* stage) noexcept { return stage_.exchange(stage, std::memory_order_relaxed); }
  const char* stage() const noexcept { return stage_.load(std::memory_order_relaxed); }  ///< nullptr: none

  /// All events, thread by thread. Call when no worker runs. Throws std::bad_alloc where one could not be recorded.
  std::vector<Event> events() const {
    if (!is_whole_) throw std::bad_alloc();
    std::vector<Event> all;
    for (const Lane& lane : lanes_) all.insert(all.end(), lane.events.begin(), lane.events.end());
    return all;
  }
  std::size_t thread_count() const { return lanes_.size(); }

 private:
  struct Lane {
    std::thread::id thread;
    std::vector<Event> events;
  };
  std::uint32_t lane_of(std::thread::id id) {
    for (std::uint32_t i = 0; i < lanes_.size(); ++i) {
      if (lanes_[i].thread == id) return i;
    }
    lanes_.push_back({id, {}});
    return static_cast<std::uint32_t>(lanes_.size() - 1);
  }

  Clock::time_point start_;
  std::atomic<const char*> stage_{nullptr};  // a name alone: which one a chunk sees changes no result
  std::mutex mutex_;                         // guards lanes_
  std::vector<Lane> lanes_;
  bool is_whole_ = true;
};

}  // namespace warren
