// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/planner_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/error.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"

namespace warren {
namespace {

RoadmapOptions roadmap_options(const SolveOptions& asked) {
  const SearchChoice searched = search_choice(asked);
  return {.samples = asked.roadmap.samples,
          .neighbours = asked.roadmap.neighbours,
          .radius = asked.roadmap.radius,
          .star = asked.roadmap.star,
          .seed = asked.seed,
          .search = searched.search,
          .queue = searched.queue,
          .heuristic = asked.heuristic.value_or(HeuristicKind::euclidean),
          .neighbour_index = asked.roadmap.neighbour_index.value_or(NeighbourIndex::by_counts)};
}

void check_planner(const SolveOptions& asked, PlannerKind planner, SearchKind search) {
  if (planner == PlannerKind::prm && given(asked).has(Option::lazy)) {
    throw UsageError("@lazy: prm checks every edge; the planner lazy-prm takes this option");
  }
  if (planner == PlannerKind::lazy_prm && asked.visibility.lazy) throw UsageError("@lazy: WHEN is missing");
  if (planner == PlannerKind::lazy_prm && !has_queue(search)) {
    throw UsageError(
        fmt::format("@search: lazy-prm takes astar and dijkstra; the planner prm takes {} too", name_of(search)));
  }
}

/// Whatever else is asked for, the plain stages do.
PipelineKind pipeline_for(const SolveOptions& asked, const PlannerOptions& options, const Scene& scene,
                          double clearance) {
  const std::optional<PipelineKind> pipeline = asked.roadmap.pipeline;
  if (pipeline && options.planner != PlannerKind::prm) {
    throw UsageError("@pipeline: lazy-prm has one way of working; the planner prm takes this option");
  }
  // Fused tiles take the lattice with its own rule of joining, and have a search of their own.
  const bool usual_search = !asked.search && !asked.queue && !asked.heuristic && !asked.roadmap.neighbour_index;
  const bool fused =
      options.planner == PlannerKind::prm && usual_search && tiled_prm_applies(options.roadmap, clearance);
  const bool unmade = is_unmade(scene);
  if (pipeline.value_or(unmade ? PipelineKind::streamed : PipelineKind::plain) != PipelineKind::plain &&
      (!fused || !scene.polygons.empty())) {
    throw UsageError(
        fmt::format("@pipeline: {} takes the lattice of a maze without polygons, with the usual rules of joining and "
                    "searching, and "
                    "a clearance of at most 8; for all else there is @pipeline plain",
                    name_of(pipeline.value_or(PipelineKind::streamed))));
  }
  if (unmade && pipeline.value_or(PipelineKind::streamed) != PipelineKind::streamed) {
    throw UsageError(fmt::format("@pipeline: the walls of {} are not held; streamed takes them", scene.source));
  }
  if (unmade) return PipelineKind::streamed;
  return pipeline.value_or(fused ? PipelineKind::tiled : PipelineKind::plain);
}

SamplerKind sampler_for(const SolveOptions& asked, const Scene& scene) {
  const bool lattice = scene.maze && !asked.roadmap.samples;
  const SamplerKind usual = lattice ? SamplerKind::lattice : SamplerKind::uniform;
  return asked.sampler.value_or(usual);
}

}  // namespace

SearchChoice search_choice(const SolveOptions& asked) {
  if (asked.search == SearchMethod::jump_points) {
    throw UsageError("@search: jump points need a grid; the planner grid takes them");
  }
  const auto search = static_cast<SearchKind>(asked.search.value_or(SearchMethod::astar));
  if (asked.queue && !has_queue(search)) {
    throw UsageError(fmt::format("@queue: {} has no priority queue; astar and dijkstra take one", name_of(search)));
  }
  return {search, asked.queue.value_or(QueueKind::heap)};
}

void check_planner_options(const SolveOptions& asked) {
  const auto planner = asked.planner;
  if (planner && !is_roadmap_planner(*planner)) {
    throw UsageError(fmt::format("@planner: {} builds no roadmap of samples; prm and lazy-prm do", name_of(*planner)));
  }
  const RoadmapOptions options = roadmap_options(asked);
  if (asked.heuristic && options.search != SearchKind::astar) {
    throw UsageError(fmt::format("@heuristic: {} estimates nothing; astar takes one", name_of(options.search)));
  }
  if (planner) check_planner(asked, *planner, options.search);
  if ((options.neighbours || options.radius) && options.star != StarRule::none) {
    throw UsageError("@radius: a number and a rule of PRM* contradict each other; give one of the two");
  }
  if (options.neighbours && options.radius) {
    throw UsageError("@radius: replaces the number of neighbours; give @neighbours or @radius, not both");
  }
  // The lattice has a point a cell: no number of samples to choose.
  if (asked.sampler && takes_all_places(*asked.sampler) && options.samples) {
    throw UsageError(
        fmt::format("@samples: {} takes every cell centre; the other samplers take a number", name_of(*asked.sampler)));
  }
}

PlannerKind usual_roadmap_planner(const SolveOptions& asked, const Scene& scene) {
  return sampler_for(asked, scene) == SamplerKind::lattice ? PlannerKind::prm : PlannerKind::lazy_prm;
}

PlannerOptions planner_options(const SolveOptions& asked, const Scene& scene, const WallProblem& problem) {
  PlannerOptions options;
  options.roadmap = roadmap_options(asked);
  options.roadmap.sampler = sampler_for(asked, scene);
  if (scene.maze) options.roadmap.lattice = {scene.maze->rows, scene.maze->cols};
  if (options.roadmap.sampler == SamplerKind::lattice && !scene.maze) {
    throw UsageError(
        fmt::format("@sampler: lattice needs a maze, and {} has no 'maze ROWS COLS' line; the others take any world",
                    scene.source));
  }
  options.planner = asked.planner.value_or(usual_roadmap_planner(asked, scene));
  check_planner(asked, options.planner, options.roadmap.search);
  options.pipeline = pipeline_for(asked, options, scene, problem.reach());
  return options;
}

void check_cell(double cell, const Scene& scene, const Execution& execution) {
  const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene, execution);
  if (box.empty()) return;
  const double width = std::max(1.0, std::ceil(box.width() / cell));
  const double height = std::max(1.0, std::ceil(box.height() / cell));
  constexpr double too_many = 4294967296.0;
  if (width * height < too_many) return;
  throw UsageError(
      fmt::format("@cell: {} is too small: the world has {:.6g} x {:.6g} such cells, and 2^32 - 1 are the most", cell,
                  width, height));
}

GridSpec grid_spec(const GridFields& options, const Scene& scene) {
  constexpr std::uint32_t usual_angles = 72;
  constexpr double cells_a_side = 400.0;
  GridSpec grid = scene.grid.value_or(GridSpec{.cell = scene.map ? scene.map->cell : 0.0, .angles = usual_angles});
  const bool asks_box = options.cell || grid.cell == 0.0;
  const Box box = scene.bounds || !asks_box ? scene.bounds.value_or(Box{}) : obstacle_box(scene);
  if (options.cell) {
    check_cell(*options.cell, scene);
    // It must have room each way; a world without extent has none for any.
    constexpr double rounding = 1e-9;
    const double side = box.empty() ? 0.0 : std::min(box.width(), box.height());
    if (side > 0.0 && side / *options.cell + rounding < 1.0) {
      throw UsageError(fmt::format("@cell: {} is too large: the world has {:.6g} x {:.6g}", *options.cell, box.width(),
                                   box.height()));
    }
  }
  grid.cell = options.cell.value_or(grid.cell);
  grid.angles = options.angles.value_or(grid.angles);
  if (grid.cell == 0.0) {
    grid.cell = box.empty() ? 0.0 : std::max(box.width(), box.height()) / cells_a_side;
    if (!(grid.cell > 0.0)) throw UsageError("@cell: is missing, and the world has no extent to divide");
  }
  return grid;
}

GridMethod grid_method(const SolveOptions& options, GridMethod usual) {
  if (!options.search) return usual;
  if (const auto method = enum_named<GridMethod>(name_of(*options.search))) return *method;
  throw UsageError("@search: grid takes astar, dijkstra and bfs; the planner prm takes dfs");
}

RrtOptions tree_options(const SolveOptions& asked) {
  RrtOptions options;
  if (asked.sampler && takes_all_places(*asked.sampler)) {
    throw UsageError(fmt::format("@sampler: {} is for roadmaps; trees take the others", name_of(*asked.sampler)));
  }
  options.sampler = asked.sampler;
  options.places = !asked.optimise;  // trees find ways of more kinds, of which the best is wanted
  options.step = asked.trees.step;
  options.goal_bias = asked.trees.goal_bias.value_or(options.goal_bias);
  options.nodes = asked.trees.nodes.value_or(options.nodes);
  options.trees = asked.trees.trees.value_or(options.trees);
  options.seed = asked.seed;
  return options;
}

}  // namespace warren
