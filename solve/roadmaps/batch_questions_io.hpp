// SPDX-License-Identifier: BSD-3-Clause
// The questions of a batch, line by line: CSV with the header start_x,start_y,goal_x,goal_y (start_theta and goal_theta
// too for bodies that turn, or start_1 … start_6 and goal_1 … goal_6 for arms; any order), or JSON lines
// {"id", "start", "goal"}. Blank lines are none.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/text/input_file_io.hpp"

namespace warren {

struct BatchQuestion {
  std::string id;             ///< as JSON; a CSV line's is its number from 1
  std::vector<double> start;  ///< empty: the world's own, as the goal
  std::vector<double> goal;
  std::string error;  ///< what is wrong with the line; empty: nothing
};

/// Refers to the file. Belongs to one thread.
class BatchQuestions {
 public:
  /// Throws InputError for a CSV whose header names other columns.
  explicit BatchQuestions(const InputFile& file);
  /// Fills `some` with the next ones, at most so many; false where there are none left.
  bool next(std::size_t most, std::vector<BatchQuestion>& some);

 private:
  /// Where a column's number goes: the start's or the goal's, and which of its numbers.
  struct Column {
    bool is_goal;
    std::size_t place;
    bool operator==(const Column&) const = default;
  };
  std::string_view take_line();
  void read_header(std::string_view line);
  BatchQuestion read_csv(std::string_view line) const;
  BatchQuestion read_json(std::string_view line) const;

  const InputFile& file_;
  std::string_view rest_;
  std::vector<Column> columns_;  // empty: JSON lines
  std::uint64_t count_ = 0;
};

}  // namespace warren
