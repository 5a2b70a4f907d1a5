// SPDX-License-Identifier: BSD-3-Clause
// Every rank but 0: does what rank 0 asks for, until it says that this is the end.
#pragma once

#include <cstddef>

#include "distributed/band.hpp"
#include "distributed/transport.hpp"
#include "parallel/deadline.hpp"
#include "parallel/execution.hpp"

namespace warren::distributed {

/// How a follower runs. It has no time limit of its own: rank 0's ends it.
struct FollowerLimits {
  unsigned threads = 0;
  std::size_t memory_bytes = 0;
  const SignalFlag* signal = nullptr;  ///< nullptr: none comes
  Progress* progress = nullptr;        ///< says what it does
};

/// Returns when rank 0 has said the end. Throws Stopped at a signal.
void follow(Transport& transport, const BandTask& task, const FollowerLimits& limits);

}  // namespace warren::distributed
