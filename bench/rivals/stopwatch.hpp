// SPDX-License-Identifier: BSD-3-Clause
// CPU time of the whole process beside wall-clock time: on a shared machine the first is what two programs compare by.
#pragma once

#include <chrono>
#include <ctime>

namespace warren {

struct CpuWall {
  double cpu_s = 0.0;  ///< all threads of the process
  double wall_s = 0.0;
};

class Stopwatch {
 public:
  Stopwatch() : cpu_begin_(cpu_seconds()), wall_begin_(Clock::now()) {}
  CpuWall read() const {
    return {cpu_seconds() - cpu_begin_, std::chrono::duration<double>(Clock::now() - wall_begin_).count()};
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  double cpu_begin_;
  Clock::time_point wall_begin_;
};

}  // namespace warren
