// SPDX-License-Identifier: BSD-3-Clause
// How a test asks for a number of threads.
#pragma once

#include "core/run/execution.hpp"

namespace warren::test {

inline Execution on(unsigned threads) {
  Execution execution;
  execution.threads = threads;
  return execution;
}

}  // namespace warren::test
