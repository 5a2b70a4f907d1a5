// SPDX-License-Identifier: BSD-3-Clause
// What threads do once, whichever comes first, or one after the other.
#pragma once

#include <atomic>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "core/run/execution.hpp"

namespace warren {

/// A value that is made when somebody first asks for it, by whichever thread comes first; the others wait, each within
/// its own limits. Where making it throws, nothing was made, and the next one who asks makes it. A look at what was
/// made costs one load. Any number of threads may call get().
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

/// A call that threads make one after the other, in any order. For what is short beside their work: a write, a look-up.
class OneAtATime {
 public:
  template <class Call>
  auto operator()(const Call& call) const {
    const std::lock_guard lock(mutex_);
    return call();
  }
  /// The same for what may take long: nobody waits. false: another thread is at it, and nothing was called.
  template <class Call>
  bool unless_busy(const Call& call) const {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock.owns_lock()) call();
    return lock.owns_lock();
  }

 private:
  mutable std::mutex mutex_;  // guards what its owner touches in calls alone
};

/// A value that several threads use, one at a time. Neither copied nor moved. Whoever uses the value keeps no reference
/// to it.
template <class T>
class Guarded {
 public:
  /// Calls use(value) while nobody else uses it, and returns what that returns.
  template <class Use>
  auto use(const Use& use) {
    return one_([&] { return use(value_); });
  }
  /// The same, to look at it.
  template <class Use>
  auto use(const Use& use) const {
    return one_([&] { return use(value_); });
  }

 private:
  OneAtATime one_;  // who uses value_
  T value_{};
};

/// One bit for each of n things that are done once and stay done, whichever thread does them: a look costs one load.
/// What is done twice, because two threads looked at once, must do no harm. A mark passes no memory on to others: it
/// may only speak of what nobody writes. Any number of threads may call all of it.
class LastingMarks {
 public:
  explicit LastingMarks(std::size_t n) : words_((n + word_bits - 1) / word_bits) {}

  bool test(std::size_t i) const noexcept {
    return (words_[i / word_bits].load(std::memory_order_relaxed) >> (i % word_bits) & 1U) != 0;
  }
  void set(std::size_t i) noexcept {
    words_[i / word_bits].fetch_or(std::uint64_t{1} << (i % word_bits), std::memory_order_relaxed);
  }

 private:
  static constexpr std::size_t word_bits = 64;
  std::vector<std::atomic<std::uint64_t>> words_;
};

/// What must be done before the bytes of a block of somebody's memory are first looked at, say to hold them against
/// their checksum: done once a block, by whichever thread comes first. A look at what was done costs a load and a test.
/// Refers to its owner. Any number of threads may call ensure().
struct FirstLook {
  const LastingMarks* done = nullptr;  ///< a bit a block; nullptr: nothing is to be done
  std::size_t first_block = 0;         ///< the bit of byte 0
  std::size_t block_bytes = 1;         ///< a power of two
  const void* owner = nullptr;
  void (*look)(const void* owner, std::size_t block) = nullptr;  ///< sets the bit, or throws

  void ensure(std::size_t first_byte, std::size_t bytes) const {
    if (done == nullptr || bytes == 0) return;
    const auto shift = static_cast<unsigned>(std::countr_zero(block_bytes));
    const std::size_t last = first_block + ((first_byte + bytes - 1) >> shift);
    for (std::size_t block = first_block + (first_byte >> shift); block <= last; ++block) {
      if (!done->test(block)) [[unlikely]]
        look(owner, block);
    }
  }
};

/// A number, from 1, that this process has given nobody before, to know a remembered value by: an address may be
/// another value's later. Any thread.
inline std::uint64_t fresh_number() noexcept {
  static std::atomic<std::uint64_t> latest{0};
  return latest.fetch_add(1, std::memory_order_relaxed) + 1;
}

}  // namespace warren
