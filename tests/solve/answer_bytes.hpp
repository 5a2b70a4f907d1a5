// SPDX-License-Identifier: BSD-3-Clause
// An answer's bytes, but for times and what else may differ from run to run.
#pragma once

#include <string>

#include "solve/answer/answer.hpp"
#include "solve/answer/write_answer_io.hpp"

namespace warren::test {

inline std::string bytes_of(Answer answer) {
  answer.seconds = {};
  answer.solve_s = 0.0;
  answer.threads = 1;
  answer.peak_memory_bytes = 0;
  std::string text;
  write_answer_json(answer, {}, [&](std::string_view piece) { text += piece; });
  return text;
}

}  // namespace warren::test
