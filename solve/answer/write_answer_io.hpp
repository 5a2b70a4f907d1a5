// SPDX-License-Identifier: BSD-3-Clause
// Writes an Answer as warren.answer/1: one key a line, keys in their documented order, numbers that read back as the
// same doubles, the path last. The same bytes for any thread count but for stages_s, solve_s, threads and
// peak_memory_bytes.
#pragma once

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

}  // namespace warren
