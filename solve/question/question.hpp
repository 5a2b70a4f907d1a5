// SPDX-License-Identifier: BSD-3-Clause
// The question that is asked of a world: which body, from where to where, with how much room; and the problem that it
// makes with what the world's file says and the documented defaults.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {

/// Is it a number that coordinates may have: finite, of at most 1e60?
inline bool is_coordinate(double x) { return std::abs(x) <= largest_coordinate; }

/// What reaching the goal means. Points and discs; nothing said: to be at the goal.
struct GoalRule {
  std::vector<std::vector<double>> others = {};  ///< goals beside `goal`: the cheapest to reach is taken
  std::optional<double> tolerance = {};  ///< a goal that can't be reached: the nearest place to it that can, so far off
                                         ///< at most, >= 0 or infinite
  std::optional<double> region = {};     ///< any place so near to the goal, the cheapest; >= 0
  /// Of bodies that turn: the heading in the tolerance or region may be off by so much; none: not at all. 0 .. pi
  std::optional<double> heading_rad = {};
  std::vector<std::vector<double>> visit = {};  ///< places on the way, in the cheapest order
  bool back = false;                            ///< the path ends where it started

  /// Is anything said?
  bool empty() const { return others.empty() && !tolerance && !region && visit.empty() && !back; }
  /// All goals, the first first.
  std::vector<std::vector<double>> goals(const std::vector<double>& first) const {
    std::vector<std::vector<double>> all{first};
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }
};

/// Which of the ways is taken, and which others are told. Nothing said: one of the cheapest, alone.
struct RouteRule {
  std::optional<std::uint32_t> alternatives =
      {};                              ///< cheapest homotopy classes, 1 .. most_alternatives; of each a path
  std::optional<double> hole = {};     ///< obstacles so far across make classes, >= 0; none: the body's length; 0: all
  std::optional<double> stretch = {};  ///< alternatives cost so many times the best at most, >= 1; none: 1.5
  std::vector<std::vector<double>> keep_to = {};  ///< states of an older path, whose rest is kept where it is free
  std::vector<std::string> joints = {};           ///< of an arm: whose numbers those are; empty: not told
  std::optional<double> unless_gain = {};  ///< unless a new path costs less by this share of the rest's cost, 0 .. 1;
                                           ///< none: 0.05

  /// Is anything said?
  bool empty() const { return !alternatives && !hole && !stretch && keep_to.empty() && !unless_gain; }
};
/// More classes are not searched.
inline constexpr std::uint32_t most_alternatives = 64;

/// What is asked of a world: what is not said here is as the world's file says, and else as documented. A state is X, Y
/// of a point or disc; X, Y, THETA (radians) of a body that turns, whose goal may lack THETA: any heading; a number a
/// joint of an arm (radians, of joints that slide a length), whose goal may be three coordinates: a place of its tool.
struct Question {
  std::optional<RobotSpec> robot = {};  ///< none: the file's, else a point
  std::vector<double> start = {};       ///< empty: the file's
  std::vector<double> goal = {};        ///< empty: the file's
  std::optional<double> clearance =
      {};  ///< room around the body, 0 .. 1e60; none: the file's, else 0.1 in mazes, else 0
  std::optional<Contact> contact = {};  ///< may the path touch obstacles? none: where the planner's paths may
  std::optional<Eigen::Isometry3d> goal_pose = {};  ///< of an arm's tool, instead of `goal`; none: the file's
  Prices prices = {};                               ///< beside the file's; of two words for one thing this one counts
  GoalRule rule = {};                               ///< what reaching the goal means
  RouteRule route = {};                             ///< which of the ways

  /// Throws UsageError for values that no problem can have.
  void validate() const;
};

/// Any body among anything.
struct Problem {
  RobotSpec robot;                                  ///< what moves
  std::vector<double> start;                        ///< 2 or 3 numbers, of an arm one a joint
  std::vector<double> goal;                         ///< a turning body's may have 2: any heading
  double clearance = 0.0;                           ///< around the body; finite, >= 0
  Contact contact = Contact::blocked;               ///< may the path touch obstacles?
  std::optional<Eigen::Isometry3d> goal_pose = {};  ///< of an arm's tool; then there is no `goal`
  Prices prices = {};                               ///< the file's and the question's
  GoalRule rule = {};                               ///< as asked
  std::vector<std::string> told = {};         ///< what became of the question, a line each: ends moved onto limits
  std::vector<std::vector<double>> via = {};  ///< way-points, in their order

  /// The question that says all of it.
  Question question() const { return {robot, start, goal, clearance, contact, goal_pose, prices, rule}; }
};

/// A point or disc among walls and polygons.
struct WallProblem {
  RobotSpec robot;                     ///< point or disc
  Vec2 start;                          ///< of the reference point
  Vec2 goal;                           ///< of the reference point
  double clearance = 0.0;              ///< around the body; finite, >= 0
  Contact contact = Contact::blocked;  ///< may the path touch obstacles?
  Prices prices = {};                  ///< the file's and the question's
  GoalRule rule = {};                  ///< as asked

  /// Distance that the reference point keeps from every wall.
  double reach() const { return clearance + robot.radius; }
  /// The same as a problem of any body.
  Problem general() const {
    return {robot, {start.x, start.y}, {goal.x, goal.y}, clearance, contact, {}, prices, rule};
  }
};

/// A point or disc: of headings it knows nothing.
inline bool is_round(const RobotSpec& robot) { return robot.kind == RobotKind::point || robot.kind == RobotKind::disc; }

/// The body that is asked about: the options', else the file's, else a point.
RobotSpec robot_of(const Scene& scene, const Question& options);
/// Room around the body: the options', else the file's, else 0.1 in mazes, else 0.
double clearance_of(const Scene& scene, const Question& options);

/// Of a disc its diameter, of an outline the least distance of two parallel lines that hold it, of a point 0.
double least_width(const RobotSpec& robot);

/// The file's prices and the question's: areas, masks and forbidden areas of both, else the question's word; the reach
/// of a price of clearance is the body's least width where nobody says it. Throws UsageError for a point without one.
Prices prices_of(const Scene& scene, const Question& question);

/// Adds what is asked to what is there: areas, masks and forbidden areas of both; of other words what is asked counts.
void add_prices(Prices& prices, const Prices& asked);

/// The question's rule; the file's other goals where the question says no goal.
GoalRule rule_of(const Scene& scene, const Question& question);

/// The problem's goal is the one that is reached: of several, the number of which is told, the first takes its place.
void take_goal(Problem& problem, std::vector<double> reached, const std::optional<std::uint64_t>& number);

/// Where a path ends, of the goals that were asked for.
struct PathEnd {
  std::size_t number;  ///< of the goal
  double distance;     ///< to that one, of the reference point; 0: there
};

/// Of the plane, and so are tolerance and region; an arm's goals are of as many joints. None: the path ends at no goal,
/// nor so near to one as a tolerance or region takes.
std::optional<PathEnd> reached_goal(std::span<const double> end, const std::vector<std::vector<double>>& goals,
                                    const GoalRule& rule);

/// Throws UsageError where the scene's start or goal has a heading and nobody names a robot: it is no point's.
void check_headings(const Scene& scene, const Question& question);

/// The problem of a point or disc. A heading in the file (of a body that was overridden) means nothing to them. Throws
/// UsageError where start or goal are missing or have the wrong size, where contact contradicts the clearance, and
/// where the body is another. The goal of who comes back, and of visits without one, is the start. `usual` is the
/// contact that nobody asked for.
WallProblem wall_problem(const Scene& scene, const Question& options, Contact usual = Contact::blocked);

/// wall_problem for a planner that keeps off the obstacles, as `how` says; throws UsageError where the path is to be
/// allowed to touch them.
WallProblem keeping_off(const Scene& scene, const Question& question, std::string_view how);

/// X,Y or X,Y,THETA: what was given, else the file's. Throws UsageError where there is none, or of another size.
std::vector<double> state_or_heading(std::string_view option, const std::vector<double>& given,
                                     const std::vector<double>& in_file);

/// Throws UsageError where X,Y,THETA has a heading beyond largest_heading; other states have none.
void check_heading(std::string_view option, const std::vector<double>& state);

/// Reads what robot_text() writes; throws InputError for others, naming `where`.
RobotSpec robot_value(const std::string& where, std::string_view text);

/// Where a state stands in the plane; none where there is no state.
std::optional<Vec2> plane_point(const std::vector<double>& state);

// Which worlds a body can be planned and judged in at all. All verbs ask here, so that they refuse alike.

/// Arms plan among solids or in free space; all others among walls, polygons, bounds or on a map; nobody
/// where both are mixed, and no body of the plane where nothing confines it. Throws UsageError, saying what would do.
void check_plannable(const Scene& scene, const Question& problem);

}  // namespace warren
