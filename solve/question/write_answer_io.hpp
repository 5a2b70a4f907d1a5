// SPDX-License-Identifier: BSD-3-Clause
// Writes an Answer as warren.answer/1: one key a line, keys in their documented order, numbers that read back as the
// same doubles, the path last. The same bytes for any thread count but for stages_s, solve_s, threads and
// peak_memory_bytes.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "parallel/execution.hpp"
#include "solve/question/answer.hpp"

namespace warren {

/// Hands the text to `write` piece by piece. Throws Stopped when a signal comes meanwhile.
void write_answer_json(const Answer& answer, const Execution& execution,
                       const std::function<void(std::string_view)>& write);

/// What `stopped_by` says: "budget", "memory", or a signal's name.
std::string_view stop_name(StopReason reason);

/// A text as a JSON string, quotes included; bytes that are not UTF-8 become U+FFFD.
std::string json_string(std::string_view text);
/// {"leg", "distance", "obstacle"}.
std::string violation_json(const Violation& violation);
/// A finite number as JSON, "1.0" rather than "1"; null for others.
std::string json_number(double value);

}  // namespace warren
