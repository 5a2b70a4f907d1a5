// SPDX-License-Identifier: BSD-3-Clause
// Planners compared in a world and searches on graphs, as `warren compare` does.
#include <pybind11/stl.h>

#include "parallel/deadline.hpp"
#include "python/bind.hpp"
#include "python/keywords.hpp"
#include "studies/compare/comparison_report.hpp"
#include "tools/verbs/compare_options.hpp"
#include "tools/verbs/run_comparison.hpp"

namespace warren::python {
namespace py = pybind11;
namespace {

tools::Command comparing() {
  tools::Command command =
      command_of("compare", {tools::compare_option_specs()}, {"--pictures", "--show", "--size", "--dpi", "--title"});
  command.operands = "[WORLD]";
  command.options.push_back(
      {"--budget", "TIME", "each run, of a planner or a search, may take so long (default: none)"});
  return command;
}

/// Without a world random graphs alone.
studies::Comparison compare(const Scene* scene, py::dict keywords) {
  if (keywords.contains("budget") && !keywords["budget"].is_none()) {
    keywords["budget"] = budget_word(keywords["budget"]);
  }
  const py::object each_budget = keywords.attr("pop")("budget", py::none());
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

void bind_studies(py::module_& module) {
  py::class_<studies::Comparison>(module, "Comparison")
      .def("runs_csv", &studies::comparison_runs)
      .def("table_csv", &studies::comparison_csv)
      .def("json", &studies::comparison_json)
      .def("svg", [](const studies::Comparison& comparison) { return studies::comparison_plots(comparison).svg(); })
      .def("summary", [](const studies::Comparison& comparison) {
        return studies::comparison_summary(comparison, Palette(false));
      });
  module.def("compare", &compare, py::arg().none(true), py::arg());
  module.def("compare_keywords", [] { return keyword_table(made_once<comparing>()); });
}

}  // namespace warren::python
