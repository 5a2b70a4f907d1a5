// SPDX-License-Identifier: BSD-3-Clause
// Each planner, and each roadmap that is kept, is asked each word for each body: an answer that holds and shows that
// the word was heard, or a refusal that names it. Never silence.
#include "tests/solve/word_matrix.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/error.hpp"
#include "solve/kept/roadmap_query.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/solve.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

/// Planners that get better end after some turns; others take no number of them.
SolveOptions options_of(PlannerKind planner) {
  SolveOptions options;
  options.planner = planner;
  for (const PlannerKind better : {PlannerKind::rrt_star, PlannerKind::informed_rrt_star, PlannerKind::anytime}) {
    if (planner == better) options.anytime.iterations = 6;
  }
  return options;
}

/// Bodies that turn arrive in any heading.
Question plain_question(const test::AskedBody& body) {
  Question question;
  question.start = test::state_at(body.robot, {1.5, 5.0});
  if (body.robot.kind == RobotKind::polygon || body.robot.kind == RobotKind::car) question.start.push_back(0.0);
  question.goal = test::state_at(body.robot, {8.5, 4.5});
  question.robot = body.robot;
  return question;
}

void expect_refused_by_name(const UsageError& error, const test::AskedRow& row) {
  const std::string_view why = error.what();
  EXPECT_TRUE(why.find(row.name) != why.npos || (!row.with.empty() && why.find(row.with) != why.npos)) << why;
}

void expect_heard(const test::AskedBody& body, const test::AskedRow& row, Answer& answer) {
  ASSERT_EQ(answer.outcome, Outcome::solved);
  EXPECT_TRUE(row.is_heard(answer)) << "it was passed over";
  const Verdict verdict = verify(body.scene, answer);
  EXPECT_TRUE(verdict.verified) << (verdict.first_violation ? verdict.first_violation->obstacle : "");
  if (!row.spoil) return;
  row.spoil(answer);
  EXPECT_FALSE(verify(body.scene, answer).verified) << "the judge asks for nothing of it";
}

void expect_heard_or_refused(const test::AskedBody& body, PlannerKind planner, const test::AskedRow& row) {
  Question question = plain_question(body);
  SolveOptions options = options_of(planner);
  row.ask(question, options);
  std::optional<Answer> answer;
  try {
    answer = solve(body.scene, question, options);
  } catch (const UsageError& error) {
    expect_refused_by_name(error, row);
    EXPECT_FALSE(row.by_all) << error.what();
    return;
  }
  expect_heard(body, row, *answer);
}

void expect_kept_or_refused(const test::AskedBody& body, PlannerKind planner, const test::AskedRow& row) {
  Question question = plain_question(body);
  SolveOptions options = options_of(planner);
  row.ask(question, options);
  std::optional<Answer> answer;
  try {
    const Roadmap roadmap = build(body.scene, question, options);
    answer = RoadmapQuery(roadmap).ask(question.start, question.goal);
  } catch (const UsageError& error) {
    return expect_refused_by_name(error, row);
  }
  expect_heard(body, row, *answer);
}

/// A place that the world's own lines forbid; other words are the question's alone.
void expect_line_heard_or_refused(const test::AskedBody& body, PlannerKind planner, const test::AskedRow& row) {
  Question question = plain_question(body);
  SolveOptions options = options_of(planner);
  row.ask(question, options);
  if (question.prices.keep_out.empty()) return;
  test::AskedBody closed = body;
  closed.scene.prices = std::exchange(question.prices, {});
  std::optional<Answer> answer;
  try {
    answer = solve(closed.scene, question, options);
  } catch (const UsageError& error) {
    const std::string_view why = error.what();
    EXPECT_TRUE(why.find("keep-out") != why.npos || why.find("keep out") != why.npos) << why;
    return;
  }
  expect_heard(closed, row, *answer);
}

using Ask = void (*)(const test::AskedBody&, PlannerKind, const test::AskedRow&);

/// Of the planners for which plain(body, planner) throws nothing: others are for other bodies or worlds.
template <class Plain>
void ask_each_word(const Plain& plain, Ask ask) {
  const std::vector<test::AskedBody> bodies = test::asked_bodies();
  for (const std::uint64_t number : test::seeds(bodies.size(), 2)) {
    const test::AskedBody& body = bodies[number - 1];
    for (const PlannerKind planner : planners_there_are()) {
      try {
        plain(body, planner);
      } catch (const UsageError&) {
        continue;
      }
      for (const test::AskedRow& row : test::asked_rows()) {
        SCOPED_TRACE(body.name + ", " + std::string(name_of(planner)) + ", " + row.name);
        ask(body, planner, row);
      }
    }
  }
}

TEST(AskedWords, AreHeardOrRefusedByName) {
  const auto plain = [](const test::AskedBody& body, PlannerKind planner) {
    solve(body.scene, plain_question(body), options_of(planner));
  };
  ask_each_word(plain, [](const test::AskedBody& body, PlannerKind planner, const test::AskedRow& row) {
    expect_heard_or_refused(body, planner, row);
    expect_line_heard_or_refused(body, planner, row);
  });
}

TEST(AskedWords, AreKeptByRoadmapsOrRefusedByName) {
  const auto plain = [](const test::AskedBody& body, PlannerKind planner) {
    check_buildable(body.scene, plain_question(body), options_of(planner));
  };
  ask_each_word(plain, expect_kept_or_refused);
}

}  // namespace
}  // namespace warren
