// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/planner_choice.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <optional>

#include "core/base/error.hpp"
#include "planners/tiled/tiled_prm_lattice.hpp"
#include "solve/question/write_answer_io.hpp"
#include "tools/words/option_values.hpp"

namespace warren {
namespace {

constexpr std::array<std::string_view, 8> planner_words{"prm",     "lazy-prm", "visibility",  "cells",
                                                        "voronoi", "rrt",      "rrt-connect", "grid"};
constexpr std::array<std::string_view, 9> sampler_words{"uniform", "lattice", "halton",   "random",      "gaussian",
                                                        "bridge",  "mixture", "corridor", "cell-centres"};
constexpr std::array<std::string_view, 4> search_words{"astar", "dijkstra", "bfs", "dfs"};
constexpr std::array<std::string_view, 4> queue_words{"heap", "lazy-heap", "sorted-array", "resorted-array"};
constexpr std::array<std::string_view, 2> pipeline_words{"plain", "tiled"};
constexpr std::array<std::string_view, 2> lazy_words{"expansion", "path"};
constexpr std::uint64_t most_samples = std::uint64_t{1} << 31;
constexpr std::uint64_t most_neighbours = 4096;

constexpr OptionSpec planner_specs[] = {
    {"--planner", "NAME",
     "prm checks every edge, lazy-prm only those that a search reaches (default: prm with lattice)", "prm lazy-prm"},
    {"--sampler", "NAME",
     "where milestones come from (default: lattice in mazes, cell-centres on maps of corridors a cell wide, else "
     "uniform)",
     "uniform lattice halton random gaussian bridge mixture corridor cell-centres"},
    {"--samples", "N|auto", "states drawn; auto grows until start and goal connect (default: auto)"},
    {"--neighbours", "K|auto|star", "join each milestone to its K nearest; star: by the rule of PRM* (default: auto)"},
    {"--radius", "R|auto|star",
     "join milestones at most so far apart, instead of the K nearest; star: by the rule of PRM* (default: auto)"},
    {"--search", "NAME", "how the roadmap is searched (default: astar)", "astar dijkstra bfs dfs"},
    {"--queue", "NAME", "the queue of astar and dijkstra (default: heap)",
     "heap lazy-heap sorted-array resorted-array"},
    {"--lazy",
     "[WHEN]",
     "lazy-prm checks an edge when the search expands it, or when it lies on the path found "
     "(default: expansion)",
     "expansion path",
     {},
     true},
    {"--pipeline", "NAME",
     "how prm works: stage by stage, or tile by tile in cache (default: tiled on a lattice "
     "where the rules of joining and searching are the usual ones)",
     "plain tiled"},
    {"--optimise", "", "pull the path taut after the search"},
    {"--seed", "N", "seed of the sampling; never alters the world (default: 1)"},
};

template <class Enum, std::size_t N>
std::optional<Enum> choice(const Arguments& arguments, std::string_view option,
                           const std::array<std::string_view, N>& words) {
  const auto text = arguments.value(option);
  if (!text) return std::nullopt;
  return static_cast<Enum>(choice_value(option, *text, words));
}

std::optional<double> auto_or_radius(const Arguments& arguments) {
  const auto text = arguments.value("--radius");
  if (!text || *text == "auto" || *text == "star") return std::nullopt;
  return positive_value("--radius", *text);
}

std::optional<std::uint64_t> auto_or_count(const Arguments& arguments, std::string_view option, std::uint64_t most) {
  const auto text = arguments.value(option);
  return text ? auto_or_count_value(option, *text, 1, most) : std::nullopt;
}

/// A planner without stages of checking takes --lazy alone; whether this one does is asked where it is known.
LazyCheck lazy_check(const Arguments& arguments) {
  if (arguments.value("--lazy") == "") return LazyCheck::expansion;
  return choice<LazyCheck>(arguments, "--lazy", lazy_words).value_or(LazyCheck::expansion);
}

StarRule star_rule_asked(const Arguments& arguments) {
  const bool neighbours = arguments.value("--neighbours") == "star";
  const bool radius = arguments.value("--radius") == "star";
  if (neighbours && radius) throw UsageError("--radius: one rule of PRM* joins milestones, by neighbours or by radius");
  return neighbours ? StarRule::neighbours : radius ? StarRule::radius : StarRule::none;
}

SearchChoice searched_how(const Arguments& arguments) {
  SearchChoice choices;
  choices.search = choice<SearchKind>(arguments, "--search", search_words).value_or(SearchKind::astar);
  choices.queue = choice<QueueKind>(arguments, "--queue", queue_words).value_or(QueueKind::heap);
  choices.seed = seed_of(arguments);
  return choices;
}

RoadmapOptions roadmap_options(const Arguments& arguments) {
  RoadmapOptions options;
  options.samples = auto_or_count(arguments, "--samples", most_samples);
  options.star = star_rule_asked(arguments);
  if (options.star != StarRule::neighbours) {
    if (const auto count = auto_or_count(arguments, "--neighbours", most_neighbours)) {
      options.neighbours = static_cast<std::uint32_t>(*count);
    }
  }
  options.radius = auto_or_radius(arguments);
  const SearchChoice searched = searched_how(arguments);
  options.search = searched.search;
  options.queue = searched.queue;
  options.seed = searched.seed;
  options.lazy = lazy_check(arguments);
  return options;
}

void check_queue(const Arguments& arguments, SearchKind search) {
  if (!arguments.has("--queue") || search == SearchKind::astar || search == SearchKind::dijkstra) return;
  throw UsageError(fmt::format("--queue: {} has no priority queue; astar and dijkstra take one", name_of(search)));
}

void check_planner(const Arguments& arguments, PlannerKind planner, SearchKind search) {
  if (planner == PlannerKind::prm && arguments.has("--lazy")) {
    throw UsageError("--lazy: prm checks every edge; the planner lazy-prm takes this option");
  }
  if (planner == PlannerKind::lazy_prm && arguments.value("--lazy") == "") {
    throw UsageError("--lazy: WHEN is missing");
  }
  const bool best_first = search == SearchKind::astar || search == SearchKind::dijkstra;
  if (planner == PlannerKind::lazy_prm && !best_first) {
    throw UsageError(
        fmt::format("--search: lazy-prm takes astar and dijkstra; the planner prm takes {} too", name_of(search)));
  }
}

/// The lattice has a point a cell: no number of samples to choose.
void check_samples(SamplerKind sampler, const RoadmapOptions& options) {
  if (!takes_all_places(sampler) || !options.samples) return;
  throw UsageError(
      fmt::format("--samples: {} takes every cell centre; the other samplers take a number", name_of(sampler)));
}

void check_lattice(SamplerKind sampler, const Scene& scene) {
  if (sampler != SamplerKind::lattice || scene.maze) return;
  throw UsageError(fmt::format(
      "--sampler: lattice needs a maze, and {} has no 'maze ROWS COLS' line; the others take any world", scene.source));
}

/// Fused tiles take the lattice with its own rule of joining, and have a search of their own.
bool takes_fused_tiles(const Arguments& arguments, const PlannerOptions& options, double clearance) {
  const bool usual_search = !arguments.has("--search") && !arguments.has("--queue");
  return options.planner == PlannerKind::prm && usual_search && tiled_prm_applies(options.roadmap, clearance);
}

/// Whatever else is asked for, the plain stages do, or tiles of milestones where these are asked for.
PipelineKind pipeline_for(const Arguments& arguments, const PlannerOptions& options, const Scene& scene) {
  const auto asked = choice<PipelineKind>(arguments, "--pipeline", pipeline_words);
  if (asked && options.planner != PlannerKind::prm) {
    throw UsageError("--pipeline: lazy-prm has one way of working; the planner prm takes this option");
  }
  const SearchKind search = options.roadmap.search;
  if (asked == PipelineKind::tiled && (search == SearchKind::bfs || search == SearchKind::dfs)) {
    throw UsageError("--pipeline: tiles keep shortest paths only; for --search bfs and dfs there is plain");
  }
  if (asked == PipelineKind::tiled && !scene.polygons.empty()) {
    throw UsageError("--pipeline: tiled takes worlds of walls; among polygons there is plain");
  }
  return asked.value_or(options.fused ? PipelineKind::tiled : PipelineKind::plain);
}

SamplerKind sampler_for(const Arguments& arguments, const Scene& scene) {
  const bool lattice = scene.maze && !auto_or_count(arguments, "--samples", most_samples);
  const SamplerKind usual = lattice ? SamplerKind::lattice : SamplerKind::uniform;
  return choice<SamplerKind>(arguments, "--sampler", sampler_words).value_or(usual);
}

/// Options that answer and description repeat, with their values as JSON.
std::vector<std::pair<std::string, std::string>> given_options(const Arguments& arguments, const PlannerOptions& o) {
  std::vector<std::pair<std::string, std::string>> given;
  if (o.roadmap.samples) given.emplace_back("samples", std::to_string(*o.roadmap.samples));
  if (o.roadmap.neighbours) given.emplace_back("neighbours", std::to_string(*o.roadmap.neighbours));
  if (o.roadmap.radius) given.emplace_back("radius", json_number(*o.roadmap.radius));
  if (o.roadmap.star == StarRule::neighbours) given.emplace_back("neighbours", json_string("star"));
  if (o.roadmap.star == StarRule::radius) given.emplace_back("radius", json_string("star"));
  if (const auto queue = arguments.value("--queue")) given.emplace_back("queue", json_string(*queue));
  if (const auto lazy = arguments.value("--lazy")) given.emplace_back("lazy", json_string(*lazy));
  if (const auto pipeline = arguments.value("--pipeline")) given.emplace_back("pipeline", json_string(*pipeline));
  if (o.optimise) given.emplace_back("optimise", "true");
  return given;
}

}  // namespace

std::string_view name_of(PlannerKind planner) { return planner_words[static_cast<std::size_t>(planner)]; }
std::string_view name_of(PipelineKind pipeline) { return pipeline_words[static_cast<std::size_t>(pipeline)]; }
std::string_view name_of(SamplerKind sampler) { return sampler_words[static_cast<std::size_t>(sampler)]; }
std::string_view name_of(SearchKind search) { return search_words[static_cast<std::size_t>(search)]; }

std::span<const OptionSpec> planner_option_specs() { return planner_specs; }

std::uint64_t seed_of(const Arguments& arguments) {
  const auto text = arguments.value("--seed");
  return text ? count_value("--seed", *text, 0, std::numeric_limits<std::uint64_t>::max()) : 1;
}

SearchChoice search_choice(const Arguments& arguments) {
  const SearchChoice choices = searched_how(arguments);
  check_queue(arguments, choices.search);
  return choices;
}

std::optional<PlannerKind> planner_asked(const Arguments& arguments) {
  return choice<PlannerKind>(arguments, "--planner", planner_words);
}

std::optional<SamplerKind> sampler_asked(const Arguments& arguments) {
  return choice<SamplerKind>(arguments, "--sampler", sampler_words);
}

void check_planner_options(const Arguments& arguments) {
  const RoadmapOptions options = roadmap_options(arguments);
  const auto planner = planner_asked(arguments);
  if (planner && !is_roadmap_planner(*planner)) {
    throw UsageError(fmt::format("--planner: {} builds no roadmap of samples; prm and lazy-prm do", name_of(*planner)));
  }
  const auto sampler = sampler_asked(arguments);
  check_queue(arguments, options.search);
  if (planner) check_planner(arguments, *planner, options.search);
  if ((options.neighbours || options.radius) && options.star != StarRule::none) {
    throw UsageError("--radius: a number and a rule of PRM* contradict each other; give one of the two");
  }
  if (options.neighbours && options.radius) {
    throw UsageError("--radius: replaces the number of neighbours; give --neighbours or --radius, not both");
  }
  if (sampler) check_samples(*sampler, options);
}

PlannerKind usual_roadmap_planner(const Arguments& arguments, const Scene& scene) {
  return sampler_for(arguments, scene) == SamplerKind::lattice ? PlannerKind::prm : PlannerKind::lazy_prm;
}

PlannerOptions planner_options(const Arguments& arguments, const Scene& scene, const WallProblem& problem) {
  PlannerOptions options;
  options.roadmap = roadmap_options(arguments);
  options.roadmap.sampler = sampler_for(arguments, scene);
  if (scene.maze) options.roadmap.lattice = {scene.maze->rows, scene.maze->cols};
  check_lattice(options.roadmap.sampler, scene);
  options.planner = planner_asked(arguments).value_or(usual_roadmap_planner(arguments, scene));
  check_planner(arguments, options.planner, options.roadmap.search);
  options.fused = takes_fused_tiles(arguments, options, problem.reach());
  options.pipeline = pipeline_for(arguments, options, scene);
  options.optimise = arguments.has("--optimise");
  options.given = given_options(arguments, options);
  return options;
}

}  // namespace warren
