// SPDX-License-Identifier: BSD-3-Clause
// The questions of a batch, line by line: CSV with the header start_x,start_y,goal_x,goal_y (start_theta and goal_theta
// too for bodies that turn, or start_1 … start_6 and goal_1 … goal_6 for arms; any order), or JSON lines
// {"id", "start", "goal"}. Blank lines are none. And the places of a matrix, starts or goals: the same without start_
// and goal_, or {"id", "state"}.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/files/human_units.hpp"
#include "scenes/files/input_file_io.hpp"
#include "scenes/files/json_text.hpp"
#include "scenes/files/scene_text.hpp"
#include "solve/kept/roadmap.hpp"

namespace warren {

struct BatchQuestion {
  std::string id;  ///< a CSV line's is its number from 1
  bool id_is_text = false;
  std::vector<double> start;  ///< empty: the world's own, as the goal; of a matrix its place
  std::vector<double> goal;
  std::string error;  ///< what is wrong with the line; empty: nothing

  std::string json_id() const { return id_is_text ? json_string(id) : id; }
  std::string csv_id() const { return csv_field(id); }
};

/// What a line has.
enum class BatchLines : std::uint8_t { questions, starts, goals };

/// Refers to the file, the roadmap and the execution. Belongs to one thread.
class BatchQuestions {
 public:
  /// Throws InputError for a CSV whose header names other columns, or lacks one without which no line can be asked;
  /// Stopped.
  BatchQuestions(const InputFile& file, BatchLines kind, const Roadmap& roadmap, const Execution& execution);
  /// Fills `some` with the next ones, at most so many; false where there are none left. Throws Stopped.
  bool next(std::size_t most, std::vector<BatchQuestion>& some);

 private:
  /// Where a column's number goes: the start's or the goal's, and which of its numbers.
  struct Column {
    bool is_goal;
    std::size_t place;
    bool operator==(const Column&) const = default;
  };
  std::string_view prefix(bool is_goal) const;
  std::string whole_header() const;
  void read_header(std::string_view line);
  void check_columns(const std::string& where) const;
  BatchQuestion read_line(std::string_view line) const;
  void read_csv(std::string_view line, BatchQuestion& question) const;
  void read_json(std::string_view line, BatchQuestion& question) const;
  void check_place(const std::vector<double>& place) const;

  TextLines lines_;
  bool is_at_line_ = false;  // the line is still to be read
  BatchLines kind_;
  const Scene& scene_;
  std::span<const std::string_view> axes_;  // names of a state's numbers
  std::vector<Column> columns_;             // empty: JSON lines
  std::uint64_t count_ = 0;
};

}  // namespace warren
