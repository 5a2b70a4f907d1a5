// SPDX-License-Identifier: BSD-3-Clause
// Calls a function at even intervals on a thread of its own until it is destroyed: what draws progress while the
// workers work. Where the system makes no more threads, nothing is called.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>

namespace warren {

class Ticker {
 public:
  /// tick must not throw; it is first called after `first`, then every `period`.
  Ticker(std::chrono::milliseconds first, std::chrono::milliseconds period, std::function<void()> tick)
      : tick_(std::move(tick)) {
    try {
      thread_ = std::thread([this, first, period] { run(first, period); });
    } catch (const std::system_error&) {  // no thread is to be had
    }
  }
  /// Waits for a running tick; none follows.
  ~Ticker() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
  }
  Ticker(const Ticker&) = delete;
  Ticker& operator=(const Ticker&) = delete;

 private:
  void run(std::chrono::milliseconds first, std::chrono::milliseconds period) {
    std::unique_lock lock(mutex_);
    for (auto wait = first; !wake_.wait_for(lock, wait, [this] { return ended_; }); wait = period) {
      lock.unlock();
      tick_();
      lock.lock();
    }
  }

  std::function<void()> tick_;
  std::mutex mutex_;  // guards ended_
  std::condition_variable wake_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace warren
