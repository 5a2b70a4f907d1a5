// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/question_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
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
  for (const std::string& text : arguments.values("--areas")) {
    const auto [file, numbers] = file_and_numbers("--areas", text, 1);
    if (numbers.empty()) throw UsageError(fmt::format("--areas: expected FILE,F (found: '{}')", text));
    prices.masks.push_back({.file = file, .factor = factor_value("--areas", numbers[0])});
  }
  for (const std::string& text : arguments.values("--speed-zones")) {
    const auto [file, numbers] = file_and_numbers("--speed-zones", text, 2);
    PriceMask mask{.kind = MaskKind::speed, .file = file};
    constexpr double most = 1e6;
    if (!numbers.empty()) mask.base = number_value("--speed-zones", numbers[0], -most, most);
    if (!numbers.empty()) mask.multiplier = number_value("--speed-zones", numbers[1], -most, most);
    prices.masks.push_back(mask);
  }
  for (const std::string& text : arguments.values("--keep-out")) {
    const auto [file, numbers] = file_and_numbers("--keep-out", text, 1);
    PriceMask mask{.kind = MaskKind::keep_out, .file = file};
    if (!numbers.empty()) mask.factor = factor_value("--keep-out", numbers[0]);
    prices.masks.push_back(mask);
  }
  const auto unknown = arguments.value("--unknown");
  if (unknown && *unknown != "blocked") prices.unknown = factor_value("--unknown", *unknown);
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

}  // namespace warren::tools
