// SPDX-License-Identifier: BSD-3-Clause
// One world of the matrix: the questions that are asked in it (matrix_test.cpp), and what is expected of the answers
// (matrix_checks.cpp).
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "tests/matrix/matrix_worlds.hpp"
#include "tests/matrix/planner_table.hpp"
#include "tests/matrix/program_answer.hpp"
#include "tests/tools/process.hpp"

namespace warren::test {

/// The table whose fields are asked.
std::string matrix_table_file();

class Matrix : public testing::TestWithParam<MatrixWorld> {
 protected:
  Matrix() : table_(PlannerTable::read(matrix_table_file())) {
    for (const auto& [name, text] : world().files) folder_.write(name, text);
    for (const auto& [name, text] : arm_files()) folder_.write(name, text);
  }

  void ask_everything();
  int asked() const { return asked_; }

 private:
  static const MatrixWorld& world() { return GetParam(); }
  std::string world_file() const { return folder_.path(world().files.front().first); }
  static double clearance_of(const MatrixBody& body) { return body.kind == "point" ? 0.0 : world().clearance; }
  static bool keeps_angle(const std::string& planner) { return planner == "visibility" || planner == "cells"; }

  std::string robot_of(const MatrixBody& body) const;
  std::vector<std::vector<double>> ends_of(const MatrixBody& body, bool turns) const;
  std::vector<std::string> question_of(const MatrixBody& body, bool turns) const;
  static std::vector<std::string> raster_of(const MatrixBody& body);
  std::optional<std::string> wrong_with(const MatrixBody& body, const std::vector<std::vector<double>>& ends,
                                        double clearance, bool may_touch,
                                        const std::vector<std::vector<double>>& path) const;

  void check_ends(const MatrixBody& body, const std::vector<std::vector<double>>& ends, bool may_touch,
                  const std::string& status) const;
  static std::vector<std::string> limits_of(const std::string& planner);
  std::vector<std::string> path_words(const MatrixBody& body) const;
  void check_path_file(const MatrixBody& body, const std::vector<std::vector<double>>& ends, bool may_touch,
                       const std::vector<std::vector<double>>& path) const;
  void check_why_blocked(const MatrixBody& body, const ProgramAnswer& answer) const;
  void ask_offered_place(const MatrixBody& body, const ProgramAnswer& answer);

  static void check_bound(const std::string& planner, const ProgramAnswer& answer);
  static void check_explained(const ProgramAnswer& answer, const std::string& summary);

  void ask_planner(const MatrixBody& body, const PlannerRow& planner, const PlannerField* field, bool optimise);
  void ask_pipelines(std::vector<std::string> arguments, const ProgramAnswer& usual);
  void ask_kept_roadmap(const MatrixBody& body, const std::string& planner, bool is_kept);
  void ask_estimate(const MatrixBody& body, const std::string& planner);
  void ask_index(const MatrixBody& body, const std::string& planner, bool chooses);
  void ask_judges(const MatrixBody& body, const std::string& planner, const ProgramAnswer& answer);
  void ask_all_at_once(const MatrixBody& body, const BodyColumn& column);
  void ask_in_vain(const MatrixBody& body);
  void expect_refusal(const std::vector<std::string>& arguments, const std::string& named);
  Outcome ask(const std::vector<std::string>& arguments);

  Folder folder_;
  PlannerTable table_;
  int asked_ = 0;
};

}  // namespace warren::test
