// SPDX-License-Identifier: BSD-3-Clause
// Planners compared on a world, as `warren compare --planners` does.
#include <pybind11/stl.h>

#include "core/base/error.hpp"
#include "python/bind.hpp"
#include "python/keywords.hpp"
#include "studies/compare/comparison_report.hpp"
#include "studies/contests/planner_contest.hpp"
#include "tools/verbs/compare_options.hpp"

namespace warren::python {
namespace py = pybind11;
namespace {

const Command& comparing() {
  static const Command command = [] {
    Command made{"compare", "[WORLD]", "", {}, {}};
    add_options(made.options, compare_option_specs(),
                {"--trials", "--peer", "--graph", "--sizes", "--degree", "--pictures"});
    made.options.push_back({"--budget", "TIME", "each run may take so long (default: none)"});
    return made;
  }();
  return command;
}

Comparison compare_planners(const Scene& scene, py::dict keywords) {
  if (keywords.contains("budget") && !keywords["budget"].is_none()) {
    keywords["budget"] = budget_word(keywords["budget"]);
  }
  const py::object each_budget = keywords.attr("pop")("budget", py::none());
  CallLimits limits = take_limits(keywords);
  keywords["budget"] = each_budget;
  const Arguments words = arguments_of(comparing(), keywords, {"WORLD"});
  if (!words.has("--planners")) throw UsageError("planners: which ones? a list of planners of solve()");
  const CompareOptions options = compare_options(words);
  Comparison comparison;
  limits.run([&](const Execution& execution) {
    std::optional<Scene> copy;
    const RobotKind body = robot_of(scene, options.planners->contenders.front().question).kind;
    const bool plans_on_cells = body == RobotKind::point || body == RobotKind::disc;
    run_planner_contest(plans_on_cells ? scene : bordered(scene, copy, execution), *options.planners, execution,
                        comparison);
  });
  return comparison;
}

}  // namespace

void bind_studies(py::module_& module) {
  py::class_<Comparison>(module, "Comparison")
      .def("runs_csv", &comparison_runs)
      .def("table_csv", &comparison_csv)
      .def("json", &comparison_json)
      .def("svg", &comparison_svg)
      .def("summary", [](const Comparison& comparison) { return comparison_summary(comparison, Palette(false)); });
  module.def("compare", &compare_planners);
  module.def("compare_keywords", [] { return keyword_table(comparing()); });
}

}  // namespace warren::python
