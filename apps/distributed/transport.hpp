// SPDX-License-Identifier: BSD-3-Clause
// How the processes of one run, its ranks, hand bytes to each other. Two models: MPI (mpi_transport.hpp), and threads
// of one process, for tests.
#pragma once

#include <time.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/packed_values.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"

namespace warren::distributed {

/// Messages between two ranks arrive in their order. One call at a time. Waits sleep, poll the deadline and throw
/// Stopped.
class Transport : NotCopied {
 public:
  virtual ~Transport() = default;
  virtual unsigned rank() const = 0;  ///< 0 .. ranks() - 1
  virtual unsigned ranks() const = 0;
  /// Returns when the bytes may be changed.
  virtual void send(unsigned to, std::span<const std::byte> bytes, const Execution& execution) = 0;
  /// Waits for the next message of that rank.
  virtual Bytes receive(unsigned from, const Execution& execution) = 0;
  /// Has a message of that rank come?
  virtual bool has_message(unsigned from) = 0;

  std::uint64_t bytes_sent() const { return bytes_sent_; }

 protected:
  std::uint64_t bytes_sent_ = 0;
};

/// Waiting for another process: sleeps, so that whoever shares the core can work, 50 us first and 2 ms at most.
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
