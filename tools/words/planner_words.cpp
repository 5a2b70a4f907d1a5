// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/planner_words.hpp"

#include <algorithm>
#include <limits>

#include "core/base/error.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "tools/words/option_values.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec roadmap_specs[] = {
    {"--planner", "NAME",
     "prm checks every edge of a roadmap, lazy-prm those that a search reaches; visibility finds the shortest path "
     "among polygons, cells one through vertical cells, voronoi one far from obstacles; rrt and rrt-connect grow "
     "trees, grid searches cells (default: by world and body)",
     "prm lazy-prm"},
    {"--sampler", "NAME",
     "where milestones come from (default: lattice in mazes, cell-centres on maps of corridors a cell wide, else "
     "uniform)",
     "uniform lattice halton random gaussian bridge mixture corridor cell-centres"},
    {"--samples", "N|auto", "states drawn; auto grows until start and goal connect (default: auto)"},
    {"--neighbours", "K|auto|star", "join each milestone to its K nearest; star: by the rule of PRM* (default: auto)"},
    {"--radius", "R|auto|star",
     "join milestones at most so far apart, instead of the K nearest; star: by the rule of PRM* (default: auto)"},
    {"--neighbour-index", "NAME",
     "what finds neighbours of points and discs; the path is the same (default: auto, a grid, or a k-d tree where "
     "milestones crowd); other bodies have the k-d tree",
     "auto kd-tree grid brute"},
    {"--search", "NAME", "how the roadmap is searched (default: astar)", "astar dijkstra bfs dfs"},
    {"--heuristic", "NAME",
     "how astar estimates the distance to the goal, for points and discs. manhattan and octile may give a longer "
     "path; warren then says by how much (default: euclidean)",
     "euclidean manhattan octile chebyshev zero"},
    {"--queue", "NAME", "the queue of astar and dijkstra (default: heap)",
     "heap lazy-heap sorted-array resorted-array"},
    {"--lazy",
     "[WHEN]",
     "lazy-prm checks an edge when the search expands it; there is no other way (default: expansion)",
     "expansion",
     {},
     true},
    {"--pipeline", "NAME",
     "how prm works. plain: one stage after the other; tiled: each tile through all stages, in cache; streamed: as "
     "tiled, without holding the maze (mst only). Default: tiled on lattices, streamed where memory does not hold the "
     "maze, else plain",
     "plain tiled streamed"},
    {"--optimise", "", "shorten the path after the search"},
    {"--seed", "N", "seed of the sampling; never alters the world (default: 1)"},
};

constexpr OptionSpec polygon_planner_specs[] = {
    {"--full", "", "visibility: all visible edges instead of those that shortest paths take"},
    {"--sampled-edges", "D",
     "visibility: test edges at points D apart instead of exactly, and say which edges are wrong"},
    {"--doors", "NAME",
     "cells: pass from cell to cell in the door's middle, or where the shortest path does (default: midpoint)",
     "midpoint funnel"},
    {"--objective", "NAME", "voronoi: the shortest path, or the widest and then the shortest (default: length)",
     "length clearance"},
};

constexpr OptionSpec body_specs[] = {
    {"--steering", "WORD", "a car's curves: forwards only, or backwards too (default: the file's, else dubins)",
     "dubins reeds-shepp"},
    {"--turning-radius", "RHO", "how tightly a car turns, > 0 (default: the file's)"},
    {"--cusp-cost", "C",
     "with --optimise: the length that a car may add to save one change of gear, >= 0 (default: its turning radius)"},
    {"--reverse-cost", "F", "with --optimise: cost of driving backwards, where forwards is 1, >= 1 (default: 1)"},
    {"--attach", "R[,STEP]",
     "arms: join start and goal to a roadmap within R, and while that fails within STEP more, 10 times in all "
     "(default: as far as the K nearest, and half of that)"},
};

StarRule star_rule(const Arguments& arguments) {
  const bool neighbours = arguments.value("--neighbours") == "star";
  const bool radius = arguments.value("--radius") == "star";
  if (neighbours && radius) throw UsageError("--radius: one rule of PRM* joins milestones, by neighbours or by radius");
  return neighbours ? StarRule::neighbours : radius ? StarRule::radius : StarRule::none;
}

RoadmapFields roadmap_fields(const Arguments& arguments) {
  constexpr std::uint64_t most_neighbours = 4096;
  constexpr std::uint64_t least = 1;
  RoadmapFields roadmap;
  roadmap.samples = given_value(arguments, "--samples", samples_value);
  roadmap.star = star_rule(arguments);
  if (roadmap.star != StarRule::neighbours) {
    const auto count = given_value(arguments, "--neighbours", auto_or_count_value, least, most_neighbours);
    if (count) roadmap.neighbours = static_cast<std::uint32_t>(*count);
  }
  if (const auto text = arguments.value("--radius"); text && *text != "auto" && *text != "star") {
    roadmap.radius = positive_value("--radius", *text);
  }
  const auto lazy = arguments.value("--lazy");
  if (lazy && !lazy->empty()) roadmap.lazy = choice_value<LazyCheck>("--lazy", *lazy);
  roadmap.pipeline = given_choice<PipelineKind>(arguments, "--pipeline");
  return roadmap;
}

GrowingAttach attach_value(std::string_view option, std::string_view text) {
  GrowingAttach attach;
  const std::size_t comma = text.find(',');
  attach.radius = positive_value(option, text.substr(0, comma));
  if (comma != std::string_view::npos) attach.step = positive_value(option, text.substr(comma + 1));
  return attach;
}

}  // namespace

std::span<const OptionSpec> roadmap_option_specs() { return roadmap_specs; }

std::uint64_t seed_value(std::string_view option, std::string_view text) {
  return count_value(option, text, 0, std::numeric_limits<std::uint64_t>::max());
}

std::uint64_t seed_word(const Arguments& arguments) { return given_value(arguments, "--seed", seed_value).value_or(1); }

std::optional<std::uint64_t> samples_value(std::string_view option, std::string_view text) {
  constexpr std::uint64_t most_samples = std::uint64_t{1} << 31;
  return auto_or_count_value(option, text, 1, most_samples);
}

SearchMethod search_value(std::string_view option, std::string_view text, std::optional<PlannerKind> planner) {
  if (const auto method = enum_named<SearchMethod>(text)) return *method;
  if (planner == PlannerKind::grid) choice_value<GridMethod>(option, text);  // says which there are
  return static_cast<SearchMethod>(choice_value<SearchKind>(option, text));
}

SolveOptions roadmap_words(const Arguments& arguments) {
  SolveOptions options;
  options.planner = given_choice<PlannerKind>(arguments, "--planner");
  options.roadmap = roadmap_fields(arguments);
  options.search = given_value(arguments, "--search", search_value, options.planner);
  options.queue = given_choice<QueueKind>(arguments, "--queue");
  options.heuristic = given_choice<HeuristicKind>(arguments, "--heuristic");
  options.roadmap.neighbour_index = given_choice<NeighbourIndex>(arguments, "--neighbour-index");
  options.seed = seed_word(arguments);
  options.visibility.lazy = arguments.value("--lazy") == "";
  options.sampler = given_choice<SamplerKind>(arguments, "--sampler");
  options.optimise = arguments.has("--optimise");
  return options;
}

SolveOptions solve_words(const Arguments& arguments) {
  SolveOptions options = roadmap_words(arguments);
  options.roadmap.attach = given_value(arguments, "--attach", attach_value);
  options.trees = tree_words(arguments);
  options.grid = grid_words(arguments);
  options.cells.doors = given_choice<DoorKind>(arguments, "--doors");
  options.axis.objective = given_choice<AxisObjective>(arguments, "--objective");
  options.visibility.full = arguments.has("--full");
  options.visibility.sampled_edges = given_value(arguments, "--sampled-edges", positive_value);
  options.car.steering = given_choice<SteeringKind>(arguments, "--steering");
  options.car.turning_radius = given_value(arguments, "--turning-radius", positive_value);
  options.car.cusp_cost = given_value(arguments, "--cusp-cost", number_value, 0.0, largest_coordinate);
  options.car.reverse_cost = given_value(arguments, "--reverse-cost", number_value, 1.0, largest_coordinate);
  return options;
}

std::string names_of_planners(bool (*are)(PlannerKind)) {
  std::string words;
  for (const PlannerKind planner : planners_there_are()) {
    if (are(planner)) words.append(words.empty() ? "" : " ").append(name_of(planner));
  }
  return words;
}

std::string_view planner_names() {
  static const std::string names = names_of_planners([](PlannerKind) { return true; });
  return names;
}

std::optional<Option> option_of_words(std::string_view words) {
  std::string name{words.substr(2)};
  std::replace(name.begin(), name.end(), '-', '_');
  return enum_named<Option>(name);
}

std::vector<OptionSpec> solve_option_specs() {
  std::vector<OptionSpec> specs;
  add_options(specs, roadmap_specs);
  specs.front().choices = planner_names();
  add_options(specs, grid_option_specs());
  add_options(specs, polygon_planner_specs);
  add_options(specs, tree_option_specs());
  add_options(specs, body_specs);
  return specs;
}

RoadmapSearchFields search_words(const Arguments& arguments) {
  const SolveOptions words = solve_words(arguments);
  return {words.search,           words.queue,    words.roadmap.attach, words.optimise, words.car.cusp_cost,
          words.car.reverse_cost, words.heuristic};
}

// What a command line says about grids and lattices.

namespace {

constexpr OptionSpec grid_specs[] = {
    {"--cell", "C",
     "grid in a scene: distance of its positions (default: the file's grid line, else a 400th of the longer side)"},
    {"--angles", "N", "grid: headings of a body that turns (default: the file's grid line, else 72)"},
    {"--face-motion", "", "grid of a body that turns: it moves only where it faces"},
    {"--step-cost", "C", "grid in a scene or of a body that turns: what a step to the side costs (default: 1)"},
    {"--turn-cost", "C", "grid of a body that turns: what a turn to the next heading costs (default: 1)"},
    {"--diagonal", "NAME", "grid: what a diagonal step costs (default: sqrt2)", "sqrt2 unit none"},
    {"--layers", "NAME",
     "grid in a scene. exact: the body's own outline; report004: discs that cover it, rounded up to cells, among walls "
     "two cells thick (default: exact)",
     "exact report004"},
};

}  // namespace

std::span<const OptionSpec> grid_option_specs() { return grid_specs; }

GridFields grid_words(const Arguments& arguments) {
  constexpr std::uint32_t most_angles = 1'000'000;
  GridFields grid;
  grid.cell = given_value(arguments, "--cell", positive_value);
  grid.angles = given_count(arguments, "--angles", 1, most_angles);
  grid.face_motion = arguments.has("--face-motion");
  grid.step_cost = given_value(arguments, "--step-cost", positive_value);
  grid.turn_cost = given_value(arguments, "--turn-cost", positive_value);
  grid.diagonal = given_choice<Diagonal>(arguments, "--diagonal");
  grid.layers = given_choice<LayerKind>(arguments, "--layers");
  return grid;
}

// What a command line says about rrt and rrt-connect.

namespace {

constexpr OptionSpec tree_specs[] = {
    {"--step", "D", "longest motion of a tree, in the body's metric (default: a third of half the space's diagonal)"},
    {"--goal-bias", "F", "share of rrt's samples that are the goal (default: 0.05)"},
    {"--nodes", "N", "most nodes of a tree; a tree that has them gives up (default: 100000)"},
    {"--trees", "N", "trees grown independently at once; the first to arrive answers (default: 1)"},
    {"--via", "STATES",
     "waypoints to pass in this order, apart by semicolons; each X,Y or X,Y,THETA or six joint angles"},
};

std::vector<std::vector<double>> way_points_value(std::string_view option, std::string_view text) {
  std::vector<std::vector<double>> points;
  for (;;) {
    const std::size_t end = text.find(';');
    points.push_back(state_value(option, text.substr(0, end)));
    if (end == std::string_view::npos) return points;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::span<const OptionSpec> tree_option_specs() { return tree_specs; }

TreeFields tree_words(const Arguments& arguments) {
  constexpr std::uint64_t most_nodes = std::uint64_t{1} << 31;
  constexpr std::uint32_t most_trees = 4096;
  TreeFields trees;
  trees.step = given_value(arguments, "--step", positive_value);
  trees.goal_bias = given_value(arguments, "--goal-bias", number_value, 0.0, 1.0);
  trees.nodes = given_value(arguments, "--nodes", count_value, std::uint64_t{2}, most_nodes);
  trees.trees = given_count(arguments, "--trees", 1, most_trees);
  if (const auto text = arguments.value("--via")) trees.via = way_points_value("--via", *text);
  return trees;
}

}  // namespace warren::tools
