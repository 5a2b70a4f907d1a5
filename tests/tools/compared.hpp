// SPDX-License-Identifier: BSD-3-Clause
// What `warren compare` says as JSON.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/tools/program.hpp"

namespace warren::test {

inline nlohmann::ordered_json compared(const std::string& words) {
  const ProgramRun run = run_program("compare " + words + " --quiet --json -");
  EXPECT_EQ(run.exit_code, 0) << words;
  return nlohmann::ordered_json::parse(run.out);
}

}  // namespace warren::test
