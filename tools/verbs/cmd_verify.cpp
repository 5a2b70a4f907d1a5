// SPDX-License-Identifier: BSD-3-Clause
// warren verify: is the path of an answer free, all along and with all its clearance? Decided by worlds/verify alone.
#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/question/kind_of_problem.hpp"
#include "solve/question/question.hpp"
#include "solve/question/read_answer_io.hpp"
#include "solve/question/write_answer_io.hpp"
#include "studies/measure/human_units.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_conflicts.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/command.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {
namespace {

constexpr OptionSpec verify_specs[] = {
    {"--json", "FILE", "write the verdict as JSON; - is standard output"},
};

/// Options first, then the answer's word; the world's and the defaults come after both.
ProblemOptions merged(ProblemOptions options, const ProblemOptions& answer) {
  if (!options.robot) options.robot = answer.robot;
  if (options.start.empty()) options.start = answer.start;
  if (options.goal.empty()) options.goal = answer.goal;
  if (!options.clearance) options.clearance = answer.clearance;
  if (!options.contact) options.contact = answer.contact;
  return options;
}

/// The length that an answer claims is a part of what is verified.
void check_length(Verification& verification, const RecordedAnswer& answer) {
  constexpr double rounding = 1e-9;
  if (verification.verified && answer.length &&
      std::abs(*answer.length - verification.length) > rounding * verification.length) {
    verification.verified = false;
    verification.first_violation =
        Violation{.leg = 0, .distance = 0.0, .obstacle = fmt::format("length: the answer says {}", *answer.length)};
  }
}

std::string verdict_json(const Verification& v) {
  const std::string violation = v.first_violation ? violation_json(*v.first_violation) : "null";
  return fmt::format(
      "{{\"schema\": \"warren.verify/1\",\n \"verified\": {},\n \"length\": {},\n \"min_clearance\": {},\n "
      "\"first_violation\": {}}}\n",
      v.verified, json_number(v.length), json_number(v.min_clearance), violation);
}

void print_verdict(const Verification& v, const Problem& problem, const Palette& palette) {
  if (v.verified) {
    print_text(fmt::format("{}: length {}, clearance {} at least, {} asked for\n", palette.good("verified"),
                           human_number(v.length), human_number(v.min_clearance), human_number(problem.clearance)));
  } else {
    const Violation violation = v.first_violation.value_or(Violation{});
    print_text(fmt::format("{} at leg {}: {}, distance {}, {} asked for\n", palette.bad("refuted"), violation.leg,
                           violation.obstacle, human_number(violation.distance),
                           human_number(problem.clearance + problem.robot.radius)));
  }
}

int verify(const Arguments& arguments) {
  const auto json = output_file(arguments, "--json");
  const ProblemOptions options = problem_options(arguments);
  if (arguments.operand(0) == "-" && arguments.operand(1) == "-") {
    throw UsageError("WORLD and ANSWER.json can't both come from standard input");
  }
  Run run(arguments);
  StageTimes seconds;
  const RecordedAnswer answer = read_answer(arguments.operand(1), run.execution());
  const Scene scene = load_world(arguments.operand(0), arguments, run.execution(), seconds);
  check_same_world(answer, arguments.operand(1), scene, run.execution());
  if (answer.problem.robot) check_not_written(arguments, answer.problem.robot->table);
  const ProblemOptions asked = merged(options, answer.problem);
  const SolveKind& kind = verifying_kind(scene, asked);
  Verdict verdict;
  {
    const StageTimer timer(run.execution(), "verify", seconds.verify, answer.path.size() + scene.walls.size());
    verdict = kind.verify(scene, asked, answer, run.execution());
    check_length(verdict.verification, answer);
  }
  const auto& [verification, problem] = verdict;
  run.end();
  if (json) write_file(*json, verdict_json(verification), run.execution());
  if (!run.quiet() && json != "-") print_verdict(verification, problem, run.palette());
  return verification.verified ? exit_code::success : exit_code::no_path;
}

}  // namespace

Command verify_command() {
  Command command{"verify", "WORLD ANSWER.json", "re-check an answer independently", {}, verify};
  add_options(command.options, problem_option_specs());
  add_options(command.options, verify_specs);
  add_options(command.options, world_option_specs());
  add_options(command.options, run_option_specs());
  return command;
}

}  // namespace warren
