// SPDX-License-Identifier: BSD-3-Clause
// A hash that tells two paths apart without their points.
#pragma once

#include <cstdint>
#include <string>

#include "core/run/execution.hpp"
#include "solve/answer/answer.hpp"

namespace warren {

/// FNV-1a of 64 bits over numbers in their order, each as the eight bytes of a double from low to high.
class PathHash {
 public:
  void add(double number);
  /// As 16 hex digits.
  std::string text() const;

 private:
  // The hash but for its last factor, by which the next number begins: that of nothing is 0xcbf29ce484222325.
  std::uint64_t last_ = 0x1d10331a6b696bc7U;
};

/// Of the numbers of the answer's states, or points. Throws Stopped.
std::string path_hash(const Answer& answer, const Execution& execution);

}  // namespace warren
