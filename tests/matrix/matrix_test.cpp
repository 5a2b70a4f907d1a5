// SPDX-License-Identifier: BSD-3-Clause
// Every planner, with and without --optimise, for every body in every world: where planners.table says yes, the program
// answers, its judge agrees, and so does the matrix's own; where it says no, all verbs refuse, and say what would do.
// One test a world, so that they run side by side. WARREN_MATRIX_SHARE: under sanitizers, which take ten times as long,
// only every so many-th field is asked, drawn by its name.
#include <gtest/gtest.h>

#include <cstdint>
#include <sstream>

#include "tests/matrix/matrix_worlds.hpp"
#include "tests/matrix/planner_table.hpp"
#include "tests/matrix/program_answer.hpp"
#include "tests/paths.hpp"
#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

std::string table_file() { return source_dir() + "/tests/matrix/planners.table"; }

TEST(PlannerTable, IsWhatReadmeShows) {
  std::ostringstream readme;
  readme << std::ifstream(source_dir() + "/README.md").rdbuf();
  const std::string table = PlannerTable::read(table_file()).markdown();
  EXPECT_NE(readme.str().find("\n" + table + "\n"), std::string::npos) << "README.md shall show this table:\n" << table;
}

/// FNV-1a: the same fields in every build.
std::uint64_t hash_of(const std::string& field) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : field) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return hash;
}

bool is_drawn(const std::string& field) { return (hash_of(field) >> 32U) % WARREN_MATRIX_SHARE == 0; }

std::string list_of(const std::vector<double>& numbers) {
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < numbers.size(); ++i) text << (i == 0 ? "" : ",") << numbers[i];
  return text.str();
}

class Matrix : public testing::TestWithParam<MatrixWorld> {
 protected:
  Matrix() : table_(PlannerTable::read(table_file())) {
    for (const auto& [name, text] : world().files) folder_.write(name, text);
    const auto [name, text] = arm_file();
    folder_.write(name, text);
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
  void check_why_blocked(const MatrixBody& body, bool may_touch, const ProgramAnswer& answer) const;

  static void check_explained(const ProgramAnswer& answer, const std::string& summary);

  void ask_planner(const MatrixBody& body, const PlannerRow& planner, const PlannerField* field, bool optimise);
  void ask_kept_roadmap(const MatrixBody& body, const std::string& planner, bool is_kept);
  void ask_judges(const MatrixBody& body, const std::string& planner, const ProgramAnswer& answer);
  void ask_all_at_once(const MatrixBody& body, const BodyColumn& column);
  void ask_in_vain(const MatrixBody& body);
  void expect_refusal(const std::vector<std::string>& arguments, const std::string& named);
  Outcome ask(const std::vector<std::string>& arguments);

  Folder folder_;
  PlannerTable table_;
  int asked_ = 0;
};

std::string Matrix::robot_of(const MatrixBody& body) const {
  std::string robot = body.robot;
  const std::string place = "FOLDER";
  const std::size_t at = robot.find(place);
  if (at != std::string::npos) robot.replace(at, place.size() + 1, folder_.path(""));
  return robot;
}

/// Start and goal; `turns`: may their headings differ?
std::vector<std::vector<double>> Matrix::ends_of(const MatrixBody& body, bool turns) const {
  if (body.arm) return {arm_start(), arm_goal()};
  const auto& [start, goal] = std::pair{world().start, world().goal};
  const bool heads = body.kind == "polygon" || body.kind == "car";
  if (!heads) return {{start[0], start[1]}, {goal[0], goal[1]}};
  return {{start[0], start[1], start[2]}, {goal[0], goal[1], turns ? goal[2] : start[2]}};
}

std::vector<std::string> Matrix::question_of(const MatrixBody& body, bool turns) const {
  const std::vector<std::vector<double>> ends = ends_of(body, turns);
  std::ostringstream clearance;
  clearance << clearance_of(body);
  return {"--robot",
          robot_of(body),
          "--start=" + list_of(ends[0]),
          "--goal=" + list_of(ends[1]),
          "--clearance",
          clearance.str(),
          "--threads",
          "1"};
}

/// A coarse one: the usual ones take seconds.
std::vector<std::string> Matrix::raster_of(const MatrixBody& body) {
  std::vector<std::string> words;
  if (world().kind == "plane") words = {"--cell", "0.1"};
  if (body.kind == "polygon") words.insert(words.end(), {"--angles", "24"});
  return words;
}

std::optional<std::string> Matrix::wrong_with(const MatrixBody& body, const std::vector<std::vector<double>>& ends,
                                              double clearance, bool may_touch,
                                              const std::vector<std::vector<double>>& path) const {
  if (body.arm) return wrong_with_path(world().space, *body.arm, {ends[0], ends[1], clearance}, path);
  PlaneQuestion question{.clearance = clearance, .may_touch = may_touch};
  std::copy(ends[0].begin(), ends[0].end(), question.start.begin());
  std::copy(ends[1].begin(), ends[1].end(), question.goal.begin());
  return wrong_with_path(world().plane, body.plane, question, path);
}

Outcome Matrix::ask(const std::vector<std::string>& arguments) {
  ++asked_;
  return run(arguments);
}

void Matrix::expect_refusal(const std::vector<std::string>& arguments, const std::string& named) {
  SCOPED_TRACE(shown(arguments));
  const Outcome outcome = ask(arguments);
  EXPECT_EQ(outcome.code, 2) << outcome.err << outcome.out;
  EXPECT_NE(outcome.err.find(named), std::string::npos) << "'" << named << "' is not in: " << outcome.err;
}

/// A blocked end is called blocked, the start first, and a free one is not. What just touches may be either.
void Matrix::check_ends(const MatrixBody& body, const std::vector<std::vector<double>>& ends, bool may_touch,
                        const std::string& status) const {
  constexpr double hair = 1e-6;
  const auto is_blocked = [&](const std::vector<double>& end) {
    return wrong_with(body, {end, end}, clearance_of(body), may_touch, {end}).has_value();
  };
  const auto is_free = [&](const std::vector<double>& end) {
    return !wrong_with(body, {end, end}, clearance_of(body) + hair, false, {end}).has_value();
  };
  if (is_blocked(ends[0])) {
    EXPECT_EQ(status, "start_blocked");
    return;
  }
  EXPECT_FALSE(status == "start_blocked" && is_free(ends[0])) << "the start is free";
  EXPECT_FALSE(status == "goal_blocked" && is_free(ends[1])) << "the goal is free";
  if (is_blocked(ends[1]) && status != "start_blocked") {
    EXPECT_EQ(status, "goal_blocked");
  }
}

/// In a strange world there may be no way: nobody shall look for it long.
std::vector<std::string> Matrix::limits_of(const std::string& planner) {
  if (!world().is_strange) return {};
  if (planner == "prm" || planner == "lazy-prm") return {"--samples", "300"};
  if (planner == "rrt" || planner == "rrt-connect") return {"--nodes", "2000"};
  return {};
}

std::vector<std::string> Matrix::path_words(const MatrixBody& body) const {
  std::vector<std::string> words{"--path", folder_.path("path.csv"), "--every", "0.25"};
  if (body.arm) {
    words.insert(words.end(), {"--joint-speed", "1", "--joint-acceleration", "2"});
  } else {
    words.insert(words.end(), {"--speed", "1", "--acceleration", "0.5"});
  }
  if (body.kind == "car") words.insert(words.end(), {"--lateral-acceleration", "0.3"});
  return words;
}

/// The places of the path's file: the path's states are among them, what is between them is on the path, and time goes
/// on.
void Matrix::check_path_file(const MatrixBody& body, const std::vector<std::vector<double>>& ends, bool may_touch,
                             const std::vector<std::vector<double>>& path) const {
  std::vector<std::vector<double>> places;
  std::size_t found = 0;
  std::vector<double> before;
  for (const std::vector<double>& row : read_numbers(folder_.read("path.csv"))) {  // t, s, state, speed
    ASSERT_EQ(row.size(), path.front().size() + 3);
    places.emplace_back(row.begin() + 2, row.end() - 1);
    if (found < path.size() && places.back() == path[found]) ++found;
    EXPECT_LE(std::abs(row.back()), 1.0 + 1e-9);
    if (!before.empty()) {
      EXPECT_GE(row[0], before[0]);
      EXPECT_GE(row[1], before[1]);
      EXPECT_LE(row[1] - before[1], 0.25 + 1e-9);
    }
    before = row;
  }
  EXPECT_EQ(found, path.size());
  EXPECT_EQ(places.back(), path.back());
  const auto wrong = wrong_with(body, ends, clearance_of(body), may_touch, places);
  EXPECT_FALSE(wrong.has_value()) << "between the places of path.csv: " << *wrong;
}

/// What is told of a blocked end is told, and a place that is called free is.
void Matrix::check_why_blocked(const MatrixBody& body, bool may_touch, const ProgramAnswer& answer) const {
  const bool is_blocked = answer.status == "start_blocked" || answer.status == "goal_blocked";
  EXPECT_EQ(answer.says_why_blocked, is_blocked);
  if (answer.free_place.empty()) return;
  const std::vector<double>& place = answer.free_place;
  const auto wrong = wrong_with(body, {place, place}, clearance_of(body), may_touch, {place});
  EXPECT_FALSE(wrong.has_value()) << "the free place: " << *wrong;
}

/// What is told of samples and motions adds up, and where there is no path something is said that would help, but where
/// nothing would.
void Matrix::check_explained(const ProgramAnswer& answer, const std::string& summary) {
  ASSERT_EQ(answer.samples.size(), 3U);
  ASSERT_EQ(answer.motions.size(), 4U);
  for (const auto* counts : {&answer.samples, &answer.motions}) {
    for (const long long count : *counts) EXPECT_GE(count, 0);
  }
  EXPECT_LE(answer.samples[1] + answer.samples[2], answer.samples[0]);
  EXPECT_EQ(answer.motions[1] + answer.motions[2] + answer.motions[3], answer.motions[0]);
  EXPECT_NE(summary.find("time went to"), std::string::npos) << summary;
  const bool tries = summary.find("\n  try ") != std::string::npos;
  if (answer.status == "not_connected") {
    EXPECT_TRUE(tries) << summary;
  } else if (answer.status == "solved" || answer.status == "infeasible") {
    EXPECT_FALSE(tries) << summary;
  }
}

/// One field of the table: solve, verify, and the matrix's own look at every place of the path.
void Matrix::ask_planner(const MatrixBody& body, const PlannerRow& planner, const PlannerField* field, bool optimise) {
  const std::string name = world().name + "/" + body.name + "/" + planner.name + (optimise ? "/optimise" : "");
  if (!is_drawn(name)) return;
  SCOPED_TRACE(name);
  const bool turns = !keeps_angle(planner.name);
  std::vector<std::string> arguments{"solve", world_file(), "--planner", planner.name};
  for (const std::string& word : question_of(body, turns)) arguments.push_back(word);
  if (optimise) arguments.emplace_back("--optimise");
  if (field == nullptr) {
    std::vector<std::string> compare{"compare", world_file(), "--planners", planner.name, "--seeds", "1"};
    compare.insert(compare.end(), arguments.begin() + 4, arguments.end());
    if (!optimise) expect_refusal(compare, "prm");
    return expect_refusal(arguments, "prm");
  }
  if (optimise && !field->optimises) return expect_refusal(arguments, "--optimise");
  if (planner.name == "grid") {
    for (const std::string& word : raster_of(body)) arguments.push_back(word);
  }
  for (const std::string& word : limits_of(planner.name)) arguments.push_back(word);
  const std::string file = folder_.path("answer.json");
  for (const char* word : {"--explain", "--budget", "30s", "--json"}) arguments.emplace_back(word);
  arguments.push_back(file);
  for (const std::string& word : path_words(body)) arguments.push_back(word);
  SCOPED_TRACE(shown(arguments));
  const Outcome outcome = ask(arguments);
  ASSERT_TRUE(outcome.code == 0 || outcome.code == 1) << "exit code " << outcome.code << ": " << outcome.err;
  const ProgramAnswer answer = read_program_answer(folder_.read("answer.json"));
  EXPECT_EQ(outcome.code == 0, answer.status == "solved");
  EXPECT_EQ(answer.verified, answer.status == "solved");
  EXPECT_NE(answer.status, "stopped");
  check_explained(answer, outcome.out);
  const bool may_touch = body.kind == "point" && keeps_angle(planner.name);
  check_ends(body, ends_of(body, turns), may_touch, answer.status);
  check_why_blocked(body, may_touch, answer);
  if (answer.status != "solved") {
    EXPECT_TRUE(answer.path.empty());
    return;
  }
  check_path_file(body, ends_of(body, turns), may_touch, answer.path);
  ask_judges(body, planner.name, answer);
}

/// A roadmap that is built and then asked answers as solve does, and an update to the same world asks about nothing, or
/// builds anew what is not drawn. One field in four, drawn by its name.
void Matrix::ask_kept_roadmap(const MatrixBody& body, const std::string& planner, bool is_kept) {
  const std::string name = world().name + "/" + body.name + "/" + planner + "/kept";
  if (!is_drawn(name) || hash_of(name) % 4 != 0) return;
  const bool is_sampled = planner == "prm" || planner == "lazy-prm";
  const std::vector<std::string> question = question_of(body, !keeps_angle(planner));
  const std::vector<std::string> ends(question.begin() + 2, question.begin() + 4);
  std::vector<std::string> build{"build", world_file(), "--planner", planner};
  if (is_sampled) build.insert(build.end(), {"--samples", "200"});
  for (const std::string& word : question) {
    if (word != ends[0] && word != ends[1]) build.push_back(word);
  }
  std::vector<std::string> solve = build;
  solve[0] = "solve";
  solve.insert(solve.end(), {ends[0], ends[1], "--json", folder_.path("solved.json")});
  const std::string roadmap = folder_.path("kept.roadmap");
  build.insert(build.end(), {"-o", roadmap});
  if (!is_kept) return expect_refusal(build, "makes no roadmap that is kept");
  SCOPED_TRACE(shown(build));
  const Outcome built = ask(build);
  ASSERT_EQ(built.code, 0) << built.err;
  const Outcome solved = ask(solve);
  const Outcome asked = ask({"query", roadmap, ends[0], ends[1], "--json", folder_.path("asked.json")});
  EXPECT_EQ(asked.code, solved.code) << asked.err << solved.err;
  const ProgramAnswer expected = read_program_answer(folder_.read("solved.json"));
  const ProgramAnswer answer = read_program_answer(folder_.read("asked.json"));
  EXPECT_EQ(answer.status, expected.status);
  EXPECT_EQ(answer.verified, expected.verified);
  EXPECT_EQ(answer.length, expected.length);
  EXPECT_EQ(answer.path, expected.path);
  EXPECT_EQ(answer.expanded, expected.expanded);
  const Outcome updated =
      ask({"update", roadmap, world_file(), "-o", folder_.path("updated.roadmap"), "--report", "-"});
  EXPECT_EQ(updated.code, 0) << updated.err;
  const bool anew = updated.out.find("\"mode\": \"built\"") != std::string::npos;
  EXPECT_EQ(anew, body.arm.has_value() || !is_sampled) << updated.out;
  EXPECT_TRUE(anew || updated.out.find("\"edges_checked\": 0,") != std::string::npos) << updated.out;
  EXPECT_TRUE(folder_.read("updated.roadmap") == folder_.read("kept.roadmap")) << "another roadmap of the same world";
}

/// The program's judge, and the matrix's own.
void Matrix::ask_judges(const MatrixBody& body, const std::string& planner, const ProgramAnswer& answer) {
  const Outcome verdict = ask({"verify", world_file(), folder_.path("answer.json")});
  EXPECT_EQ(verdict.code, 0) << "verify: " << verdict.err << verdict.out;
  const bool may_touch = body.kind == "point" && keeps_angle(planner);
  const auto wrong = wrong_with(body, ends_of(body, !keeps_angle(planner)), clearance_of(body), may_touch, answer.path);
  EXPECT_FALSE(wrong.has_value()) << *wrong;
}

/// Those that solve it, side by side and without being named; a picture of what they find; and that some do find it.
void Matrix::ask_all_at_once(const MatrixBody& body, const BodyColumn& column) {
  const std::string name = world().name + "/" + body.name;
  if (!is_drawn(name)) return;
  SCOPED_TRACE(name);
  std::string planners;
  for (const PlannerRow& planner : table_.planners()) {
    if (PlannerTable::field(planner, column) != nullptr) planners += (planners.empty() ? "" : ",") + planner.name;
  }
  std::vector<std::string> question = question_of(body, false);
  const auto expect_path = [&](std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    SCOPED_TRACE(shown(arguments));
    const Outcome outcome = ask(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  };
  const std::string answer = folder_.path("usual.json");
  const std::string picture = folder_.path("picture.svg");
  expect_path({"solve", world_file(), "--budget", "30s", "--json", answer, "--svg", picture}, question);
  expect_path({"verify", world_file(), answer}, {});
  expect_path({"render", world_file(), "--answer", answer, "-o", picture}, {});
  if (planners.ends_with("grid")) {
    for (const std::string& word : raster_of(body)) question.push_back(word);
  }
  expect_path({"compare", world_file(), "--planners", planners, "--seeds", "1", "--budget", "30s"}, question);
}

/// A body that nobody solves in such a world: all verbs say so alike.
void Matrix::ask_in_vain(const MatrixBody& body) {
  const std::string& named = table_.refusal(body.kind, world().kind);
  const auto refuse = [&](std::vector<std::string> arguments, bool with_question) {
    if (!is_drawn(world().name + "/" + body.name + "/" + arguments[0] + arguments.back())) return;
    if (with_question) {
      for (const std::string& word : question_of(body, true)) arguments.push_back(word);
    }
    expect_refusal(arguments, named);
  };
  const std::string answer = folder_.write("answer.json", smallest_answer(robot_of(body), ends_of(body, true)));
  refuse({"verify", world_file(), answer}, false);
  refuse({"render", world_file(), "-o", folder_.path("picture.svg"), "--answer", answer}, false);
  refuse({"solve", world_file()}, true);
  refuse({"solve", world_file(), "--optimise"}, true);
  for (const PlannerRow& planner : table_.planners()) {
    refuse({"solve", world_file(), "--planner", planner.name}, true);
    refuse({"compare", world_file(), "--seeds", "1", "--planners", planner.name}, true);
  }
}

void Matrix::ask_everything() {
  for (const MatrixBody& body : matrix_bodies(world().body_scale)) {
    const BodyColumn* column = table_.column_of(body.kind, world().kind);
    if (column == nullptr) {
      ask_in_vain(body);
      continue;
    }
    for (const PlannerRow& planner : table_.planners()) {
      const PlannerField* field = PlannerTable::field(planner, *column);
      ask_planner(body, planner, field, false);
      ask_planner(body, planner, field, true);
      if (field != nullptr) ask_kept_roadmap(body, planner.name, field->is_kept);
    }
    if (!world().is_strange) ask_all_at_once(body, *column);
  }
}

TEST_P(Matrix, AnswersEveryFieldAsTheTableSays) {
  ask_everything();
  EXPECT_GT(asked(), 0);
}

INSTANTIATE_TEST_SUITE_P(Worlds, Matrix, testing::ValuesIn(matrix_worlds()),
                         [](const testing::TestParamInfo<MatrixWorld>& world) { return world.param.name; });

}  // namespace
}  // namespace warren::test
