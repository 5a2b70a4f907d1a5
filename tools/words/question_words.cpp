// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/question_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <tuple>

#include "solve/kinds/kind_of_problem.hpp"
#include "solve/question/asked_words.hpp"
#include "tools/words/option_values.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec question_specs[] = {
    {"--robot", "\"BODY\"",
     "the moving body: \"point\", \"disc RADIUS\", \"polygon X Y X Y ...\" (or \"[[X, Y], ...]\"), \"car polygon X Y "
     "... turning RHO\", \"puma560 radius R\", \"arm FILE radius R\" or \"urdf FILE\". X and Y of a corner count from "
     "the place that --start names; RHO is the radius of the tightest turn (default: the file's, else point)"},
    {"--start", "X,Y[,THETA]",
     "where to start: X,Y; for a body that turns X,Y,THETA (radians, or 90deg); for an arm one number a "
     "joint (default: the file's)"},
    {.name = "--goal",
     .value = "X,Y[,THETA]",
     .help = "where to arrive, as --start; without THETA at any heading. X,Y,Z: a place of an arm's tool. Several "
             "times: the cheapest to reach (default: the file's)",
     .may_repeat = true},
    {"--goal-pose", "X,Y,Z,QX,QY,QZ,QW",
     "where an arm's tool is to arrive: a place, and a turn as a quaternion (default: the file's)"},
    {"--clearance", "R",
     "room to keep around the body along the whole path (default: the file's, else 0.1 in mazes, else 0)"},
    {"--contact", "WORD",
     "with clearance 0: may the path touch obstacles? allowed: it may run along a wall or around a corner, never "
     "through. blocked: it keeps off, however little (default: allowed for visibility and cells, else blocked)",
     choices_of<Contact>},
};

constexpr OptionSpec asked_specs[] = {
    {"--clearance-price", "P[,D]",
     "what nearness costs: a metre in touch with an obstacle costs P metres more, from a distance D on nothing "
     "(default of D: the body's least width)"},
    {.name = "--area",
     .value = "AREA",
     .help =
         "\"F X Y X Y X Y ...\": in this polygon a metre costs F metres, F at least 1; may be given several times: the "
         "greatest counts",
     .may_repeat = true},
    {.name = "--areas",
     .value = "FILE,F",
     .help = "a mask, as map servers read it: its values 1 to 99 are factors up to F, 100 is blocked",
     .may_repeat = true},
    {.name = "--speed-zones",
     .value = "FILE[,BASE,MULTIPLIER]",
     .help = "a mask of Nav2's speed limits, BASE + MULTIPLIER * value per cent: slow cells cost as much longer, a "
             "limit of 0 is blocked (default: 100,-1)",
     .may_repeat = true},
    {.name = "--keep-out",
     .value = "FILE[,F]",
     .help =
         "nothing may be in these areas: a mask's value 100, or the polygons of a GeoJSON or scene. With F they are "
         "passable, and a metre costs F metres",
     .may_repeat = true},
    {"--unknown", "blocked|F",
     "unknown cells of a map: blocked, or passable, where a metre costs F metres, F at least 1 (default: blocked)"},
    {"--goal-tolerance", "R[,ANGLE]",
     "where the goal is blocked or cut off: go to the place nearest to it, at most R away; inf: wherever that is. "
     "The heading may be off by ANGLE"},
    {"--goal-region", "R[,ANGLE]", "any place at most R away from the goal will do: the one that is cheapest to reach"},
    {.name = "--visit",
     .value = "PLACES",
     .help =
         "pass these places, \"X,Y; X,Y; ...\", at most 12, in the order that costs least, then go to the goal. Bodies "
         "that turn: X,Y or X,Y,THETA; arms: joint angles. Or given several times",
     .goes_on = true},
    {"--return", "", "with --visit: end at the start; there is no goal then"},
    {"--alternatives", "K[,SIZE]",
     "also tell other ways: of each of the K next cheapest classes the cheapest path. Paths are of one class where "
     "obstacles at least SIZE across are on the same sides of them (default of SIZE: the body's length; 0: all)"},
    {"--stretch", "S", "with --alternatives: they cost at most S times as much as the cheapest (default: 1.5)"},
    {"--keep-to", "OLD.json",
     "go on along the path of this older answer, unless that is blocked now or a new one is clearly cheaper"},
    {"--unless-gain", "SHARE", "with --keep-to: by which share of the cost, such as 10% (default: 5%)"},
};
constexpr std::size_t price_count = 6;

RobotSpec robot_option(std::string_view option, std::string_view text) {
  return as_usage([&] { return robot_value(std::string{option}, text); });
}

Eigen::Isometry3d pose_value(std::string_view option, std::string_view text) {
  const std::vector<double> n = state_value(option, text);
  const Eigen::Quaterniond turn =
      n.size() == 7 ? Eigen::Quaterniond(n[6], n[3], n[4], n[5]) : Eigen::Quaterniond(0, 0, 0, 0);
  if (!(turn.norm() > 0.0)) {
    throw UsageError(
        fmt::format("{}: expected X,Y,Z,QX,QY,QZ,QW with a quaternion that is not 0 (found: '{}')", option, text));
  }
  return Eigen::Translation3d(n[0], n[1], n[2]) * turn.normalized();
}

double factor_value(std::string_view option, std::string_view text) {
  return number_value(option, text, 1.0, largest_price);
}

ClearancePrice clearance_price_value(std::string_view option, std::string_view text) {
  const std::size_t comma = text.find(',');
  ClearancePrice price{number_value(option, text.substr(0, comma), 0.0, largest_price)};
  if (comma != std::string_view::npos) price.reach = positive_value(option, text.substr(comma + 1));
  return price;
}

/// "FILE,1,2": the numbers behind the last commas, as many as there may be or none; a name may have commas, too.
std::pair<std::string, std::vector<std::string>> file_and_numbers(std::string_view option, std::string_view text,
                                                                  std::size_t count) {
  std::vector<std::string> numbers;
  std::string_view file = text;
  while (numbers.size() < count) {
    const std::size_t comma = file.rfind(',');
    if (comma == std::string_view::npos || !number_in(file.substr(comma + 1))) break;
    numbers.emplace(numbers.begin(), file.substr(comma + 1));
    file = file.substr(0, comma);
  }
  if (file.empty() || (!numbers.empty() && numbers.size() < count)) {
    throw UsageError(fmt::format("{}: expected {} (found: '{}')", option,
                                 count == 2 ? "FILE or FILE,BASE,MULTIPLIER" : "FILE,F", text));
  }
  return {std::string(file), numbers};
}

/// "R" or "R,ANGLE"
std::pair<double, std::optional<double>> nearness_value(std::string_view option, std::string_view text,
                                                        bool may_be_infinite) {
  const std::size_t comma = text.find(',');
  const std::string_view distance = text.substr(0, comma);
  std::optional<double> angle;
  if (comma != std::string_view::npos) angle = std::abs(angle_value(option, text.substr(comma + 1)));
  if (may_be_infinite && distance == "inf") return {std::numeric_limits<double>::infinity(), angle};
  return {number_value(option, distance, 0.0, largest_coordinate), angle};
}

GoalRule goal_words(const Arguments& arguments) {
  GoalRule rule;
  const std::vector<std::string> goals = arguments.values("--goal");
  for (std::size_t i = 1; i < goals.size(); ++i) rule.others.push_back(state_value("--goal", goals[i]));
  if (const auto text = arguments.value("--goal-tolerance"))
    std::tie(rule.tolerance, rule.heading_rad) = nearness_value("--goal-tolerance", *text, true);
  if (const auto text = arguments.value("--goal-region"))
    std::tie(rule.region, rule.heading_rad) = nearness_value("--goal-region", *text, false);
  if (const auto text = arguments.value("--visit")) rule.visit = states_value("--visit", *text);
  rule.back = arguments.has("--return");
  if (rule.back && !goals.empty()) throw UsageError("--return: ends at the start, and there is a --goal, too; say one");
  check_goal_rule(rule);
  return rule;
}

/// "K" or "K,SIZE"; keep_to is a file, which is read later.
RouteRule route_words(const Arguments& arguments) {
  RouteRule route;
  if (const auto text = arguments.value("--alternatives")) {
    const std::string_view words = *text;
    const std::size_t comma = words.find(',');
    route.alternatives =
        static_cast<std::uint32_t>(count_value("--alternatives", words.substr(0, comma), 1, most_alternatives));
    if (comma != std::string_view::npos)
      route.hole = number_value("--alternatives", words.substr(comma + 1), 0.0, largest_coordinate);
  }
  route.stretch = given_value(arguments, "--stretch", number_value, 1.0, largest_coordinate);
  if (route.stretch && !route.alternatives) throw UsageError("--stretch: is for --alternatives");
  route.unless_gain = given_value(arguments, "--unless-gain", share_value);
  if (route.unless_gain.value_or(0.0) >= 1.0) throw UsageError("--unless-gain: expected a share below 1, such as 5%");
  return route;
}

constexpr OptionSpec maze_specs[] = {
    {"--algorithm", "NAME", "how the mazes are made (default: backtracker)", choices_of<MazeAlgorithm>},
    {"--loops", "F", "share of the inner walls that is taken out, which makes loops, 0 to 1 (default: 0)"},
};

// Planners.

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

// Pictures, and paths as files.

constexpr OptionSpec picture_specs[] = {
    {"--show", "LIST",
     "what a picture shows, separated by commas: world, roadmap, search, path, body, axes, legend (default: all)"},
    {"--heading", "ANGLE",
     "for a body that turns, in radians or as 45deg: shade where it has no room at this heading, and draw milestones "
     "as arrows"},
    {"--size", "WxH", "size of a picture in pixels, or in millimetres as 180x120mm (default: by the world)"},
    {"--dpi", "N", "pixels an inch of a picture, 10 to 2400 (default: 96; of a .png as many as its cells need)"},
    {"--title", "TEXT", "title of a picture; an empty one leaves it out (default: the world and how it was solved)"},
};

PageSize page_size_value(std::string_view option, std::string_view text) {
  PageSize size;
  std::string_view numbers = text;
  if (numbers.ends_with("mm")) size.unit = LengthUnit::mm;
  if (numbers.ends_with("mm") || numbers.ends_with("px")) numbers.remove_suffix(2);
  const std::size_t cross = numbers.find('x');
  const auto width = number_in(numbers.substr(0, cross));
  const auto height = cross < numbers.size() ? number_in(numbers.substr(cross + 1)) : std::nullopt;
  if (!width || !height) {
    throw UsageError(fmt::format("{}: expected WxH in pixels or WxHmm (found: '{}')", option, text));
  }
  size.width = *width;
  size.height = *height;
  return size;
}

constexpr OptionSpec path_specs[] = {
    {"--path", "FILE", "write the path: .csv, .yaml (ROS nav_msgs/Path), .geojson or .npy by ending"},
    {"--every", "D|TIME",
     "with --path: add places, so that no two are more than D apart; or, with --speed, give a place every 100ms, say "
     "(default: the path's own places, and on a car's arcs one each 5 degrees)"},
    {"--speed", "V",
     "with --path: add times, for driving at most so fast (units of length a second) and stopping at corners"},
    {"--acceleration", "A", "with --speed: how hard to speed up and brake (default: at once)"},
    {"--lateral-acceleration", "A",
     "with --speed: how hard a car may corner, which makes it slow on tight arcs (default: any)"},
    {"--joint-speed", "W[,...]",
     "with --path, for arms: add times, for turning at most so fast (rad/s): one number for all joints, or "
     "one each, or 'file': as the URDF has them"},
    {"--joint-acceleration", "A[,...]",
     "with --joint-speed: how hard joints speed up and brake (rad/s^2), one number or one a joint (default: at once)"},
    {"--frame", "NAME", "with --path: name of the coordinate frame in .yaml and .geojson (default: map)"},
};

std::vector<double> joint_values(std::string_view option, std::string_view text) {
  if (option == "--joint-speed" && text == "file") return {speed_of_file};
  if (number_in(text)) return {positive_value(option, text)};
  std::vector<double> values = state_value(option, text);
  if (std::ranges::all_of(values, [](double x) { return x > 0.0; })) return values;
  throw UsageError(
      fmt::format("{}: expected one number above 0, or one a joint, separated by commas (found: '{}')", option, text));
}

}  // namespace

std::span<const OptionSpec> question_option_specs() { return question_specs; }

std::span<const OptionSpec> asked_option_specs() { return asked_specs; }

std::span<const OptionSpec> price_option_specs() { return std::span(asked_specs).first(price_count); }

Prices price_words(const Arguments& arguments) {
  Prices prices;
  prices.clearance = given_value(arguments, "--clearance-price", clearance_price_value);
  for (std::string& text : arguments.values("--area")) {
    std::ranges::replace(text, ';', ' ');
    prices.areas.push_back(as_usage([&] { return area_value("--area", text); }));
  }
  for (const auto& [option, kind] : {std::pair("--areas", MaskKind::areas), std::pair("--speed-zones", MaskKind::speed),
                                     std::pair("--keep-out", MaskKind::keep_out)}) {
    const bool is_speed = kind == MaskKind::speed;
    for (const std::string& text : arguments.values(option)) {
      const auto [file, numbers] = file_and_numbers(option, text, is_speed ? 2 : 1);
      if (kind == MaskKind::areas && numbers.empty())
        throw UsageError(fmt::format("--areas: expected FILE,F (found: '{}')", text));
      PriceMask& mask = prices.masks.emplace_back(PriceMask{.kind = kind, .file = file});
      constexpr double most = 1e6;
      if (!numbers.empty() && !is_speed) mask.factor = factor_value(option, numbers[0]);
      if (!numbers.empty() && is_speed) mask.base = number_value(option, numbers[0], -most, most);
      if (!numbers.empty() && is_speed) mask.multiplier = number_value(option, numbers[1], -most, most);
    }
  }
  if (const auto unknown = arguments.value("--unknown")) {
    const bool blocked = *unknown == "blocked";
    prices.unknown = blocked ? std::numeric_limits<double>::infinity() : factor_value("--unknown", *unknown);
  }
  return prices;
}

Question question_words(const Arguments& arguments) {
  Question question;
  question.robot = given_value(arguments, "--robot", robot_option);
  if (const auto text = arguments.value("--start")) question.start = state_value("--start", *text);
  if (const auto text = arguments.value("--goal")) question.goal = state_value("--goal", *text);
  if (const auto text = arguments.value("--goal-pose")) question.goal_pose = pose_value("--goal-pose", *text);
  if (question.goal_pose && !question.goal.empty()) throw UsageError("--goal-pose: there is a --goal, too; say one");
  question.clearance = given_value(arguments, "--clearance", number_value, 0.0, largest_coordinate);
  question.contact = given_choice<Contact>(arguments, "--contact");
  question.prices = price_words(arguments);
  question.rule = goal_words(arguments);
  question.route = route_words(arguments);
  return question;
}

std::span<const OptionSpec> maze_option_specs() { return maze_specs; }

MazeOptions maze_words(const Arguments& arguments, MazeOptions usual) {
  usual.loops = given_value(arguments, "--loops", number_value, 0.0, 1.0).value_or(usual.loops);
  usual.algorithm = given_choice<MazeAlgorithm>(arguments, "--algorithm").value_or(usual.algorithm);
  return usual;
}

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

std::span<const OptionSpec> picture_option_specs() { return picture_specs; }

PictureOptions picture_words(const Arguments& arguments, bool is_drawn, std::string_view draws, std::string_view file) {
  PictureOptions options;
  if (!is_drawn) {
    arguments.refuse(picture_specs, fmt::format("goes with {}", draws));
    return options;
  }
  if (file.ends_with(".html")) arguments.refuse({"--size", "--dpi"}, "a page fills its window; say .svg, .png or .pdf");
  if (arguments.has("--show")) {
    options.parts = {};
    for (const Part part : given_values(arguments, "--show", "--show", choice_value<Part>)) {
      options.parts = options.parts | Parts{part};
    }
  }
  constexpr double least_dpi = 10.0;
  constexpr double most_dpi = 2400.0;
  options.size = given_value(arguments, "--size", page_size_value);
  options.dpi = given_value(arguments, "--dpi", number_value, least_dpi, most_dpi);
  options.heading = given_value(arguments, "--heading", angle_value);
  options.title = arguments.value("--title");
  options.validate();
  return options;
}

std::span<const OptionSpec> path_option_specs() { return path_specs; }

PathFileOptions path_words(const Arguments& arguments) {
  if (!arguments.has("--path")) {
    arguments.refuse(path_specs, "goes with --path FILE");
    return {};
  }
  path_format(std::string(*arguments.value("--path")));
  PathFileOptions options;
  if (const auto every = arguments.value("--every")) {
    const bool is_time = !number_in(*every);
    (is_time ? options.every_s : options.every) =
        is_time ? duration_value("--every", *every) : positive_value("--every", *every);
  }
  options.frame = arguments.value("--frame").value_or("map");
  TravelLimits limits;
  const auto speed = given_value(arguments, "--speed", positive_value);
  if (speed) limits.speed = *speed;
  const auto set = [&](double& limit, std::string_view option) {
    if (const auto given = given_value(arguments, option, positive_value)) limit = *given;
    if (arguments.has(option) && !speed) throw UsageError(fmt::format("{}: goes with --speed", option));
  };
  set(limits.acceleration, "--acceleration");
  set(limits.lateral_acceleration, "--lateral-acceleration");
  limits.joint_speed = given_value(arguments, "--joint-speed", joint_values).value_or(std::vector<double>{});
  limits.joint_acceleration =
      given_value(arguments, "--joint-acceleration", joint_values).value_or(std::vector<double>{});
  if (!limits.joint_acceleration.empty() && limits.joint_speed.empty()) {
    throw UsageError("--joint-acceleration: goes with --joint-speed");
  }
  if (speed && !limits.joint_speed.empty()) throw UsageError("--speed: an arm has --joint-speed, other bodies --speed");
  if (speed || !limits.joint_speed.empty()) options.limits = limits;
  return options;
}

}  // namespace warren::tools
