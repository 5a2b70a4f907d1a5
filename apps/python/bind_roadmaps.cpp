// SPDX-License-Identifier: BSD-3-Clause
// Roadmaps: built, asked, updated, in files, as arrays.

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "apps/python/bind.hpp"
#include "core/search/graph.hpp"
#include "parallel/chunks.hpp"
#include "solve/explain_answer.hpp"
#include "solve/kept/export_roadmap.hpp"
#include "solve/kept/roadmap_file_io.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/question_words.hpp"

namespace warren::python {
namespace py = pybind11;
using namespace py::literals;
namespace {

/// indptr, indices and lengths of all edges: views that keep the roadmap, `self`, alive.
py::tuple all_rows(const py::object& self) {
  auto& kept = self.cast<KeptRoadmap&>();
  const Asking asking(kept);
  const RawVector<double>* lengths = nullptr;
  const RoadmapArrays* arrays = nullptr;
  CallLimits().run([&](const Execution& execution) {
    arrays = &kept.arrays(execution);
    lengths = &kept.lengths(execution);
  });
  // Below 2^31 unsigned numbers are the same bits as numbers with a sign, which SciPy has.
  const auto signed_view = [&](const auto& list) {
    return view_of(reinterpret_cast<const std::int32_t*>(list.data()), shape_of(list.size()), self);  // NOLINT
  };
  return py::make_tuple(signed_view(arrays->candidates.offsets()), signed_view(arrays->candidates.targets()),
                        view_of(lengths->data(), shape_of(lengths->size()), self));
}

/// The same of the edges that are known to be free, in arrays of their own.
py::tuple free_rows_of(KeptRoadmap& kept) {
  const Asking asking(kept);
  RawVector<EdgeEnd> first;
  RawVector<VertexId> to;
  RawVector<double> lengths;
  CallLimits().run([&](const Execution& execution) {
    const RoadmapParts parts = kept.arrays(execution).parts();
    const RoadmapQuery* asked = kept.roadmap().lattice == nullptr ? &kept.query(execution) : nullptr;
    execution.reserve(parts.first.size_bytes() + parts.to.size() * (sizeof(VertexId) + sizeof(double)));
    first.reserve(parts.first.size());
    first.push_back(0);
    for (std::size_t v = 0; v < parts.vertex_count(); ++v) {
      execution.poll(v);
      for (std::size_t end = parts.first[v]; end < parts.first[v + 1]; ++end) {
        if (parts.state_of_end(end) != EdgeState::free) continue;
        to.push_back(parts.to[end]);
        lengths.push_back(kept.length(static_cast<VertexId>(v), parts.to[end], asked));
      }
      first.push_back(static_cast<EdgeEnd>(to.size()));
    }
  });
  return py::make_tuple(array_of<std::int32_t>(std::move(first)), array_of<std::int32_t>(std::move(to)),
                        array_of<double>(std::move(lengths)));
}

/// 0 unchecked, 1 free, 2 blocked: of each edge end.
py::array edge_states(KeptRoadmap& kept) {
  const Asking asking(kept);
  const RoadmapArrays* arrays = CallLimits().run([&](const Execution& execution) { return &kept.arrays(execution); });
  py::array_t<std::uint8_t> states(static_cast<py::ssize_t>(arrays->candidates.targets().size()));
  std::uint8_t* to = states.mutable_data();
  for (std::size_t i = 0; i < arrays->candidates.targets().size(); ++i) {
    to[i] = static_cast<std::uint8_t>(edge_state(arrays->edge_states, i));
  }
  return read_only(std::move(states));
}

/// (n, numbers of a state): a view that keeps the roadmap, `self`, alive.
py::array states_of(const py::object& self) {
  auto& kept = self.cast<KeptRoadmap&>();
  const Asking asking(kept);
  const RoadmapArrays* arrays = CallLimits().run([&](const Execution& execution) { return &kept.arrays(execution); });
  const std::size_t width = arrays->dimension;
  return view_of(arrays->states.data(), shape_of(arrays->states.size() / width, width), self);
}

/// A copy: what is learnt changes it.
py::array components_of(KeptRoadmap& kept) {
  const Asking asking(kept);
  return array_of<VertexId>(
      CallLimits().run([&](const Execution& execution) { return kept.arrays(execution).component; }));
}

using Kept = std::unique_ptr<KeptRoadmap>;

/// Of one of the program's verbs the options that `keeps` chooses.
template <class Keeps>
tools::Command of_verb(std::string_view name, const tools::Command& verb, const Keeps& keeps) {
  tools::Command made{name, "", "", {}, {}};
  made.foreign = verb.foreign;
  std::copy_if(verb.options.begin(), verb.options.end(), std::back_inserter(made.options), keeps);
  return made;
}

/// Those that say how `warren build` works, not where things are written.
tools::Command building() {
  return of_verb("build", tools::build_command(), [](const tools::OptionSpec& spec) {
    return !tools::is_among(spec.name,
                            "--output --no-world --map-rules --request --threads --budget --memory --quiet --progress "
                            "--color --trace");
  });
}

bool is_of_search(const tools::OptionSpec& spec) {
  const auto option = tools::option_of_words(spec.name);
  return option && asked_options.has(*option);
}

tools::Command asking() {
  return of_verb("query", tools::query_command(), [](const tools::OptionSpec& spec) {
    return is_of_search(spec) || tools::is_among(spec.name, "--start --goal");
  });
}
/// Lengths alone have no bound.
bool is_of_lengths(const tools::OptionSpec& spec) { return is_of_search(spec) && spec.name != "--bound"; }
tools::Command asking_pairs() { return of_verb("lengths", tools::query_command(), is_of_lengths); }
tools::Command asking_matrix() { return of_verb("matrix", tools::query_command(), is_of_lengths); }

Kept build_roadmap(const Scene& scene, py::dict keywords) {
  CallLimits limits = take_limits(keywords);
  const tools::Arguments words = arguments_of(made_once<building>(), keywords);
  const Question question = tools::question_words(words);
  const SolveOptions options = tools::solve_words(words);
  const auto index = tools::given_choice<IndexChoice>(words, "--index").value_or(IndexChoice::where_it_pays);
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
  const py::dict report("mode"_a = account.built_anew ? "built" : "changed", "edges"_a = account.edges,
                        "edges_checked"_a = account.edges_checked, "states_added"_a = account.states_added,
                        "states_dropped"_a = account.states_dropped);
  return py::make_tuple(py::cast(std::move(next)), report);
}

KeptAnswer ask(KeptRoadmap& kept, py::dict keywords, bool keep, bool explain) {
  CallLimits limits = take_limits(keywords);
  const tools::Arguments words = arguments_of(made_once<asking>(), keywords);
  const Question question = tools::question_words(words);
  const RoadmapSearchFields how = tools::solve_words(words);
  const Asking asking(kept);
  KeptAnswer said;
  said.answer = limits.run([&](const Execution& execution) {
    QuestionScratch scratch;
    const RoadmapQuery& query = kept.query(execution);
    ByProducts* made = keep || explain ? &said.made : nullptr;
    Answer answer = query.ask_explained(question.start, question.goal, how, execution, scratch, made);
    const Roadmap& roadmap = kept.roadmap();
    if (explain) {
      const AskedWith asked{.options = roadmap.options, .samples = roadmap.samples, .is_kept = true};
      explain_in_time(answer,
                      [&] { explain_answer(roadmap.world.whole(execution), asked, answer, said.made, execution); });
    }
    return answer;
  });
  return finished(std::move(said), keep, limits);
}

/// Of what is wrong with a start or a goal its row; an option that is wrong has none.
[[noreturn]] void refuse_row(const UsageError& error, std::size_t start, std::size_t goal) {
  constexpr std::string_view of_start = "start: ";
  constexpr std::string_view of_goal = "goal: ";
  const std::string_view said = error.what();
  if (said.starts_with(of_start)) throw InputError(fmt::format("starts[{}]", start), said.substr(of_start.size()));
  if (said.starts_with(of_goal)) throw InputError(fmt::format("goals[{}]", goal), said.substr(of_goal.size()));
  throw error;
}

/// Lengths of the shortest ways between places, infinite where there is none: of pairs, row by row, or from each start
/// to each goal. The same for any number of threads. Throws InputError, which names the rows, Stopped.
void ask_lengths(const KeptRoadmap& kept, const NumberRows& starts, const NumberRows& goals, bool each_to_each,
                 const RoadmapSearchFields& how, const Execution& execution, double* lengths) {
  const RoadmapQuery& query = kept.query(execution);
  const std::size_t n = each_to_each ? starts.rows * goals.rows : std::max(starts.rows, goals.rows);
  Execution one_thread = execution.quiet();
  one_thread.threads = 1;
  const auto ask = [&](std::size_t i, QuestionScratch& scratch) {
    const std::size_t start = each_to_each ? i / goals.rows : starts.rows == 1 ? 0 : i;
    const std::size_t goal = each_to_each ? i % goals.rows : goals.rows == 1 ? 0 : i;
    try {
      const LengthAnswer answer = query.length_within(starts.row(start), goals.row(goal), how, one_thread, scratch);
      lengths[i] = answer.outcome == Outcome::solved ? answer.length : std::numeric_limits<double>::infinity();
    } catch (const UsageError& error) {
      refuse_row(error, start, goal);
    }
  };
  // A chunk a thread: each has a scratch as large as the roadmap.
  const std::size_t threads = thread_count(execution.threads);
  const std::size_t share = std::max<std::size_t>(1, (n + threads - 1) / threads);
  for_chunks(n, share, execution, [&](Range r) {
    QuestionScratch scratch;
    for (std::size_t i = r.first; i < r.last; ++i) {
      one_thread.check();
      ask(i, scratch);
    }
  });
}

py::array lengths(KeptRoadmap& kept, const py::object& from, const py::object& to, bool each_to_each,
                  py::dict keywords) {
  CallLimits limits = take_limits(keywords);
  const RoadmapSearchFields how =
      tools::solve_words(arguments_of(each_to_each ? made_once<asking_matrix>() : made_once<asking_pairs>(), keywords));
  const std::size_t width = state_size(kept.roadmap().robot);
  const NumberRows starts = rows_of(from, "starts", {width});
  const NumberRows goals = width == 3  ? rows_of(to, "goals", {3, 2})
                           : width > 3 ? rows_of(to, "goals", {width, 3})
                                       : rows_of(to, "goals", {2});
  if (!each_to_each && starts.rows != goals.rows && starts.rows != 1 && goals.rows != 1) {
    throw py::value_error("starts and goals: expected as many of both, or one of either (found: " +
                          std::to_string(starts.rows) + " and " + std::to_string(goals.rows) + ")");
  }
  const bool none = starts.rows == 0 || goals.rows == 0;
  py::array_t<double> told(each_to_each ? shape_of(starts.rows, goals.rows)
                                        : shape_of(none ? 0 : std::max(starts.rows, goals.rows)));
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
  return py::dict("vertices"_a = account.vertices, "edges"_a = account.edges,
                  "unchecked_left_out"_a = account.unchecked_left_out, "blocked_left_out"_a = account.blocked_left_out);
}

py::tuple counts(KeptRoadmap& kept) {
  const Asking asking(kept);
  const EdgeCounts edges =
      CallLimits().run([&](const Execution& execution) { return count_edges(kept.roadmap(), execution); });
  return py::make_tuple(count_states(kept.roadmap()), edges.free, edges.blocked, edges.unchecked);
}

void learn_from_questions(KeptRoadmap& kept) {
  const Asking alone(kept, true);
  CallLimits().run([&](const Execution& execution) { kept.learn(execution); });
}

}  // namespace

const RoadmapQuery& KeptRoadmap::query(const Execution& execution) const {
  return query_.get(execution, [&] { return std::make_unique<RoadmapQuery>(roadmap_, execution, Questions::many); });
}

const RoadmapArrays& KeptRoadmap::arrays(const Execution& execution) const {
  if (roadmap_.lattice == nullptr) return roadmap_.arrays;
  return lattice_.get(
      execution, [&] { return std::make_unique<RoadmapArrays>(arrays_of(roadmap_.lattice->passages(), execution)); });
}

const RawVector<double>& KeptRoadmap::lengths(const Execution& execution) const {
  return lengths_.get(execution, [&] {
    constexpr std::size_t grain = 1024;
    const Graph& graph = arrays(execution).candidates;
    execution.reserve(graph.targets().size() * sizeof(double));
    auto lengths = std::make_unique<RawVector<double>>(graph.targets().size());
    const RoadmapQuery* asked = roadmap_.lattice == nullptr ? &query(execution) : nullptr;
    for_chunks(graph.vertex_count(), grain, execution, [&](Range r) {
      for (std::size_t v = r.first; v < r.last; ++v) {
        const auto from = static_cast<VertexId>(v);
        std::size_t end = graph.first_end(from);
        for (const VertexId to : graph.neighbours(from)) (*lengths)[end++] = length(from, to, asked);
      }
    });
    return lengths;
  });
}

/// Of an edge that leads both ways from its smaller vertex, as exports have it. `query`: nullptr for a lattice.
double KeptRoadmap::length(VertexId from, VertexId to, const RoadmapQuery* query) const {
  if (query == nullptr) return 1.0;
  const bool turned = !roadmap_.arrays.directed && to < from;
  return turned ? query->distance(to, from) : query->distance(from, to);
}

void KeptRoadmap::learn(const Execution& execution) {
  if (roadmap_.lattice == nullptr) warren::learn(roadmap_, query(execution), execution);
}

void bind_roadmaps(py::module_& module) {
  py::class_<KeptRoadmap>(module, "Roadmap")
      .def_property_readonly(
          "world",
          [](const KeptRoadmap& kept) -> const Scene& {
            return *CallLimits().run(
                [&](const Execution& execution) { return &kept.roadmap().world.whole(execution); });
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
      .def("save", [](KeptRoadmap& kept, const std::string& file, bool with_world) {
        const Asking asking(kept);
        CallLimits().run([&](const Execution& on) { write_roadmap(kept.roadmap(), file, on, with_world); });
      });
  module.def("build", &build_roadmap);
  module.def("open_roadmap", &open_roadmap, py::arg(), py::arg().none(true), py::arg());
  module.def("build_keywords", [] { return keyword_table(made_once<building>()); });
  module.def("query_keywords", [] { return keyword_table(made_once<asking>()); });
  module.def("lengths_keywords", [] { return keyword_table(made_once<asking_pairs>()); });
}

}  // namespace warren::python
