// SPDX-License-Identifier: BSD-3-Clause
// A call that threads make one after the other, in any order. For what is short beside their work: a write, a look-up.
#pragma once

#include <mutex>

namespace warren {

class OneAtATime {
 public:
  template <class Call>
  auto operator()(const Call& call) const {
    const std::lock_guard lock(mutex_);
    return call();
  }

 private:
  mutable std::mutex mutex_;  // guards what its owner touches in calls alone
};

}  // namespace warren
