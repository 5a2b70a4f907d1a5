// SPDX-License-Identifier: BSD-3-Clause
// An answer that was found in time stays one where only what comes after it is stopped.
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "solve/solve.hpp"
#include "tests/tools/process.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/verbs/answer_command.hpp"

namespace warren::test {
namespace {

enum class Dawdles { explaining, finding };

/// A solve that is in time with its answer, and takes until it is stopped for what comes after.
class SlowTalker : public tools::AnswerCommand {
 public:
  SlowTalker(const tools::Arguments& arguments, Dawdles where)
      : tools::AnswerCommand(arguments, "--save-roadmap"), where_(where) {
    scene_.source = "field";
    scene_.bounds = Box{{0.0, 0.0}, {10.0, 10.0}};
    scene_.start = {1.0, 1.0};
    scene_.goal = {9.0, 9.0};
  }

 private:
  static void wait(const Execution& execution) {
    while (!execution.should_stop()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  Answer find(const tools::Run& run, StageTimes&, ByProducts* keep) override {
    Answer answer = solve_within(scene_, {}, {}, run.execution(), keep);
    if (where_ == Dawdles::finding) wait(run.execution());  // as an estimate's price does, which swallows its stop
    return answer;
  }
  Scene scene_drawn(const Execution&, ByProducts&) override { return scene_; }
  void explain(const Execution& execution, Answer&, ByProducts&) override {
    if (where_ == Dawdles::explaining) wait(execution);
    execution.check();
  }

  Dawdles where_;
  Scene scene_;
};

nlohmann::json told_in_time(const Folder& folder, const std::vector<std::string>& more, Dawdles where) {
  std::vector<std::string> words{
      "solve", "field", "--quiet", "--json", folder.path("a.json"), "--svg", folder.path("a.svg")};
  words.insert(words.end(), more.begin(), more.end());
  const tools::Command command = tools::command_named("solve");
  const tools::Arguments arguments(command, std::span(words).subspan(1));
  EXPECT_EQ(SlowTalker(arguments, where).run(), tools::exit_code::success);
  EXPECT_NE(folder.read("a.svg"), "");
  return nlohmann::json::parse(folder.read("a.json"));
}

TEST(AnswerInTime, StaysWhereTheBudgetEndsItsExplanation) {
  const Folder folder;
  const auto answer = told_in_time(folder, {"--explain", "--budget", "3s"}, Dawdles::explaining);
  EXPECT_EQ(answer["status"], "solved");
  EXPECT_EQ(answer["verified"], true);
  EXPECT_EQ(answer["explained"]["stopped_by"], "budget");
}

TEST(AnswerInTime, StaysWhereASecondSolveIsStoppedSilently) {
  const Folder folder;
  EXPECT_EQ(told_in_time(folder, {"--budget", "3s"}, Dawdles::finding)["status"], "solved");
}

TEST(AnswerInTime, ASignalThatEndedAnExplanationIsForgotten) {
  const Folder folder;
  tools::install_signal_handlers();
  std::raise(SIGTERM);
  EXPECT_NE(tools::signal_flag().load(), 0);
  tools::forget_signal();
  EXPECT_EQ(tools::signal_flag().load(), 0);
  std::raise(SIGTERM);  // a key pressed twice
  EXPECT_EQ(tools::signal_flag().load(), 0);
}

/// A planner that gets better, ended after its first path.
class EndedImprover : public tools::AnswerCommand {
 public:
  EndedImprover(const tools::Arguments& arguments, StopReason reason)
      : tools::AnswerCommand(arguments, "--save-roadmap"), reason_(reason) {}

 private:
  Answer find(const tools::Run& run, StageTimes&, ByProducts* keep) override {
    Scene scene;
    scene.source = "field";
    scene.bounds = Box{{0.0, 0.0}, {10.0, 10.0}};
    scene.start = {1.0, 1.0};
    scene.goal = {9.0, 9.0};
    Answer answer = solve_within(scene, {}, {}, run.execution(), keep);
    answer.iterations = 3;
    answer.stop_reason = reason_;
    answer.improvements = {{.iterations = 1, .cost = answer.length, .length = answer.length, .by = "tree"}};
    return answer;
  }
  Scene scene_drawn(const Execution&, ByProducts&) override { return {}; }
  void explain(const Execution&, Answer&, ByProducts&) override {}

  StopReason reason_;
};

TEST(AnswerInTime, APathThatASignalEndedIsWrittenAndTheCodeIsTheSignals) {
  for (const auto& [reason, code] : {std::pair(StopReason::time, tools::exit_code::success),
                                     std::pair(StopReason::memory, tools::exit_code::success),
                                     std::pair(StopReason::interrupt, tools::exit_code::interrupted),
                                     std::pair(StopReason::terminate, tools::exit_code::terminated)}) {
    const Folder folder;
    const std::vector<std::string> words{"field", "--quiet", "--json", folder.path("a.json")};
    const tools::Command command = tools::command_named("solve");
    const tools::Arguments arguments(command, words);
    EXPECT_EQ(EndedImprover(arguments, reason).run(), code) << name_of(reason);
    const auto answer = nlohmann::json::parse(folder.read("a.json"));
    EXPECT_EQ(answer["status"], "solved");
    EXPECT_EQ(answer["verified"], true);
    EXPECT_EQ(answer["stopped_by"], name_of(reason));
    EXPECT_EQ(answer["improvements"].size(), 1U);
    EXPECT_EQ(answer["iterations"], 3);
  }
}

}  // namespace
}  // namespace warren::test
