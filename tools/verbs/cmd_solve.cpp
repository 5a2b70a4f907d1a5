// SPDX-License-Identifier: BSD-3-Clause
// warren solve: finds a path, verifies it, prints what it took. A stop at any stage still gives an answer.
#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/explain_answer.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/solve.hpp"
#include "solve/streamed/resume_file_io.hpp"
#include "solve/streamed/solve_streamed.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/verbs/answer_command.hpp"
#include "tools/words/question_words.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec solve_specs[] = {
    {"--save-roadmap", "FILE", "prm, lazy-prm: keep the roadmap in this file, to ask it again with 'warren query'"},
    {"--certificate", "FILE",
     "on a map, for a point or disc: prove a lower bound of all paths, and keep its proof in this file (.npy), which "
     "'warren verify --certificate FILE' checks"},
    {"--resume", "FILE",
     "with --pipeline streamed: keep finished parts of the work in FILE; a run that was ended goes on from there when "
     "it is started again"},
};

/// What the stages take of a maze that is made here, held or tile by tile, in hundredths, on two threads: `warren solve
/// maze:3000x3000 --no-path --json -` and `maze:20000x20000,algorithm=mst --pipeline streamed`, rounded. Other
/// algorithms and numbers of threads shift it a little.
constexpr ExpectedStage held_maze[] = {{"generate", 22}, {"walls", 24}, {"index", 22}, {"connect", 17},
                                       {"graph", 1},     {"reduce", 1}, {"search", 1}, {"verify", 12}};
constexpr ExpectedStage streamed_maze[] = {{"generate", 63}, {"connect", 32}, {"graph", 1},
                                           {"reduce", 2},    {"search", 1},   {"verify", 1}};

class SolveCommand : public AnswerCommand {
 public:
  explicit SolveCommand(const Arguments& arguments)
      : AnswerCommand(arguments, "--save-roadmap"),
        question_(question_words(arguments)),
        options_(solve_words(arguments)) {
    check_not_written(arguments, question_.robot, question_.prices);
    check_solver_options(options_);
    if (keeps_roadmap()) arguments.refuse({"--resume"}, "is for streamed runs, which keep no roadmap");
  }

 private:
  Answer resumed(const std::string& file, const Run& run) {
    if (!is_unmade(scene_)) {
      throw UsageError(
          "--resume: keeps tiles of mazes that are made tile by tile: of mst and .maze with --pipeline streamed, and "
          "of .npy where --memory does not hold their walls");
    }
    ResumeFile kept(file, run.execution());
    Answer answer =
        solve_streamed_within(scene_, question_, options_, run.execution(), {.taker = path_taker(), .kept = &kept});
    if (kept.found_count() > 0) run.note(fmt::format("went on from {} parts in {}", kept.found_count(), file));
    return answer;
  }
  Answer find(const Run& run, StageTimes& before, ByProducts* keep) override {
    scene_ = load_planned_world(arguments_.operand(0), options_.roadmap.pipeline, arguments_, run.execution(), &before);
    read_asked_files(question_, arguments_, run.execution());
    check_outputs_of(robot_of(scene_, question_));
    if (is_unmade(scene_) && arguments_.has("--explain")) {
      throw UsageError("--explain: looks at walls that are held, and these are made tile by tile");
    }
    if (const auto file = arguments_.value("--resume")) return resumed(*file, run);
    if (!keeps_roadmap()) return solve_explained(scene_, question_, options_, run.execution(), keep, path_taker());
    return solve_and_keep(std::move(scene_), question_, options_, run.execution(), made_roadmap_, keep);
  }
  /// Of mazes as they are usually solved, and where little follows.
  ExpectedStages expected_stages() const override {
    constexpr std::array words{"--planner",   "--sampler",      "--samples", "--robot",   "--start",
                               "--goal",      "--optimise",     "--explain", "--picture", "--path",
                               "--heuristic", "--save-roadmap", "--queue",   "--search"};
    const bool is_usual = std::ranges::none_of(words, [&](const char* word) { return arguments_.has(word); });
    const bool is_written = arguments_.has("--json") && !arguments_.has("--no-path");
    if (!is_usual || is_written || !is_maze_source(arguments_.operand(0))) return {};
    const auto pipeline = options_.roadmap.pipeline;
    if (pipeline == PipelineKind::plain) return {};
    return pipeline == PipelineKind::streamed ? ExpectedStages(streamed_maze) : ExpectedStages(held_maze);
  }
  Scene scene_drawn(const Execution& execution, ByProducts& keep) override {
    if (keeps_roadmap()) return made_roadmap_.world.whole(execution);
    if (is_unmade(scene_)) return read_world(arguments_.operand(0), execution);
    complete(execution, keep);
    return std::move(scene_);
  }
  void explain(const Execution& execution, Answer& answer, ByProducts& keep) override {
    const AskedWith asked{options_};
    if (keeps_roadmap()) return explain_answer(made_roadmap_.world.whole(execution), asked, answer, keep, execution);
    if (answer.outcome != Outcome::stopped) complete(execution, keep);
    explain_answer(scene_, asked, answer, keep, execution);
  }
  void complete(const Execution& execution, ByProducts& keep) {
    if (!completed_) make_by_products(scene_, question_, options_, execution, keep);
    completed_ = true;
  }

  Question question_;
  SolveOptions options_;
  Scene scene_;
  bool completed_ = false;
};

}  // namespace

Command solve_command() {
  return {"solve", "WORLD", "find a path, verify it, print a summary",
          joined_options({solve_option_specs(), question_option_specs(), asked_option_specs(), world_option_specs(),
                          answer_output_specs(), path_option_specs(), solve_specs, run_option_specs()}),
          [](const Arguments& arguments) { return SolveCommand(arguments).run(); }};
}

}  // namespace warren::tools
