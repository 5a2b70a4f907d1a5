// SPDX-License-Identifier: BSD-3-Clause
// solve() and verify(), with the program's options as keywords.
#include <pybind11/stl.h>

#include <fmt/format.h>

#include "parallel/deadline.hpp"
#include "python/arrays.hpp"
#include "python/bind.hpp"
#include "python/keywords.hpp"
#include "scenes/text/input_file_io.hpp"
#include "solve/solve.hpp"
#include "solve/steps/blocked_end.hpp"
#include "solve/steps/kind_of_problem.hpp"
#include "tools/words/planner_words.hpp"
#include "tools/words/question_words.hpp"

namespace warren::python {
namespace py = pybind11;
namespace {

const Command& solving() {
  static const Command command = [] {
    Command made{"solve", "", "", {}, {}};
    add_options(made.options, solve_option_specs());
    add_options(made.options, question_option_specs());
    return made;
  }();
  return command;
}

const Command& verifying() {
  static const Command command = [] {
    Command made{"verify", "", "", {}, {}};
    add_options(made.options, question_option_specs());
    return made;
  }();
  return command;
}

/// The answer as the program makes it; a stopped one, too, unless Python's handler of a signal raises.
KeptAnswer solve_scene(const Scene& scene, py::dict keywords, bool keep) {
  CallLimits limits = take_limits(keywords);
  const Arguments words = arguments_of(solving(), keywords);
  const Question question = question_words(words);
  const SolveOptions options = solve_words(words);
  check_solver_options(options);
  KeptAnswer kept;
  kept.answer = limits.run([&](const Execution& execution) {
    Answer answer = solve_within(scene, question, options, execution, keep ? &kept.made : nullptr);
    price_heuristic(scene, question, options, execution, answer);
    if (is_blocked(answer.outcome)) explain_blocked_end(scene, answer, execution);
    if (keep) make_by_products(scene, question, options, execution, kept.made);
    answer.threads = thread_count(execution.threads);
    answer.peak_memory_bytes = peak_resident_bytes();
    return answer;
  });
  if (kept.answer.stop_reason) limits.raise_what_stopped(*kept.answer.stop_reason);
  return kept;
}

py::dict told(const Verdict& verdict) {
  py::dict account;
  account["verified"] = verdict.verified;
  account["length"] = verdict.length;
  account["min_clearance"] = verdict.min_clearance;
  account["violation"] = py::none();
  if (const auto& violation = verdict.first_violation) {
    account["violation"] = py::make_tuple(violation->leg, violation->distance, violation->obstacle);
  }
  return account;
}

py::dict judge(const Scene& scene, const RecordedAnswer& answer, py::dict keywords) {
  CallLimits limits = take_limits(keywords);
  const Question question = question_words(arguments_of(verifying(), keywords));
  return told(
      limits.run([&](const Execution& execution) { return verify_within(scene, question, answer, execution); }));
}

py::dict judge_states(const Scene& scene, const py::object& states, const py::dict& keywords) {
  const NumberRows rows = rows_of(states, "path", {2, 3, 6});
  RecordedAnswer answer;
  answer.file = "path";
  if (rows.columns != 2) answer.states.width = rows.columns;
  for (std::size_t i = 0; i < rows.rows; ++i) {
    const double* state = rows.numbers + i * rows.columns;
    answer.path.push_back({state[0], state[1]});
    if (rows.columns != 2) answer.states.add({state, rows.columns});
  }
  return judge(scene, answer, keywords);
}

RecordedAnswer recorded(const InputFile& file) {
  return CallLimits().run([&](const Execution& execution) { return read_answer(file, execution); });
}

}  // namespace

void bind_solving(py::module_& module) {
  module.def("solve", &solve_scene);
  module.def("verify_states", &judge_states);
  module.def("verify_json", [](const Scene& scene, const std::string& json, const py::dict& keywords) {
    return judge(scene, recorded(InputFile::of_bytes("answer", json)), keywords);
  });
  module.def("verify_file", [](const Scene& scene, const std::string& file, const py::dict& keywords) {
    CallLimits limits;
    const RecordedAnswer answer = limits.run([&](const Execution& execution) { return read_answer(file, execution); });
    return judge(scene, answer, keywords);
  });
  module.def("solve_keywords", [] { return keyword_table(solving()); });
  module.def("verify_keywords", [] { return keyword_table(verifying()); });
}

}  // namespace warren::python
