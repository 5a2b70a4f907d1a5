// SPDX-License-Identifier: BSD-3-Clause
// How a question shall be solved: the planner, and all options of all planners, each in the part where it belongs. What
// is not said is chosen where it is used, so that the shortest call is the fastest and the most honest one. A planner
// refuses what it would ignore, by the table of kind_of_problem.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/enum_names.hpp"
#include "planners/axis/medial_axis_planner.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/grid/grid_search.hpp"
#include "planners/vertical_cells/cell_planner.hpp"
#include "scenes/scene/scene.hpp"
#include "worlds/rasters/heading_layers.hpp"

namespace warren {

/// prm: every edge of a roadmap is checked; lazy_prm: those that a search reaches. visibility, cells: a point among
/// obstacles, exactly. voronoi: as far from all obstacles as can be. rrt, rrt_connect: trees. grid: cells or a lattice.
/// rrt_star, informed_rrt_star, anytime: get better until they are stopped.
enum class PlannerKind : std::uint8_t {
  prm,
  lazy_prm,
  visibility,
  cells,
  voronoi,
  rrt,
  rrt_connect,
  grid,
  rrt_star,
  informed_rrt_star,
  anytime
};
constexpr auto enum_names(PlannerKind) {
  return std::array<std::string_view, 11>{"prm",    "lazy-prm",    "visibility", "cells",    "voronoi",
                                          "rrt",    "rrt-connect", "grid",       "rrt-star", "informed-rrt-star",
                                          "anytime"};
}
/// In the order of the enumeration.
inline constexpr auto all_planners = [] {
  std::array<PlannerKind, enum_names(PlannerKind{}).size()> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<PlannerKind>(i);
  return all;
}();
/// Does it search a roadmap of samples?
constexpr bool is_roadmap_planner(PlannerKind planner) {
  return planner == PlannerKind::prm || planner == PlannerKind::lazy_prm;
}

/// Makes it a roadmap that depends on neither start nor goal?
constexpr bool keeps_roadmap(PlannerKind planner) {
  return is_roadmap_planner(planner) || planner == PlannerKind::visibility || planner == PlannerKind::cells ||
         planner == PlannerKind::voronoi;
}

/// Does it grow trees until they meet the goal?
constexpr bool is_tree_planner(PlannerKind planner) {
  return planner == PlannerKind::rrt || planner == PlannerKind::rrt_connect;
}

/// Does it get better until it is stopped?
constexpr bool gets_better(PlannerKind planner) {
  return planner == PlannerKind::rrt_star || planner == PlannerKind::informed_rrt_star ||
         planner == PlannerKind::anytime;
}

/// How prm works: stage by stage over the whole world; tile by tile with all stages of a tile in cache; or so that
/// nothing of a tile is kept but what paths through it need, and its walls neither where they can be made again.
enum class PipelineKind : std::uint8_t { plain, tiled, streamed };
constexpr auto enum_names(PipelineKind) { return std::array<std::string_view, 3>{"plain", "tiled", "streamed"}; }

/// When lazy_prm checks an edge: when its search first wants to use it. To check the edges of the paths found, and to
/// repair these, lost on every world and is gone; scripts may go on saying which.
enum class LazyCheck : std::uint8_t { expansion };
constexpr auto enum_names(LazyCheck) { return std::array<std::string_view, 1>{"expansion"}; }

/// How a graph or a grid is searched; dfs is for roadmaps alone, jump_points for grids.
enum class SearchMethod : std::uint8_t { astar, dijkstra, bfs, dfs, jump_points };
constexpr auto enum_names(SearchMethod) {
  return std::array<std::string_view, 5>{"astar", "dijkstra", "bfs", "dfs", "jump-points"};
}

/// prm and lazy_prm; pipeline is prm's, lazy is lazy_prm's, attach is for arms.
struct RoadmapFields {
  std::optional<std::uint64_t> samples = {};     ///< states drawn, 1 .. 2^31; none: grow until start and goal connect
  std::optional<std::uint32_t> neighbours = {};  ///< join each milestone to its k nearest, 1 .. 4096; none: by rule
  std::optional<double> radius = {};             ///< join milestones at most so far apart, > 0; instead of neighbours
  StarRule star = StarRule::none;                ///< join by a rule of PRM* instead of either
  std::optional<LazyCheck> lazy = {};            ///< there is one way
  std::optional<PipelineKind> pipeline = {};     ///< none: tiled on a lattice where all rules are the usual ones
  std::optional<NeighbourIndex> neighbour_index = {};  ///< of milestones that are points; none: by counts
  std::optional<GrowingAttach> attach = {};            ///< how start and goal are joined; none: as far as the k nearest
};

/// rrt and rrt_connect.
struct TreeFields {
  std::optional<double> step = {};            ///< longest motion, in the body's metric, > 0; none: by world
  std::optional<double> goal_bias = {};       ///< share of rrt's samples that are the goal, 0 .. 1; none: 0.05
  std::optional<std::uint64_t> nodes = {};    ///< a tree of so many gives up, 2 .. 2^31; none: 100,000
  std::optional<std::uint32_t> trees = {};    ///< grown independently at once, 1 .. 4096; none: 1
  std::vector<std::vector<double>> via = {};  ///< way-points in their order: 2 or 3 numbers each, of an arm one a joint
};

/// What takes turns in anytime.
enum class AnytimePart : std::uint8_t { tree, restarts, roadmap, shorten };
constexpr auto enum_names(AnytimePart) {
  return std::array<std::string_view, 4>{"tree", "restarts", "roadmap", "shorten"};
}

/// Planners that get better until they are stopped.
struct AnytimeFields {
  std::optional<std::uint64_t> iterations = {};  ///< they end after so many turns, 1 .. 2^62; none: see the limits
  std::optional<double> gap = {};       ///< they end where the path costs at most this share more than the bound
  std::vector<AnytimePart> parts = {};  ///< of anytime; empty: all
};

/// grid in a scene, and of a body that turns.
struct GridFields {
  std::optional<double> cell = {};           ///< distance of positions, > 0; none: the file's, else a 400th of the side
  std::optional<std::uint32_t> angles = {};  ///< headings, 1 .. 1,000,000; none: the file's, else 72
  std::optional<std::uint32_t> headings = {};  ///< of a car's lattice: 16 or 32; none: 16
  bool face_motion = false;                    ///< the body moves only where it faces
  std::optional<double> step_cost = {};        ///< of a step to the side, > 0; none: 1
  std::optional<double> turn_cost = {};        ///< of a turn to the next heading, > 0; none: 1
  std::optional<Diagonal> diagonal = {};       ///< what a diagonal step costs; none: sqrt2
  std::optional<LayerKind> layers = {};        ///< none: exact
};

/// cells.
struct CellFields {
  std::optional<DoorKind> doors = {};  ///< where doors are passed; none: in their middles
};

/// voronoi.
struct AxisFields {
  std::optional<AxisObjective> objective = {};  ///< none: length
};

/// visibility.
struct VisibilityFields {
  bool full = false;                         ///< all visible edges instead of those that shortest paths take
  bool lazy = false;                         ///< find edges as A* needs them
  std::optional<double> sampled_edges = {};  ///< test edges at points so far apart instead of exactly, > 0
};

/// What of the scene's car is to be otherwise.
struct CarFields {
  std::optional<SteeringKind> steering = {};  ///< none: the scene's
  std::optional<double> turning_radius = {};  ///< > 0
  std::optional<double> cusp_cost = {};     ///< optimise: of a change of gear, as length, >= 0; none: a turning radius
  std::optional<double> reverse_cost = {};  ///< optimise: of a unit of length driven backwards, >= 1; none: 1
};

/// How a question is solved. What the planner would ignore is refused.
struct SolveOptions {
  std::optional<PlannerKind> planner = {};  ///< none: the usual one of the problem
  std::uint64_t seed = 1;                   ///< of all that is random: any value
  bool optimise = false;                    ///< pull the path taut after the search
  std::optional<SamplerKind> sampler = {};  ///< of roadmaps and trees; none: by planner and world
  std::optional<SearchMethod> search = {};  ///< none: A*; jump points or breadth first on maps where they are as good
  std::optional<QueueKind> queue = {};      ///< of astar and dijkstra; none: heap
  std::optional<HeuristicKind> heuristic = {};  ///< of astar on roadmaps of points and discs; none: euclidean
  RoadmapFields roadmap = {};                   ///< of prm and lazy_prm
  TreeFields trees = {};                        ///< of rrt and rrt_connect
  AnytimeFields anytime = {};                   ///< of planners that get better
  bool bound = false;                           ///< prove the best lower bound that there is, at a cost of its own
  GridFields grid = {};                         ///< of grid
  CellFields cells = {};                        ///< of cells
  AxisFields axis = {};                         ///< of voronoi
  VisibilityFields visibility = {};             ///< of visibility
  CarFields car = {};                           ///< of cars, whoever plans

  /// Throws UsageError for values outside their ranges and for options that contradict each other, whatever the world.
  void validate() const;
};

/// All options that some planner would ignore, by which tables say who takes what.
enum class Option : std::uint8_t {
  sampler,
  samples,
  neighbours,
  radius,
  search,
  queue,
  lazy,
  pipeline,
  optimise,
  cell,
  angles,
  face_motion,
  step_cost,
  turn_cost,
  diagonal,
  layers,
  full,
  sampled_edges,
  doors,
  objective,
  step,
  goal_bias,
  nodes,
  trees,
  via,
  steering,
  turning_radius,
  cusp_cost,
  reverse_cost,
  attach,
  heuristic,
  neighbour_index,
  iterations,
  gap,
  parts,
  bound,
  headings
};
constexpr auto enum_names(Option) {
  return std::array<std::string_view, 37>{
      "sampler",   "samples",         "neighbours",     "radius",    "search",       "queue",
      "lazy",      "pipeline",        "optimise",       "cell",      "angles",       "face_motion",
      "step_cost", "turn_cost",       "diagonal",       "layers",    "full",         "sampled_edges",
      "doors",     "objective",       "step",           "goal_bias", "nodes",        "trees",
      "via",       "steering",        "turning_radius", "cusp_cost", "reverse_cost", "attach",
      "heuristic", "neighbour_index", "iterations",     "gap",       "parts",        "bound",
      "headings"};
}
/// Enumerators of Option.
inline constexpr std::size_t option_count = enum_names(Option{}).size();

/// Which of the options are given.
using OptionSet = EnumSet<Option>;
/// What a question asks of a roadmap that is there; a roadmap that is kept has none of them.
inline constexpr OptionSet question_options{Option::search,    Option::queue,        Option::optimise,
                                            Option::cusp_cost, Option::reverse_cost, Option::heuristic,
                                            Option::bound};
/// These, and how an arm is joined to the roadmap.
inline constexpr OptionSet asked_options = question_options | OptionSet{Option::attach};
/// How planners work, which roadmaps that are kept don't show.
inline constexpr OptionSet work_options{Option::lazy, Option::pipeline, Option::sampled_edges, Option::neighbour_index};

/// Numbers that an option takes: from low to high; without an end those above 0. The rest means nothing to other types.
struct OptionRange {
  double low = 0.0;                                       ///< the least value
  double high = std::numeric_limits<double>::infinity();  ///< the largest value
};

/// The table of the options, in the order in which answers repeat them: calls visit(option, range, field ...) with each
/// option's field in each of `of`; lazy has two, one a kind of planner. Which planner takes what: kind_of_problem.hpp.
template <class Visit, class... Of>
void visit_options(const Visit& visit, Of&... of) {
  visit(Option::sampler, {}, of.sampler...);
  visit(Option::samples, {1, most_samples}, of.roadmap.samples...);
  visit(Option::neighbours, {1, most_neighbours}, of.roadmap.neighbours...);
  visit(Option::radius, {}, of.roadmap.radius...);
  visit(Option::search, {}, of.search...);
  visit(Option::queue, {}, of.queue...);
  visit(Option::heuristic, {}, of.heuristic...);
  visit(Option::neighbour_index, {}, of.roadmap.neighbour_index...);
  visit(Option::lazy, {}, of.roadmap.lazy...);
  visit(Option::lazy, {}, of.visibility.lazy...);
  visit(Option::pipeline, {}, of.roadmap.pipeline...);
  visit(Option::step, {}, of.trees.step...);
  visit(Option::goal_bias, {0, 1}, of.trees.goal_bias...);
  visit(Option::nodes, {2, most_samples}, of.trees.nodes...);
  visit(Option::trees, {1, most_trees}, of.trees.trees...);
  visit(Option::via, {}, of.trees.via...);
  visit(Option::iterations, {1, 4'611'686'018'427'387'904}, of.anytime.iterations...);
  visit(Option::gap, {0, 1e9}, of.anytime.gap...);
  visit(Option::parts, {}, of.anytime.parts...);
  visit(Option::bound, {}, of.bound...);
  visit(Option::optimise, {}, of.optimise...);
  visit(Option::attach, {}, of.roadmap.attach...);
  visit(Option::cell, {}, of.grid.cell...);
  visit(Option::angles, {1, 1'000'000}, of.grid.angles...);
  visit(Option::headings, {16, 32}, of.grid.headings...);
  visit(Option::face_motion, {}, of.grid.face_motion...);
  visit(Option::step_cost, {}, of.grid.step_cost...);
  visit(Option::turn_cost, {}, of.grid.turn_cost...);
  visit(Option::diagonal, {}, of.grid.diagonal...);
  visit(Option::layers, {}, of.grid.layers...);
  visit(Option::doors, {}, of.cells.doors...);
  visit(Option::objective, {}, of.axis.objective...);
  visit(Option::full, {}, of.visibility.full...);
  visit(Option::sampled_edges, {}, of.visibility.sampled_edges...);
  visit(Option::steering, {}, of.car.steering...);
  visit(Option::turning_radius, {}, of.car.turning_radius...);
  visit(Option::cusp_cost, {0, largest_coordinate}, of.car.cusp_cost...);
  visit(Option::reverse_cost, {1, largest_coordinate}, of.car.reverse_cost...);
}
/// The option that RoadmapFields::star is said with, in place of a number.
constexpr std::optional<Option> star_option(const SolveOptions& options) {
  if (options.roadmap.star == StarRule::none) return std::nullopt;
  return options.roadmap.star == StarRule::radius ? Option::radius : Option::neighbours;
}
/// The options that are not as they are by default.
OptionSet given(const SolveOptions& options);
/// Gives one option the value that it has in `from`.
void copy_option(Option option, SolveOptions& to, const SolveOptions& from);

}  // namespace warren
