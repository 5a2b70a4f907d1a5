// SPDX-License-Identifier: BSD-3-Clause
// Places along a path, evenly apart: where a profile is taken.
#pragma once

#include <cstddef>
#include <vector>

#include "parallel/execution.hpp"
#include "solve/answer/answer.hpp"
#include "solve/paths/path_legs.hpp"

namespace warren::serve {

/// The body's state somewhere on a path.
struct PathPlace {
  double along;  ///< length of the reference point's way from the start
  PathState state;
};

/// count >= 2 places, start and goal among them, even by PathLegs::length(), so that turns on the spot have some, too;
/// of a path without length its one place. The answer has a path. O(states + count). Throws Stopped.
std::vector<PathPlace> places_along(const Answer& answer, std::size_t count, const Execution& execution);

}  // namespace warren::serve
