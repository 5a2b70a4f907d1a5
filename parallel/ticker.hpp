// SPDX-License-Identifier: BSD-3-Clause
// Calls a function at even intervals on a thread of its own until it is destroyed: what draws progress while the
// workers work. Where the system makes no more threads, nothing is called.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <system_error>
#include <thread>

namespace warren {

/// Its end waits for a running tick; none follows. Neither copied nor moved.
class Ticker {
 public:
  /// tick must not throw; it is first called after `first`, then every `period`.
  Ticker(std::chrono::milliseconds first, std::chrono::milliseconds period, std::function<void()> tick) {
    try {
      thread_ = std::jthread([this, first, period, tick = std::move(tick)](const std::stop_token& stop) {
        std::mutex own;  // guards nothing: waits are made with one
        std::unique_lock lock(own);
        const auto is_over = [&] { return stop.stop_requested(); };
        for (auto pause = first; !wake_.wait_for(lock, stop, pause, is_over); pause = period) tick();
      });
    } catch (const std::system_error&) {  // no thread is to be had
    }
  }

 private:
  std::condition_variable_any wake_;
  std::jthread thread_;  // ended first
};

}  // namespace warren
