// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/question_words.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <limits>

#include "core/base/error.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "tools/words/option_values.hpp"

namespace warren::tools {
namespace {

/// Those of the planners that build roadmaps of samples come first.
constexpr OptionSpec planner_specs[] = {
    {"--planner", "NAME",
     "how to find the path. prm joins samples to a roadmap and checks all of it, lazy-prm only what the search meets "
     "(default: prm on a lattice, else lazy-prm)",
     "prm lazy-prm"},
    {"--sampler", "NAME",
     "how samples are placed. uniform, halton, random: all over the world; lattice, cell-centres: in the middles of "
     "cells; gaussian: along obstacles; bridge: in narrow gaps; mixture: half uniform, half these two; corridor: along "
     "the middles of a map's corridors. Default: lattice in mazes, cell-centres on maps whose corridors are a cell "
     "wide, else uniform",
     choices_of<SamplerKind>},
    {"--samples", "N|auto",
     "how many samples to draw; auto: more and more, until start and goal are joined (default: auto)"},
    {"--neighbours", "K|auto|star",
     "join each milestone (a sample where the body fits) to its K nearest; star: as many as PRM* takes (default: "
     "auto)"},
    {"--radius", "R|auto|star",
     "join all milestones that are at most R apart, instead of the K nearest; star: as far as PRM* goes (default: "
     "auto)"},
    {"--neighbour-index", "NAME",
     "how the nearest milestones are found, for points and discs; the path is the same. auto: by a grid, or by a k-d "
     "tree where milestones crowd; brute: by looking at all (default: auto)",
     choices_of<NeighbourIndex>},
    {"--search", "NAME", "how the roadmap is searched (default: astar)", choices_of<SearchKind>},
    {"--heuristic", "NAME",
     "how astar estimates the distance to the goal, for points and discs. manhattan and octile may give a longer "
     "path; warren then says by how much (default: euclidean)",
     choices_of<HeuristicKind>},
    {"--queue", "NAME", "the priority queue of astar and dijkstra (default: heap)", choices_of<QueueKind>},
    {.name = "--lazy",
     .value = "[WHEN]",
     .help = "visibility: look for edges only where the search needs them (by itself from 20000 corners on). lazy-prm "
             "always does so, and takes --lazy expansion",
     .choices = choices_of<LazyCheck>,
     .value_optional = true},
    {"--pipeline", "NAME",
     "how prm works through a maze. plain: one stage after the other; tiled: square by square, each through all "
     "stages while it is in the cache; streamed: as tiled, without holding the whole maze in memory. Default: tiled on "
     "lattices, streamed where memory does not hold the maze, else plain",
     choices_of<PipelineKind>},
    {"--optimise", "", "pull the path taut after the search, which makes it shorter"},
    {"--seed", "N",
     "seed of all that is random in planning: another seed, another roadmap or tree, in the same world (default: 1)"},
    {"--cell", "C",
     "grid in a scene: how far apart its positions are (default: the file's grid line, else a 400th of the longer "
     "side)"},
    {"--angles", "N", "grid: number of headings for a body that turns (default: the file's grid line, else 72)"},
    {"--headings", "N", "grid, for a car: headings of the lattice that its motions join, 16 or 32 (default: 16)"},
    {"--face-motion", "", "grid: a body that turns moves only the way it faces"},
    {"--step-cost", "C", "grid in a scene, or for a body that turns: cost of a step to the next position (default: 1)"},
    {"--turn-cost", "C",
     "grid: cost of a turn to the next heading, for a body that turns (default: 1); of a radian for a car (default: "
     "0)"},
    {"--diagonal", "NAME",
     "grid: cost of a diagonal step, sqrt2 or 1 (unit) times that of a straight one; none: there are none (default: "
     "sqrt2)",
     choices_of<Diagonal>},
    {"--layers", "NAME",
     "grid in a scene: what blocks a cell. exact: the body's own outline; report004: as a course report had it, discs "
     "that cover the body, rounded up to cells, among walls two cells thick (default: exact)",
     choices_of<LayerKind>},
    {"--full", "", "visibility: join all corners that see each other, not only those that a shortest path can join"},
    {"--sampled-edges", "D",
     "visibility: test edges at points D apart instead of exactly, and say which edges are wrong"},
    {"--doors", "NAME",
     "cells: cross the border to the next cell in its middle (midpoint), or where the path gets shortest (funnel) "
     "(default: midpoint)",
     choices_of<DoorKind>},
    {"--objective", "NAME",
     "voronoi: length takes the shortest way, clearance the widest, and of these the shortest (default: length)",
     choices_of<AxisObjective>},
    {"--step", "D",
     "all rrt planners: longest motion that is added to a tree at once (default: a sixth of the space's diagonal)"},
    {"--goal-bias", "F",
     "all rrt planners but rrt-connect: how often they aim at the goal instead of a random place, 0 to 1 (default: "
     "0.05)"},
    {"--nodes", "N",
     "all rrt planners: most nodes of a tree (default: 100000; rrt-star and informed-rrt-star 16777216)"},
    {"--trees", "N", "rrt, rrt-connect: grow so many trees independently; the first to arrive answers (default: 1)"},
    {"--iterations", "N",
     "anytime, rrt-star, informed-rrt-star: end after N turns of work, which gives the same answer on any machine. "
     "--budget ends them, too, with the best path so far"},
    {"--gap", "SHARE",
     "anytime, rrt-star, informed-rrt-star: end when the path is proved to be at most SHARE, such as 1% or 0.01, "
     "longer than the shortest"},
    {"--parts", "LIST",
     "anytime: what takes turns, separated by commas: tree, restarts, roadmap, shorten (default: all)"},
    {"--bound", "", "also prove a lower bound, how short no path can be, as near as can be; takes time of its own"},
    {.name = "--via",
     .value = "STATES",
     .help = "waypoints to pass in this order, separated by semicolons: \"X,Y; X,Y,THETA\", or joint angles; or given "
             "several times. All planners take them, leg by leg",
     .goes_on = true},
    {"--steering", "WORD",
     "how a car drives: dubins forwards only, reeds-shepp backwards too, differential straight both ways with turns on "
     "the spot (default: the file's, else dubins)",
     choices_of<SteeringKind>},
    {"--turning-radius", "RHO",
     "radius of a car's tightest turn, > 0; of differential what a radian of turning counts (default: the file's)"},
    {"--cusp-cost", "C",
     "with --optimise: how much longer a car may drive to save one change of gear, >= 0 (default: its turning radius)"},
    {"--reverse-cost", "F",
     "with --optimise: how many times dearer driving backwards is than forwards, >= 1 (default: 1)"},
    {"--attach", "R[,STEP]",
     "arms: join start and goal to the milestones within R of them. Where that fails, STEP is added to R, at most 10 "
     "times (default: R as far as the K nearest, STEP half of that)"},
};
constexpr std::size_t roadmap_spec_count = 13;

/// Reads what the words say of one option into its field, where they say something.
struct OptionReader {
  const Arguments& arguments;
  std::optional<PlannerKind> planner;

  template <class T>
  void operator()(Option option, OptionRange range, T& field) const {
    const std::string_view flag = option_flag(option);
    if (const auto text = arguments.value(flag)) read(flag, *text, range, field);
  }

 private:
  /// A flag, or --lazy without a word.
  static void read(std::string_view, std::string_view text, OptionRange, bool& field) { field = text.empty(); }
  static void read(std::string_view flag, std::string_view text, OptionRange range, std::optional<double>& field) {
    if (flag == "--radius" && (text == "auto" || text == "star")) return;
    if (flag == "--gap") return static_cast<void>(field = share_value(flag, text));
    field =
        range.high > largest_coordinate ? positive_value(flag, text) : number_value(flag, text, range.low, range.high);
  }
  template <std::integral N>
  static void read(std::string_view flag, std::string_view text, OptionRange range, std::optional<N>& field) {
    if (flag == "--neighbours" && text == "star") return;
    const auto low = static_cast<std::uint64_t>(range.low);
    const auto high = static_cast<std::uint64_t>(range.high);
    const bool may_be_open = flag == "--samples" || flag == "--neighbours";
    const auto count = may_be_open ? auto_or_count_value(flag, text, low, high) : count_value(flag, text, low, high);
    if (count) field = static_cast<N>(*count);
  }
  template <NamedEnum E>
  static void read(std::string_view flag, std::string_view text, OptionRange, std::optional<E>& field) {
    if (flag != "--lazy" || !text.empty()) field = choice_value<E>(flag, text);
  }
  /// Jump points are for grids alone, and who plans elsewhere is not told of them.
  void read(std::string_view flag, std::string_view text, OptionRange, std::optional<SearchMethod>& field) const {
    field = enum_named<SearchMethod>(text);
    if (!field && planner == PlannerKind::grid) choice_value<GridMethod>(flag, text);  // says which there are
    if (!field) choice_value<SearchKind>(flag, text);
  }
  static void read(std::string_view flag, std::string_view text, OptionRange, std::optional<GrowingAttach>& field) {
    const std::size_t comma = text.find(',');
    field.emplace().radius = positive_value(flag, text.substr(0, comma));
    if (comma != std::string_view::npos) field->step = positive_value(flag, text.substr(comma + 1));
  }
  static void read(std::string_view flag, std::string_view text, OptionRange, std::vector<AnytimePart>& field) {
    for (const std::string& word : list_value(flag, text)) field.push_back(choice_value<AnytimePart>(flag, word));
  }
  static void read(std::string_view flag, std::string_view text, OptionRange, std::vector<std::vector<double>>& field) {
    field = states_value(flag, text);
  }
};

}  // namespace

std::span<const OptionSpec> roadmap_option_specs() { return std::span(planner_specs).first(roadmap_spec_count); }

std::uint64_t seed_value(std::string_view option, std::string_view text) {
  return count_value(option, text, 0, std::numeric_limits<std::uint64_t>::max());
}

std::uint64_t seed_word(const Arguments& arguments) { return given_value(arguments, "--seed", seed_value).value_or(1); }

SolveOptions solve_words(const Arguments& arguments) {
  SolveOptions options;
  options.planner = given_choice<PlannerKind>(arguments, "--planner");
  options.seed = seed_word(arguments);
  const bool neighbours = arguments.value("--neighbours") == "star";
  const bool radius = arguments.value("--radius") == "star";
  if (neighbours && radius) throw UsageError("--radius: one rule of PRM* joins milestones, by neighbours or by radius");
  options.roadmap.star = neighbours ? StarRule::neighbours : radius ? StarRule::radius : StarRule::none;
  visit_options(OptionReader{arguments, options.planner}, options);
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

std::string_view option_flag(Option option) {
  static const std::array<std::string, option_count> flags = [] {
    std::array<std::string, option_count> all;
    for (std::size_t i = 0; i < option_count; ++i) {
      all[i] = "--" + std::string(name_of(static_cast<Option>(i)));
      std::replace(all[i].begin(), all[i].end(), '_', '-');
    }
    return all;
  }();
  return flags[static_cast<std::size_t>(option)];
}

std::optional<Option> option_of_words(std::string_view words) {
  for (std::size_t i = 0; i < option_count; ++i) {
    if (option_flag(static_cast<Option>(i)) == words) return static_cast<Option>(i);
  }
  return std::nullopt;
}

std::vector<OptionSpec> solve_option_specs() {
  std::vector<OptionSpec> specs(std::begin(planner_specs), std::end(planner_specs));
  specs.front().choices = planner_names();
  specs.front().help =
      "how to find the path. prm joins samples to a roadmap and checks all of it, lazy-prm only what the search meets. "
      "visibility: the shortest path among polygons; cells: through slices of the free space; voronoi: as far "
      "from obstacles as can be. rrt grows a tree from the start, rrt-connect one from either end. grid searches "
      "cells. anytime, rrt-star and informed-rrt-star get better until they are stopped (default: by world and body)";
  return specs;
}

}  // namespace warren::tools
