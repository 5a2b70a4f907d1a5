// SPDX-License-Identifier: BSD-3-Clause
// A value that is made when somebody first asks for it, by whichever thread comes first; the others wait, each within
// its own limits. Where making it throws, nothing was made, and the next one who asks makes it. A look at what was made
// costs one load.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>

#include "parallel/execution.hpp"

namespace warren {

/// Any number of threads may call get().
template <class T>
class MadeOnce {
 public:
  /// make() gives a std::unique_ptr<T> that isn't empty. Throws what it throws; Stopped while another thread makes it.
  template <class Make>
  const T& get(const Execution& execution, const Make& make) const {
    if (const T* made = made_.load(std::memory_order_acquire)) return *made;
    std::unique_lock lock(mutex_, std::try_to_lock);
    while (!lock.owns_lock() && !lock.try_lock()) {
      execution.check();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (owned_ == nullptr) {
      owned_ = make();
      made_.store(owned_.get(), std::memory_order_release);
    }
    return *owned_;
  }
  /// The same from the call on that `calls` others came before; nullptr until then: a value that only many are worth.
  template <class Make>
  const T* get_after(std::uint32_t calls, const Execution& execution, const Make& make) const {
    if (const T* made = made_.load(std::memory_order_acquire)) return made;
    if (calls_.load(std::memory_order_relaxed) < calls && calls_.fetch_add(1, std::memory_order_relaxed) < calls) {
      return nullptr;
    }
    return &get(execution, make);
  }

 private:
  // Invariant: made_ is nullptr or what owned_ holds, which never changes from then on; owned_ is touched under mutex_.
  mutable std::mutex mutex_;
  mutable std::unique_ptr<T> owned_;
  mutable std::atomic<const T*> made_{nullptr};
  mutable std::atomic<std::uint32_t> calls_{0};  // of get_after() that came too early
};

}  // namespace warren
