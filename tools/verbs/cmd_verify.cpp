// SPDX-License-Identifier: BSD-3-Clause
// warren verify: is the path of an answer free, all along and with all its clearance? Decided by verify/ alone.
#include <fmt/format.h>

#include "core/base/error.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/answer/explanation_text.hpp"
#include "solve/answer/read_answer_io.hpp"
#include "solve/answer/write_answer_io.hpp"
#include "solve/explain_answer.hpp"
#include "solve/solve.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/question_words.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec verify_specs[] = {
    {"--json", "FILE", "write the verdict as JSON; - is standard output"},
    {"--certificate", "FILE", "the proof of the answer's lower bound, as 'warren solve --certificate FILE' keeps it"},
    {"--explain", "", "say where along the path there is least room"},
};

/// narrowest: as JSON; empty: nobody asked.
std::string verdict_json(const Verdict& v, const std::string& narrowest) {
  JsonObject json(",\n ", ": ");
  json.add("schema", "warren.verify/1", "verified", v.verified, "length", v.length, "min_clearance", v.min_clearance);
  json.add_json("first_violation", v.first_violation ? violation_json(*v.first_violation) : "null");
  json.add_or_null("bound", v.bound != BoundVerdict::absent, name_of(v.bound));
  if (!narrowest.empty()) json.add_json("narrowest", narrowest);
  return json.closed() + "\n";
}

std::string verdict_text(const Verdict& v, std::string_view metres, const Palette& palette) {
  const double clearance = v.problem.clearance;
  if (v.verified) {
    return fmt::format("{0}: length {2}{1}, clearance {3}{1} at least, {4}{1} asked for{5}\n", palette.good("verified"),
                       metres, human_number(v.length), human_number(v.min_clearance), human_number(clearance),
                       v.bound == BoundVerdict::absent ? "" : fmt::format(", lower bound {}", name_of(v.bound)));
  }
  const Violation violation = v.first_violation.value_or(Violation{});
  if (violation.kind == ViolationKind::claim) {
    return fmt::format("{}, {}\n", palette.bad("refuted"), violation.obstacle);
  }
  if (violation.kind == ViolationKind::motion) {
    return fmt::format("{} at leg {}: {}\n", palette.bad("refuted"), violation.leg, violation.obstacle);
  }
  const std::string distance = human_number(violation.distance);
  std::string needed = human_number(clearance + v.problem.robot.radius);
  return fmt::format("{0} at leg {2}: {3}, distance {4}{1}, {5} asked for\n", palette.bad("refuted"), metres,
                     violation.leg, violation.obstacle, distance,
                     distance == needed ? "a hair more" : needed.append(metres));
}

int verify_answer(const Arguments& arguments) {
  const auto json = output_file(arguments, "--json");
  if (arguments.operand(0).ends_with(".json") && !arguments.operand(1).ends_with(".json")) {
    throw UsageError(fmt::format("the world comes first, then its answer: warren verify {} {}", arguments.operand(1),
                                 arguments.operand(0)));
  }
  Question question = question_words(arguments);
  check_not_written(arguments, question.robot, question.prices);
  Run run(arguments);
  RecordedAnswer answer = read_answer(arguments.operand(1), run.execution());
  read_asked_files(question.prices.empty() ? answer.problem : question, arguments, run.execution());
  if (const auto proof = arguments.value("--certificate")) {
    answer.certificate = read_potential_npy(InputFile(*proof, run.execution()), run.execution());
  }
  const Scene scene =
      load_planned_world(arguments.operand(0), std::nullopt, arguments, run.execution(), nullptr, answer.problem.robot);
  check_not_written(arguments, answer.problem.robot);
  const Verdict verdict = run.in_stage(
      "verify", nullptr, [&] { return verify_within(scene, question, answer, run.execution()); },
      answer.path.size() + scene.walls.size());
  const bool explains = arguments.has("--explain");
  std::optional<NarrowPlace> narrow;
  const auto stopped = stopped_by([&] {
    if (!explains || !verdict.verified) return;
    narrow = narrowest_place(scene, verdict.problem.question(), answer, verdict.min_clearance, run.execution());
  });
  if (stopped) run.note(fmt::format("--explain ended early, {}; the verdict stands", text_of(*stopped)));
  run.end();
  const std::string told = explains ? narrowest_json(narrow) : "";
  if (json) write_file(*json, verdict_json(verdict, told), run.execution_for_what_is_left());
  run.conclude([&] {
    return verdict_text(verdict, metres_behind(unit_of(scene)), run.palette()) +
           (narrow ? text_of(*narrow) + "\n" : std::string());
  });
  return verdict.verified ? exit_code::success : exit_code::no_path;
}

}  // namespace

Command verify_command() {
  return {
      "verify", "WORLD ANSWER.json", "re-check an answer independently",
      joined_options({question_option_specs(),
                      options_but(asked_option_specs(), {"--alternatives", "--stretch", "--keep-to", "--unless-gain"}),
                      verify_specs, world_option_specs(), run_option_specs()}),
      verify_answer};
}

}  // namespace warren::tools
