// SPDX-License-Identifier: BSD-3-Clause
// What README promises, as data: which planner solves which body in which kind of world, read from planners.table. The
// matrix holds the program to it, and README shows it as markdown() writes it.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace warren::test {

/// One column of README's table.
struct BodyColumn {
  std::string name;
  std::vector<std::string> bodies;  ///< point, disc, polygon, car, arm
  std::vector<std::string> worlds;  ///< plane, map, space, mixed, empty
  std::string head;
};

/// A planner that solves a column's problems.
struct PlannerField {
  bool optimises = false;      ///< takes --optimise
  bool is_kept = false;        ///< its roadmap is built without a question
  bool chooses_index = false;  ///< takes --neighbour-index
  std::string words;           ///< "yes", "yes; usual", ...
};

struct PlannerRow {
  std::string name;
  std::string does;
  std::map<std::string, PlannerField> fields;  ///< by the column's name; what is absent is no
};

/// What nobody solves, and what its refusal has to name.
struct Refusal {
  std::vector<std::string> bodies;
  std::vector<std::string> worlds;
  std::string names;
};

class PlannerTable {
 public:
  /// Throws std::runtime_error for a line that it does not understand.
  static PlannerTable read(const std::string& file);

  const std::vector<PlannerRow>& planners() const { return planners_; }
  /// Null where no planner solves such bodies in such worlds.
  const BodyColumn* column_of(const std::string& body, const std::string& world) const;
  /// Null where the planner does not solve the column's problems.
  static const PlannerField* field(const PlannerRow& planner, const BodyColumn& column);
  /// What a refusal names where there is no column. Throws std::out_of_range where nothing is said.
  const std::string& refusal(const std::string& body, const std::string& world) const;
  /// README's table.
  std::string markdown() const;

 private:
  std::vector<BodyColumn> columns_;
  std::vector<PlannerRow> planners_;
  std::vector<Refusal> refusals_;
};

}  // namespace warren::test
