// SPDX-License-Identifier: BSD-3-Clause
// solve(), verify() and compare(), with the program's options as keywords.

#include <pybind11/stl.h>

#include <algorithm>

#include "apps/python/bind.hpp"
#include "apps/studies/comparison_report.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "solve/answer/explanation_text.hpp"
#include "solve/explain_answer.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/replanner.hpp"
#include "solve/solve.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/verbs/cmd_compare.hpp"
#include "tools/words/question_words.hpp"

namespace warren::python {
namespace py = pybind11;
using namespace py::literals;
namespace {

tools::Command solving() {
  return command_of("solve",
                    {tools::solve_option_specs(), tools::question_option_specs(), tools::asked_option_specs()});
}
constexpr tools::OptionSpec narrow_spec[] = {{"--explain", "", "say where along the path there is least room"}};
tools::Command verifying() {
  return command_of("verify", {tools::question_option_specs(), tools::asked_option_specs(), narrow_spec},
                    {"--alternatives", "--stretch", "--keep-to", "--unless-gain"});
}

/// keep_to may be an answer, which no command line holds: it is taken out, and a gain is left.
std::optional<Answer> take_old_answer(py::dict& keywords) {
  if (!keywords.contains("keep_to") || !py::isinstance<KeptAnswer>(keywords["keep_to"])) return std::nullopt;
  return py::object(keywords.attr("pop")("keep_to")).cast<const KeptAnswer&>().answer;
}

/// hole is the second half of --alternatives.
void join_hole(py::dict& keywords) {
  const py::object hole = keywords.attr("pop")("hole", py::none());
  if (hole.is_none()) return;
  const py::object count = keywords.attr("get")("alternatives");
  if (count.is_none()) throw UsageError("hole: is for alternatives");
  keywords["alternatives"] = word_of(count, "alternatives") + "," + word_of(hole, "hole");
}

void write_certificate(const ByProducts& made, const std::string& file, const Execution& execution) {
  if (made.certificate) return write_npy(*made.certificate, file, execution);
  constexpr const char* none = "certificate: there is no bound of all paths to prove, so it is not written";
  if (PyErr_WarnEx(PyExc_UserWarning, none, 1) != 0) throw py::error_already_set();
}

/// The answer as the program makes it; a stopped one, too, unless Python's handler of a signal raises.
KeptAnswer solve_scene(const Scene& scene, py::dict keywords, bool keep, bool explain, py::object on_improvement) {
  CallLimits limits = take_limits(keywords);
  limits.tell_improvements(std::move(on_improvement));
  const std::optional<Answer> old = take_old_answer(keywords);
  const auto certificate = take_word(keywords, "certificate");
  join_hole(keywords);
  const tools::Arguments words = arguments_of(made_once<solving>(), keywords);
  Question question = tools::question_words(words);
  const SolveOptions options = tools::solve_words(words);
  check_solver_options(options);
  KeptAnswer kept;
  kept.made.wants_certificate = certificate.has_value();
  kept.answer = limits.run([&](const Execution& execution) {
    tools::read_asked_files(question, words, execution);
    if (old) keep_to(question.route, recorded(*old));
    Answer answer =
        solve_explained(scene, question, options, execution, keep || explain || certificate ? &kept.made : nullptr);
    const auto complete = [&] {
      if (answer.outcome != Outcome::stopped) make_by_products(scene, question, options, execution, kept.made);
    };
    if (keep) complete();
    if (explain) {
      explain_in_time(answer, [&] {
        if (!keep) complete();
        explain_answer(scene, AskedWith{options}, answer, kept.made, execution);
      });
    }
    return answer;
  });
  if (certificate) write_certificate(kept.made, *certificate, Execution());
  return finished(std::move(kept), keep, limits);
}

/// With explain the narrowest place of a free path, too; "ended" says what stopped the search for it.
py::dict judge(const Scene& scene, RecordedAnswer answer, py::dict keywords) {
  CallLimits limits = take_limits(keywords);
  const auto certificate = take_word(keywords, "certificate");
  const tools::Arguments words = arguments_of(made_once<verifying>(), keywords);
  Question question = tools::question_words(words);
  std::optional<NarrowPlace> narrow;
  std::optional<StopReason> ended;
  const Verdict verdict = limits.run([&](const Execution& execution) {
    read_masks(question.prices.empty() ? answer.problem.prices : question.prices, execution);
    if (certificate) answer.certificate = read_potential_npy(InputFile(*certificate, execution), execution);
    Verdict said = verify_within(scene, question, answer, execution);
    if (!words.has("--explain") || !said.verified) return said;
    try {
      narrow = narrowest_place(scene, said.problem.question(), answer, said.min_clearance, execution);
    } catch (const Stopped& stopped) {
      ended = stopped.reason;
    }
    return said;
  });
  if (ended) limits.raise_what_stopped(*ended);
  const auto& violation = verdict.first_violation;
  return py::dict(
      "verified"_a = verdict.verified, "length"_a = verdict.length, "min_clearance"_a = verdict.min_clearance,
      "violation"_a =
          violation ? py::object(py::make_tuple(violation->leg, violation->distance, violation->obstacle)) : py::none(),
      "narrowest"_a = narrowest_json(narrow), "ended"_a = ended ? std::optional(text_of(*ended)) : std::nullopt);
}

/// Its states have as many numbers as it has joints, which the judge counts.
bool is_arm_of_files(const Scene& scene, const py::dict& keywords) {
  py::dict words = keywords.attr("copy")();
  take_limits(words);
  take_word(words, "certificate");
  const Question question = tools::question_words(arguments_of(made_once<verifying>(), words));
  return robot_of(scene, question).kind == RobotKind::urdf;
}

py::dict judge_states(const Scene& scene, const py::object& states, const py::dict& keywords) {
  const NumberRows rows = is_arm_of_files(scene, keywords)
                              ? rows_of(states, "path", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, most_joints})
                              : rows_of(states, "path", {2, 3, 6});
  RecordedAnswer answer;
  answer.file = "path";
  if (scene.start.empty() && rows.rows > 0) answer.problem.start = rows.row(0);
  if (scene.goal.empty() && rows.rows > 0) answer.problem.goal = rows.row(rows.rows - 1);
  if (rows.columns != 2) answer.states.width = rows.columns;
  for (std::size_t i = 0; i < rows.rows; ++i) {
    const double* state = rows.numbers + i * rows.columns;
    answer.path.push_back({state[0], state[std::min<std::size_t>(1, rows.columns - 1)]});
    if (rows.columns != 2) answer.states.add({state, rows.columns});
  }
  return judge(scene, answer, keywords);
}

/// file: opened, or its name.
template <class File>
RecordedAnswer read_recorded(const File& file) {
  return CallLimits().run([&](const Execution& execution) { return read_answer(file, execution); });
}

tools::Command comparing() {
  tools::Command command =
      command_of("compare", {tools::compare_option_specs()}, {"--pictures", "--show", "--size", "--dpi", "--title"});
  command.operands = "[WORLD]";
  command.options.push_back(
      {"--budget", "TIME", "each run, of a planner or a search, may take so long (default: none)"});
  return command;
}

/// A copy of the world is changed.
std::unique_ptr<Replanner> replanner_of(const Scene& scene, py::dict keywords) {
  const std::optional<Answer> old = take_old_answer(keywords);
  join_hole(keywords);
  const tools::Arguments words = arguments_of(made_once<solving>(), keywords);
  Question question = tools::question_words(words);
  const SolveOptions options = tools::solve_words(words);
  check_solver_options(options);
  CallLimits().run([&](const Execution& execution) { tools::read_asked_files(question, words, execution); });
  if (old) keep_to(question.route, recorded(*old));
  return std::make_unique<Replanner>(scene, std::move(question), options);
}

void change_cells(Replanner& replanner, const std::vector<std::array<std::uint32_t, 2>>& cells, bool blocked) {
  std::vector<CellChange> changes;
  for (const auto& [x, y] : cells) changes.push_back({{x, y}, blocked});
  replanner.update(changes);
}

KeptAnswer replanned(Replanner& replanner, const std::vector<double>& start, py::dict keywords) {
  CallLimits limits = take_limits(keywords);
  KeptAnswer kept;
  kept.answer = limits.run([&](const Execution& execution) { return replanner.solve_within(start, execution); });
  return finished(std::move(kept), false, limits);
}

/// Without a world random graphs alone.
studies::Comparison compare(const Scene* scene, py::dict keywords) {
  const auto each_budget = take_word(keywords, "budget", "s");
  CallLimits limits = take_limits(keywords);
  keywords["budget"] = each_budget;
  std::vector<std::string> world;
  if (scene != nullptr) world.push_back(scene->source);
  const tools::CompareOptions options =
      tools::compare_options(arguments_of(made_once<comparing>(), keywords, std::move(world)));
  studies::Comparison comparison;
  limits.run([&](const Execution& execution) {
    tools::run_comparison(options, scene, execution, comparison, [](std::string_view) {});
  });
  if (comparison.stopped) {
    limits.raise_what_stopped(*comparison.stopped);
    throw Stopped(*comparison.stopped);
  }
  return comparison;
}

}  // namespace

KeptAnswer finished(KeptAnswer said, bool keep, CallLimits& limits) {
  const auto& explained = said.answer.explained;
  for (const auto& reason : {said.answer.stop_reason, explained ? explained->stopped : std::nullopt}) {
    if (reason) limits.raise_what_stopped(*reason);
  }
  if (!keep) said.made = {};
  return said;
}

void bind_solving(py::module_& module) {
  module.def("solve", &solve_scene);
  module.def("verify_states", &judge_states);
  module.def("verify_json", [](const Scene& scene, const std::string& json, const py::dict& keywords) {
    return judge(scene, read_recorded(InputFile::of_bytes("answer", json)), keywords);
  });
  module.def("verify_file", [](const Scene& scene, const std::string& file, const py::dict& keywords) {
    return judge(scene, read_recorded(file), keywords);
  });
  py::class_<Replanner>(module, "Replanner")
      .def(py::init(&replanner_of))
      .def("change_cells", &change_cells)
      .def("change_box",
           [](Replanner& replanner, double left, double low, double right, double high, bool blocked) {
             replanner.update({{left, low}, {right, high}}, blocked);
           })
      .def("solve", &replanned)
      .def("scene", [](const Replanner& replanner) { return replanner.scene(); });
  module.def("solve_keywords", [] { return keyword_table(made_once<solving>()); });
  module.def("verify_keywords", [] { return keyword_table(made_once<verifying>()); });
  py::class_<studies::Comparison>(module, "Comparison")
      .def("runs_csv", &studies::comparison_runs)
      .def("table_csv", &studies::comparison_csv)
      .def("json", &studies::comparison_json)
      .def("curves_csv", &studies::comparison_curves)
      .def("svg", [](const studies::Comparison& comparison) { return studies::comparison_plots(comparison).svg(); })
      .def("summary", [](const studies::Comparison& comparison) {
        return studies::comparison_summary(comparison, Palette(false));
      });
  module.def("compare", &compare, py::arg().none(true), py::arg());
  module.def("compare_keywords", [] { return keyword_table(made_once<comparing>()); });
}

}  // namespace warren::python
