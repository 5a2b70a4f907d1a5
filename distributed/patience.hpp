// SPDX-License-Identifier: BSD-3-Clause
// Waiting for another process: sleeps, so that whoever shares the core can work, 50 us first and 2 ms at most.
#pragma once

#include <time.h>

#include <algorithm>

#include "parallel/execution.hpp"

namespace warren::distributed {

class Patience {
 public:
  /// Throws Stopped.
  void wait(const Execution& execution) {
    execution.check();
    const timespec pause{0, pause_ns_};
    ::nanosleep(&pause, nullptr);
    pause_ns_ = std::min(2 * pause_ns_, 2'000'000L);
  }
  /// What was waited for has come.
  void renew() { pause_ns_ = 50'000; }

 private:
  long pause_ns_ = 50'000;
};

}  // namespace warren::distributed
