// SPDX-License-Identifier: BSD-3-Clause
// What the matrix reads of an answer: its status and its path, straight from the text.
#pragma once

#include <string>
#include <vector>

namespace warren::test {

struct ProgramAnswer {
  std::string status;
  bool verified = false;
  std::string length;       ///< as it stands there
  std::string lower_bound;  ///< the same; empty where none is told
  std::string cost;         ///< the same; of grid, whose cost is its own, too
  std::string gap;          ///< the same
  bool optimal = false;
  std::string expanded;  ///< of the counters, likewise; empty where nothing was searched
  std::vector<std::vector<double>> path;
  bool says_why_blocked = false;
  /// What --explain says of samples (drawn, kept, dropped) and of motions (checked, free, blocked, undecided).
  std::vector<unsigned long long> samples;
  std::vector<unsigned long long> motions;
  std::vector<double> free_place;  ///< near a blocked end; empty where none is told
};

/// Throws std::runtime_error for a text that has no status or no path.
ProgramAnswer read_program_answer(const std::string& json);
/// The numbers of a CSV file below its header.
std::vector<std::vector<double>> read_numbers(const std::string& csv);
/// The smallest answer that `verify` and `render` take: a body and its path.
std::string smallest_answer(const std::string& robot, const std::vector<std::vector<double>>& path);

}  // namespace warren::test
