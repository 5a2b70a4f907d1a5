// SPDX-License-Identifier: BSD-3-Clause
// Roadmaps: built, asked, updated, in files, as arrays.
#include <pybind11/stl.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "parallel/deadline.hpp"
#include "pictures/draw_roadmap.hpp"
#include "python/bind.hpp"
#include "python/kept_roadmap.hpp"
#include "python/keywords.hpp"
#include "python/roadmap_arrays.hpp"
#include "solve/roadmaps/export_of_roadmap.hpp"
#include "solve/roadmaps/roadmap_file_io.hpp"
#include "solve/steps/blocked_end.hpp"
#include "solve/steps/heuristic_price.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/planner_words.hpp"
#include "tools/words/question_words.hpp"

namespace warren::python {
namespace py = pybind11;
namespace {

using Kept = std::unique_ptr<KeptRoadmap>;

/// The options of one of the program's verbs that say how it works, not where things are written.
Command of_verb(const Command& verb, std::initializer_list<std::string_view> without) {
  Command made{verb.name, "", "", {}, {}};
  made.foreign = verb.foreign;
  for (const OptionSpec& spec : verb.options) {
    if (std::find(without.begin(), without.end(), spec.name) == without.end()) made.options.push_back(spec);
  }
  return made;
}

const Command& building() {
  static const Command command =
      of_verb(build_command(), {"--output", "--no-world", "--map-rules", "--threads", "--budget", "--memory", "--quiet",
                                "--progress", "--color", "--trace"});
  return command;
}

/// The options of `warren query` that say how a search works.
Command search_command(std::string_view name) {
  Command made = of_verb(query_command(), {});
  made.name = name;
  constexpr std::string_view kept[] = {"--search",    "--heuristic",    "--queue", "--optimise",
                                       "--cusp-cost", "--reverse-cost", "--attach"};
  std::erase_if(made.options, [&](const OptionSpec& spec) {
    return std::find(std::begin(kept), std::end(kept), spec.name) == std::end(kept);
  });
  return made;
}

const Command& asking() {
  static const Command command = [] {
    Command made = search_command("query");
    for (const OptionSpec& spec : query_command().options) {
      if (spec.name == "--start" || spec.name == "--goal") made.options.push_back(spec);
    }
    return made;
  }();
  return command;
}

const Command& asking_lengths(bool each_to_each) {
  static const Command pairs = search_command("lengths");
  static const Command matrix = search_command("matrix");
  return each_to_each ? matrix : pairs;
}

RoadmapSearchFields how_to_search(const Arguments& arguments) {
  const SolveOptions words = solve_words(arguments);
  return {words.search,           words.queue,    words.roadmap.attach, words.optimise, words.car.cusp_cost,
          words.car.reverse_cost, words.heuristic};
}

Kept build_roadmap(const Scene& scene, py::dict keywords) {
  CallLimits limits = take_limits(keywords);
  const Arguments words = arguments_of(building(), keywords);
  const Question question = question_words(words);
  const SolveOptions options = solve_words(words);
  const auto index = given_choice<IndexChoice>(words, "--index").value_or(IndexChoice::where_it_pays);
  return limits.run([&](const Execution& execution) {
    return std::make_unique<KeptRoadmap>(build_within(scene, question, options, execution, index));
  });
}

Kept open_roadmap(const std::string& file, const Scene* world, py::dict keywords) {
  CallLimits limits = take_limits(keywords);
  arguments_of({"open", "", "", {}, {}}, keywords);
  return limits.run([&](const Execution& execution) {
    std::optional<Scene> given;
    if (world != nullptr) given = *world;
    return std::make_unique<KeptRoadmap>(read_roadmap(file, execution, std::move(given)));
  });
}

py::tuple update_roadmap(KeptRoadmap& old, const Scene& now, py::dict keywords) {
  CallLimits limits = take_limits(keywords);
  arguments_of({"update", "", "", {}, {}}, keywords);
  const Asking asking(old);
  UpdateAccount account;
  Kept next = limits.run([&](const Execution& execution) {
    return std::make_unique<KeptRoadmap>(update(old.roadmap(), now, execution, &account));
  });
  py::dict report;
  report["mode"] = account.built_anew ? "built" : "changed";
  report["edges"] = account.edges;
  report["edges_checked"] = account.edges_checked;
  report["states_added"] = account.states_added;
  report["states_dropped"] = account.states_dropped;
  return py::make_tuple(py::cast(std::move(next)), report);
}

KeptAnswer ask(KeptRoadmap& kept, py::dict keywords, bool keep) {
  CallLimits limits = take_limits(keywords);
  const Arguments words = arguments_of(asking(), keywords);
  const Question question = question_words(words);
  const RoadmapSearchFields how = how_to_search(words);
  const Asking asking(kept);
  KeptAnswer said;
  said.answer = limits.run([&](const Execution& execution) {
    QuestionScratch scratch;
    const RoadmapQuery& query = kept.query(execution);
    Answer answer =
        query.ask_within(question.start, question.goal, how, execution, scratch, keep ? &said.made : nullptr);
    price_heuristic(answer, how.heuristic, [&](HeuristicKind exact) {
      RoadmapSearchFields again = how;
      again.heuristic = exact;
      again.optimise = false;
      return query.ask_within(question.start, question.goal, again, execution, scratch);
    });
    if (is_blocked(answer.outcome)) explain_blocked_end(kept.roadmap().world.whole(execution), answer, execution);
    answer.threads = thread_count(execution.threads);
    answer.peak_memory_bytes = peak_resident_bytes();
    return answer;
  });
  if (said.answer.stop_reason) limits.raise_what_stopped(*said.answer.stop_reason);
  return said;
}

py::array lengths(KeptRoadmap& kept, const py::object& from, const py::object& to, bool each_to_each,
                  py::dict keywords) {
  CallLimits limits = take_limits(keywords);
  const RoadmapSearchFields how = how_to_search(arguments_of(asking_lengths(each_to_each), keywords));
  const std::size_t width = state_size(kept.roadmap().robot);
  const NumberRows starts = rows_of(from, "starts", {width});
  const NumberRows goals = width == 3   ? rows_of(to, "goals", {3, 2})
                           : width == 6 ? rows_of(to, "goals", {6, 3})
                                        : rows_of(to, "goals", {2});
  if (!each_to_each && starts.rows != goals.rows && starts.rows != 1 && goals.rows != 1) {
    throw py::value_error("starts and goals: expected as many of both, or one of either (found: " +
                          std::to_string(starts.rows) + " and " + std::to_string(goals.rows) + ")");
  }
  const auto size = [](std::size_t n) { return static_cast<py::ssize_t>(n); };
  const bool none = starts.rows == 0 || goals.rows == 0;
  py::array_t<double> told(each_to_each ? Shape{size(starts.rows), size(goals.rows)}
                                        : Shape{none ? 0 : size(std::max(starts.rows, goals.rows))});
  if (none) return told;
  double* numbers = told.mutable_data();
  const Asking asking(kept);
  limits.run(
      [&](const Execution& execution) { ask_lengths(kept, starts, goals, each_to_each, how, execution, numbers); });
  return told;
}

py::dict export_to(KeptRoadmap& kept, const std::string& file, bool unchecked, const std::string& frame) {
  const Asking asking(kept);
  const ExportAccount account = CallLimits().run([&](const Execution& execution) {
    return export_of_roadmap(kept.roadmap(), file, {.with_unchecked = unchecked, .frame = frame}, execution);
  });
  py::dict told;
  told["vertices"] = account.vertices;
  told["edges"] = account.edges;
  told["unchecked_left_out"] = account.unchecked_left_out;
  told["blocked_left_out"] = account.blocked_left_out;
  return told;
}

py::tuple counts(KeptRoadmap& kept) {
  const Asking asking(kept);
  const EdgeCounts edges =
      CallLimits().run([&](const Execution& execution) { return count_edges(kept.roadmap(), execution); });
  return py::make_tuple(count_states(kept.roadmap()), edges.free, edges.blocked, edges.unchecked);
}

void learn_from_questions(KeptRoadmap& kept) {
  const Learning learning(kept);
  CallLimits().run([&](const Execution& execution) { kept.learn(execution); });
}

}  // namespace

void bind_roadmaps(py::module_& module) {
  py::class_<KeptRoadmap>(module, "Roadmap")
      .def_property_readonly(
          "world",
          [](const KeptRoadmap& kept) -> const Scene& {
            const Scene* whole = nullptr;
            CallLimits().run([&](const Execution& execution) { whole = &kept.roadmap().world.whole(execution); });
            return *whole;
          },
          py::return_value_policy::reference_internal)
      .def_property_readonly("robot", [](const KeptRoadmap& kept) { return robot_text(kept.roadmap().robot); })
      .def_property_readonly("clearance", [](const KeptRoadmap& kept) { return kept.roadmap().clearance; })
      .def_property_readonly("seed", [](const KeptRoadmap& kept) { return kept.roadmap().options.seed; })
      .def_property_readonly("planner",
                             [](const KeptRoadmap& kept) {
                               const auto planner = kept.roadmap().options.planner;
                               return planner ? std::optional(name_of(*planner)) : std::nullopt;
                             })
      .def_property_readonly("directed", [](const KeptRoadmap& kept) { return kept.roadmap().arrays.directed; })
      .def_property_readonly("indexed", [](const KeptRoadmap& kept) { return kept.roadmap().lattice != nullptr; })
      .def("ask", &ask)
      .def("lengths", &lengths)
      .def("all_rows", &all_rows)
      .def("free_rows", &free_rows_of)
      .def("edge_states", &edge_states)
      .def_property_readonly("states", &states_of)
      .def("components", &components_of)
      .def("counts", &counts)
      .def("learn", &learn_from_questions)
      .def("update", &update_roadmap)
      .def("export", &export_to)
      .def("save",
           [](KeptRoadmap& kept, const std::string& file, bool with_world) {
             const Asking asking(kept);
             CallLimits().run([&](const Execution& on) { write_roadmap(kept.roadmap(), file, on, with_world); });
           })
      .def("draw", [](KeptRoadmap& kept, const std::string& file) {
        const Asking asking(kept);
        CallLimits().run([&](const Execution& on) { write_picture(file, kept.roadmap(), {}, "", on); });
      });
  module.def("build", &build_roadmap);
  module.def("open_roadmap", &open_roadmap, py::arg(), py::arg().none(true), py::arg());
  module.def("build_keywords", [] { return keyword_table(building()); });
  module.def("query_keywords", [] { return keyword_table(asking()); });
  module.def("lengths_keywords", [] { return keyword_table(asking_lengths(false)); });
}

}  // namespace warren::python
