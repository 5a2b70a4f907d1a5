// SPDX-License-Identifier: BSD-3-Clause
// A hash that tells two paths apart without their points.
#pragma once

#include <cstdint>
#include <string>

#include "parallel/execution.hpp"
#include "solve/answer/answer.hpp"

namespace warren {

/// FNV-1a of 64 bits over numbers in their order, each as the eight bytes of a double from low to high. 10 ns a number.
class PathHash {
 public:
  void add(double number);
  /// As 16 hex digits.
  std::string text() const;

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

/// Of the numbers of the answer's states, or points. Throws Stopped.
std::string path_hash(const Answer& answer, const Execution& execution);

}  // namespace warren
