// SPDX-License-Identifier: BSD-3-Clause
// Small worlds for the tests of maps and grids, and what the program answers about them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/tools/process.hpp"

namespace warren::test {

using Json = nlohmann::ordered_json;

inline constexpr const char* small_map =
    "type octile\nheight 5\nwidth 7\nmap\n"
    ".......\n"
    ".@@@@@.\n"
    ".......\n"
    "@@@@@.@\n"
    ".......\n";
inline constexpr const char* sealed_map = "type octile\nheight 3\nwidth 5\nmap\n..@..\n.@@..\n..@..\n";
inline constexpr const char* course_scene =
    "bounds 0 0 800 300\nrobot polygon -25 -25 25 -25 25 25 -25 25\n"
    "wall 200 0 200 200\nwall 100 200 300 200\nwall 400 100 400 300\nwall 600 0 600 200\nwall 500 200 700 200\n"
    "start 50 50 0\ngoal 750 50\n";

/// What the command prints with --json -, and its exit code as expected.
inline Json answered(std::vector<std::string> arguments, int code = 0) {
  SCOPED_TRACE(shown(arguments));
  arguments.insert(arguments.end(), {"--json", "-"});
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.code, code) << outcome.err << outcome.out;
  return Json::parse(outcome.out, nullptr, false);
}

}  // namespace warren::test
