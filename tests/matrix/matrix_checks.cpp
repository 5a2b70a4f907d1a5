// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <sstream>
#include <string>

#include "tests/matrix/matrix_run.hpp"
#include "tests/paths.hpp"

namespace warren::test {
namespace {

/// Until something else ends it.
bool gets_better(std::string_view planner) { return planner == "anytime" || planner.ends_with("rrt-star"); }

std::string list_of(const std::vector<double>& numbers) {
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < numbers.size(); ++i) text << (i == 0 ? "" : ",") << numbers[i];
  return text.str();
}

}  // namespace

std::string matrix_table_file() { return source_dir() + "/tests/matrix/planners.table"; }

std::string Matrix::robot_of(const MatrixBody& body) const {
  std::string robot = body.robot;
  const std::string place = "FOLDER/";
  for (std::size_t at = robot.find(place); at != std::string::npos; at = robot.find(place)) {
    robot.replace(at, place.size(), folder_.path(""));
  }
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

/// All but grid, whose cost is its own where it is no car's, tell a bound that their path is not below.
void Matrix::check_bound(const std::string& planner, const ProgramAnswer& answer) {
  EXPECT_TRUE(planner == "grid" || !answer.lower_bound.empty());
  if (answer.lower_bound.empty()) {
    EXPECT_TRUE(answer.gap.empty());
    return;
  }
  constexpr double rounding = 1e-9;
  const double bound = std::stod(answer.lower_bound);
  const double cost = std::stod(answer.cost.empty() ? answer.length : answer.cost);
  EXPECT_GE(bound, 0.0);
  EXPECT_LE(bound, cost * (1.0 + 1e-12));
  EXPECT_EQ(answer.gap.empty(), bound == 0.0 && cost > 0.0);
  if (!answer.gap.empty()) {
    EXPECT_GE(std::stod(answer.gap), 0.0);
  }
  const double open = planner == "visibility" ? 1e-5 : 2.0 * rounding;  // of a disc it goes around the arcs
  EXPECT_TRUE(answer.optimal || cost - bound > rounding * cost);
  EXPECT_TRUE(!answer.optimal || cost - bound <= open * cost);
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
  if (gets_better(planner)) return {"--iterations", "6"};
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

/// What is told of a blocked end is told, and a place that is called free is, without touching.
void Matrix::check_why_blocked(const MatrixBody& body, const ProgramAnswer& answer) const {
  const bool is_blocked = answer.status == "start_blocked" || answer.status == "goal_blocked";
  EXPECT_EQ(answer.says_why_blocked, is_blocked);
  if (answer.free_place.empty()) return;
  const std::vector<double>& place = answer.free_place;
  const auto wrong = wrong_with(body, {place, place}, clearance_of(body), false, {place});
  EXPECT_FALSE(wrong.has_value()) << "the free place: " << *wrong;
}

/// No planner that takes the body calls a place blocked that was offered, and it is written in few digits.
void Matrix::ask_offered_place(const MatrixBody& body, const ProgramAnswer& offering) {
  const std::vector<double>& place = offering.free_place;
  const BodyColumn* column = table_.column_of(body.kind, world().kind);
  if (place.empty() || column == nullptr) return;
  for (std::size_t k = 0; k < (body.arm ? place.size() : 2); ++k) {
    EXPECT_NEAR(place[k] * 1e7, std::round(place[k] * 1e7), 1e-2) << "digits of " << list_of(place);
  }
  for (const PlannerRow& planner : table_.planners()) {
    if (PlannerTable::field(planner, *column) == nullptr) continue;
    std::vector<std::string> arguments{"solve", world_file(), "--planner", planner.name};
    for (const std::string& word : question_of(body, true)) {
      const bool is_end = word.starts_with("--start=") || word.starts_with("--goal=");
      arguments.push_back(is_end ? word.substr(0, word.find('=') + 1) + list_of(place) : word);
    }
    if (planner.name == "grid") {
      for (const std::string& word : raster_of(body)) arguments.push_back(word);
    }
    if (planner.name == "prm" || planner.name == "lazy-prm") arguments.insert(arguments.end(), {"--samples", "20"});
    if (planner.name == "rrt" || planner.name == "rrt-connect") arguments.insert(arguments.end(), {"--nodes", "200"});
    if (gets_better(planner.name)) arguments.insert(arguments.end(), {"--iterations", "2"});
    arguments.insert(arguments.end(), {"--budget", "30s", "--json", folder_.path("offered.json")});
    SCOPED_TRACE(shown(arguments));
    const Outcome outcome = ask(arguments);
    if (outcome.code == 2) continue;  // cells and voronoi refuse what overlaps
    const ProgramAnswer answer = read_program_answer(folder_.read("offered.json"));
    EXPECT_NE(answer.status, "start_blocked");
    EXPECT_NE(answer.status, "goal_blocked");
  }
}

/// What is told of samples and motions adds up, and where there is no path something is said that would help, but where
/// nothing would.
void Matrix::check_explained(const ProgramAnswer& answer, const std::string& summary) {
  ASSERT_EQ(answer.samples.size(), 3U);
  ASSERT_EQ(answer.motions.size(), 4U);
  EXPECT_LE(answer.samples[1], answer.samples[0]) << "kept of drawn";
  EXPECT_LE(answer.samples[2], answer.samples[0]) << "dropped of drawn";
  EXPECT_LE(answer.motions[1] + answer.motions[3], answer.motions[0]) << "free and undecided of checked";
  EXPECT_NE(summary.find("time went to"), std::string::npos) << summary;
  const bool tries = summary.find("\n  try ") != std::string::npos;
  if (answer.status == "not_connected") {
    EXPECT_TRUE(tries) << summary;
  } else if (answer.status == "solved" || answer.status == "infeasible") {  // a path that is found may get better
    const bool may_get_better = summary.find("\n  try           --iterations") != std::string::npos;
    EXPECT_EQ(tries, may_get_better && answer.status == "solved") << summary;
  }
}

}  // namespace warren::test
