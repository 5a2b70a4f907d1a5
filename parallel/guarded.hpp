// SPDX-License-Identifier: BSD-3-Clause
// A value that several threads use, one at a time.
#pragma once

#include <mutex>
#include <utility>

namespace warren {

/// Neither copied nor moved. Whoever uses the value keeps no reference to it.
template <class T>
class Guarded {
 public:
  /// Calls use(value) while nobody else uses it, and returns what that returns.
  template <class Use>
  auto use(const Use& use) {
    const std::lock_guard lock(mutex_);
    return use(value_);
  }
  /// The same, to look at it.
  template <class Use>
  auto use(const Use& use) const {
    const std::lock_guard lock(mutex_);
    return use(std::as_const(value_));
  }

 private:
  mutable std::mutex mutex_;  // guards value_
  T value_{};
};

}  // namespace warren
