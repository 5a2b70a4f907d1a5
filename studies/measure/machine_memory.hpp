// SPDX-License-Identifier: BSD-3-Clause
// The machine that a measurement was made on, and its memory as measurements need it: warmed, and with a peak that
// starts anew. On a virtual machine the first touch of a page can cost a hundred times the second (the host has to find
// it), and that cost belongs to the machine, not to a solver: it is measured apart.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "parallel/execution.hpp"

namespace warren::studies {

struct Machine {
  std::string cpu;               ///< the model's name; "unknown CPU" where the system doesn't tell
  unsigned cores = 1;            ///< that this process may use
  std::size_t memory_bytes = 0;  ///< in all; 0 where the system doesn't tell
};

Machine this_machine();
/// "Intel(R) Xeon(R), 2 cores, 31.4 GiB"
std::string text_of(const Machine& machine);
/// {"cpu": …, "cores": …, "memory_bytes": …}
nlohmann::ordered_json machine_json(const Machine& machine);

/// From now on peak_resident_bytes() tells the peak since now, where the system can do that.
void restart_peak_memory();

/// What touching memory for the first time has cost.
struct MemoryTouch {
  std::size_t bytes = 0;  ///< the most that was touched at once; 0: nothing was
  double cold_s = 0.0;    ///< the first time
  double warm_s = 0.0;    ///< the same bytes once more
};

/// Touches memory before a clock starts, so that what follows finds it warm.
class WarmMemory {
 public:
  /// Has so many bytes touched at once, unless they were, or are too few to matter, or more than the limit allows.
  /// Throws Stopped at a signal.
  void prepare(std::size_t bytes, const Execution& execution);
  const MemoryTouch& touch() const { return touch_; }

 private:
  MemoryTouch touch_;
};

}  // namespace warren::studies
