// SPDX-License-Identifier: BSD-3-Clause
// What a rank that is stopped says last: where it was and why, for of many ranks that end somebody has to.
#pragma once

#include <new>

#include "distributed/transport.hpp"

namespace warren::distributed {

/// One line on standard error.
void say_where_stopped(const Transport& transport, const Progress& progress, StopReason reason);

/// Gives what work() gives. Throws as it does, after the line where that is Stopped or memory that is out.
template <class Work>
auto telling_where_stopped(const Transport& transport, const Progress& progress, const Work& work) {
  try {
    return work();
  } catch (const Stopped& stopped) {
    say_where_stopped(transport, progress, stopped.reason);
    throw;
  } catch (const std::bad_alloc&) {
    say_where_stopped(transport, progress, StopReason::memory);
    throw;
  }
}

}  // namespace warren::distributed
