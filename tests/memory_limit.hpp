// SPDX-License-Identifier: BSD-3-Clause
// How much more a process may hold from now on, for tests of what is asked for before it is taken.
#pragma once

#include <cstddef>
#include <limits>

#include "core/run/execution.hpp"

namespace warren::test {

/// What has been freed goes back before, or it could be held anew.
inline Deadline limit_from_here(std::size_t bytes) {
  give_freed_pages_back();
  return Deadline(std::numeric_limits<double>::infinity(), resident_bytes() + bytes);
}

}  // namespace warren::test
