// SPDX-License-Identifier: BSD-3-Clause
// A hash that tells two paths apart without their points.
#pragma once

#include <string>

#include "parallel/execution.hpp"
#include "solve/answer/answer.hpp"

namespace warren {

/// FNV-1a of 64 bits over the numbers of the answer's states, or points, in their order, each as the eight bytes of a
/// double from low to high; as 16 hex digits. 10 ns a number. Throws Stopped.
std::string path_hash(const Answer& answer, const Execution& execution);

}  // namespace warren
