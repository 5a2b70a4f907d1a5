// SPDX-License-Identifier: BSD-3-Clause
// Every planner, with and without --optimise, for every body in every world: where planners.table says yes, the program
// answers, its judge agrees, and so does the matrix's own; where it says no, all verbs refuse, and say what would do.
// One test a world, so that they run side by side. WARREN_MATRIX_SHARE=N: by day only every N-th field is asked, drawn
// by its name and WARREN_PICK, and all with WARREN_SEEDS=all; each failure names its field.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <sstream>

#include "tests/matrix/matrix_run.hpp"
#include "tests/paths.hpp"
#include "tests/seeds.hpp"

namespace warren::test {
namespace {

TEST(PlannerTable, IsWhatReadmeShows) {
  std::ostringstream readme;
  readme << std::ifstream(source_dir() + "/README.md").rdbuf();
  const std::string table = PlannerTable::read(matrix_table_file()).markdown();
  EXPECT_NE(readme.str().find("\n" + table + "\n"), std::string::npos) << "README.md shall show this table:\n" << table;
}

/// Every so many-th field, drawn by its name and WARREN_PICK.
bool is_drawn(const std::string& field) {
  const std::string_view share = environment("WARREN_MATRIX_SHARE");
  if (share.empty() || asks_all()) return true;
  const std::string drawn = field + std::string(environment("WARREN_PICK"));
  return (hash_of(drawn) >> 32U) % std::stoull(std::string(share)) == 0;
}

/// A small picture, in the format that the field's name draws.
std::vector<std::string> picture_words(const Folder& folder, const std::string& field) {
  constexpr std::array<const char*, 4> endings{".svg", ".png", ".pdf", ".html"};
  const std::string ending = endings[hash_of(field) % endings.size()];
  std::vector<std::string> words{"--svg", folder.path("picture" + ending)};
  if (ending != ".html") words.insert(words.end(), {"--size", "300x300"});  // a page fills its window
  return words;
}

}  // namespace

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
  if (planner.name != "grid" && hash_of(name) % 2 == 0) arguments.emplace_back("--bound");
  const std::string file = folder_.path("answer.json");
  for (const char* word : {"--explain", "--budget", "30s", "--json"}) arguments.emplace_back(word);
  arguments.push_back(file);
  for (const std::string& word : path_words(body)) arguments.push_back(word);
  for (const std::string& word : picture_words(folder_, name)) arguments.push_back(word);
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
  check_why_blocked(body, answer);
  if (hash_of(name) % 4 == 0) ask_offered_place(body, answer);
  if (answer.status != "solved") {
    EXPECT_TRUE(answer.path.empty());
    return;
  }
  check_path_file(body, ends_of(body, turns), may_touch, answer.path);
  ask_judges(body, planner.name, answer);
  if (planner.name == "prm" && world().name == "maze" && (body.kind == "point" || body.kind == "disc") && !optimise)
    ask_pipelines(arguments, answer);
}

/// However prm works, its path is as long.
void Matrix::ask_pipelines(std::vector<std::string> arguments, const ProgramAnswer& usual) {
  arguments.insert(arguments.end(), {"--pipeline", ""});
  for (const char* pipeline : {"plain", "tiled", "streamed"}) {
    arguments.back() = pipeline;
    SCOPED_TRACE(shown(arguments));
    ASSERT_EQ(ask(arguments).code, 0);
    const ProgramAnswer answer = read_program_answer(folder_.read("answer.json"));
    EXPECT_TRUE(answer.verified);
    EXPECT_EQ(answer.length, usual.length);
  }
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

/// An estimate that may be too long changes what is found, never whether, nor that it is verified; it is for roadmaps
/// of points and discs, and is called optimal only where it meets a bound. One field in four, drawn by its name.
void Matrix::ask_estimate(const MatrixBody& body, const std::string& planner) {
  const std::string name = world().name + "/" + body.name + "/" + planner + "/estimate";
  if (!is_drawn(name) || hash_of(name) % 4 != 0) return;
  std::vector<std::string> plain{"solve", world_file(), "--planner", planner};
  for (const std::string& word : question_of(body, !keeps_angle(planner))) plain.push_back(word);
  std::vector<std::string> estimated = plain;
  estimated.insert(estimated.end(), {"--heuristic", "manhattan"});
  const bool is_roadmap = planner == "prm" || planner == "lazy-prm";
  if (!is_roadmap || (body.kind != "point" && body.kind != "disc")) return expect_refusal(estimated, "--heuristic");
  for (std::vector<std::string>* words : {&plain, &estimated}) {
    words->insert(words->end(), {"--samples", "300", "--json", folder_.path("answer.json")});
  }
  SCOPED_TRACE(shown(estimated));
  const Outcome expected = ask(plain);
  const Outcome outcome = ask(estimated);
  EXPECT_EQ(outcome.code, expected.code) << outcome.err << expected.err;
  const ProgramAnswer answer = read_program_answer(folder_.read("answer.json"));
  if (answer.status == "solved") ask_judges(body, planner, answer);
}

/// What finds neighbours changes no path. One field in four, drawn by its name.
void Matrix::ask_index(const MatrixBody& body, const std::string& planner, bool chooses) {
  const std::string name = world().name + "/" + body.name + "/" + planner + "/index";
  if (!is_drawn(name) || hash_of(name) % 4 != 0) return;
  std::vector<std::string> words{"solve", world_file(), "--planner", planner};
  for (const std::string& word : question_of(body, !keeps_angle(planner))) words.push_back(word);
  if (chooses) words.insert(words.end(), {"--samples", "200", "--json", folder_.path("answer.json")});
  words.insert(words.end(), {"--neighbour-index", "kd-tree"});
  if (!chooses) return expect_refusal(words, "--neighbour-index");
  SCOPED_TRACE(shown(words));
  std::vector<ProgramAnswer> answers;
  for (const char* index : {"auto", "kd-tree", "grid", "brute"}) {
    words.back() = index;
    const Outcome outcome = ask(words);
    ASSERT_LE(outcome.code, 1) << outcome.err;
    answers.push_back(read_program_answer(folder_.read("answer.json")));
    EXPECT_EQ(answers.back().status, answers.front().status) << index;
    EXPECT_EQ(answers.back().path, answers.front().path) << index;
  }
}

/// The program's judge, and the matrix's own.
void Matrix::ask_judges(const MatrixBody& body, const std::string& planner, const ProgramAnswer& answer) {
  check_bound(planner, answer);
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
  for (const char* drawn : {"drawn.svg", "drawn.png", "drawn.pdf"}) {
    expect_path({"render", world_file(), "--answer", answer, "--size", "300x300", "-o", folder_.path(drawn)}, {});
  }
  expect_path({"render", world_file(), "--answer", answer, "-o", folder_.path("drawn.html")}, {});
  if (planners.ends_with("grid")) {
    for (const std::string& word : raster_of(body)) question.push_back(word);
  }
  expect_path({"compare", world_file(), "--planners", planners, "--seeds", "1", "--budget", "30s", "--iterations", "4"},
              question);
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
      if (field != nullptr) ask_estimate(body, planner.name);
      if (field != nullptr) ask_index(body, planner.name, field->chooses_index);
    }
    if (!world().is_strange) ask_all_at_once(body, *column);
  }
}

namespace {

TEST_P(Matrix, AnswersEveryFieldAsTheTableSays) {
  ask_everything();
  EXPECT_GT(asked(), 0);
}

INSTANTIATE_TEST_SUITE_P(Worlds, Matrix, testing::ValuesIn(matrix_worlds()),
                         [](const testing::TestParamInfo<MatrixWorld>& world) { return world.param.name; });

}  // namespace
}  // namespace warren::test
