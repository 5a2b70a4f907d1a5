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
  Ticker(std::chrono::milliseconds first, std::chrono::milliseconds period, std::function<void()> tick)
      : tick_(std::move(tick)) {
    try {
      thread_ = std::jthread([this, first, period](const std::stop_token& stop) { run(first, period, stop); });
    } catch (const std::system_error&) {  // no thread is to be had
    }
  }

 private:
  void run(std::chrono::milliseconds first, std::chrono::milliseconds period, const std::stop_token& stop) {
    std::mutex own;  // guards nothing: waits are made with one
    std::unique_lock lock(own);
    const auto is_over = [&] { return stop.stop_requested(); };
    wake_.wait_for(lock, stop, first, is_over);
    while (!is_over()) {
      tick_();
      wake_.wait_for(lock, stop, period, is_over);
    }
  }

  std::function<void()> tick_;
  std::condition_variable_any wake_;
  std::jthread thread_;  // ended first
};

}  // namespace warren
