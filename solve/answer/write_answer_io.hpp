// SPDX-License-Identifier: BSD-3-Clause
// Writes an Answer as warren.answer/1: one key a line, keys in their documented order, numbers that read back as the
// same doubles, the path last. The same bytes for any thread count but for stages_s, solve_s, threads and
// peak_memory_bytes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "core/run/execution.hpp"
#include "scenes/text/json_text.hpp"
#include "solve/answer/answer.hpp"

namespace warren {

/// Hands the text to `write` piece by piece. Throws Stopped when a signal comes meanwhile.
void write_answer_json(const Answer& answer, const Execution& execution,
                       const std::function<void(std::string_view)>& write);

/// {"leg", "distance", "obstacle"}.
std::string violation_json(const Violation& violation);
/// As JSON text.
std::string figure_json(const Figure& figure);

/// A hash that tells two paths apart without their points: FNV-1a of 64 bits over numbers in their order, each as the
/// eight bytes of a double from low to high.
class PathHash {
 public:
  /// Behind those that were added.
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
