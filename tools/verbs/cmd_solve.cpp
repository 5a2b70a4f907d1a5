// SPDX-License-Identifier: BSD-3-Clause
// warren solve: finds a path, verifies it, prints what it took. A stop at any stage still gives an answer.
#include <utility>

#include "solve/solve.hpp"
#include "solve/steps/blocked_end.hpp"
#include "solve/steps/kind_of_problem.hpp"
#include "tools/screen/output_conflicts.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/verbs/answer_command.hpp"
#include "tools/words/planner_words.hpp"
#include "tools/words/question_words.hpp"

namespace warren {
namespace {

class SolveCommand : public AnswerCommand {
 public:
  explicit SolveCommand(const Arguments& arguments)
      : AnswerCommand(arguments), question_(question_words(arguments)), options_(solve_words(arguments)) {
    check_not_written(arguments, question_.robot);
    check_solver_options(options_);
  }

 private:
  Answer find(const Run& run, StageTimes& before, ByProducts* keep) override {
    scene_ = load_world(arguments_.operand(0), arguments_, run.execution(), before);
    Answer answer = solve_within(scene_, question_, options_, run.execution(), keep);
    explain_blocked_end(scene_, answer, run.execution());
    return answer;
  }
  Scene scene_drawn(const Execution& execution, ByProducts& keep) override {
    make_by_products(scene_, question_, options_, execution, keep);
    return std::move(scene_);
  }

  Question question_;
  SolveOptions options_;
  Scene scene_;
};

}  // namespace

Command solve_command() {
  Command command{"solve", "WORLD", "find a path, verify it, print a summary", {}, {}};
  add_options(command.options, solve_option_specs());
  add_options(command.options, question_option_specs());
  add_options(command.options, world_option_specs());
  add_options(command.options, answer_output_specs());
  add_options(command.options, run_option_specs());
  command.run = [](const Arguments& arguments) { return SolveCommand(arguments).run(); };
  return command;
}

}  // namespace warren
