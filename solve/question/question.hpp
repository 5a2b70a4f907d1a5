// SPDX-License-Identifier: BSD-3-Clause
// The question that is asked of a world: which body, from where to where, with how much room; and the problem that it
// makes with what the world's file says and the documented defaults.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {

/// What is asked of a world: what is not said here is as the world's file says, and else as documented. A state is X, Y
/// of a point or disc; X, Y, THETA (radians) of a body that turns, whose goal may lack THETA: any heading; six joint
/// angles of an arm (radians), whose goal may be the three coordinates of a place of its tool.
struct Question {
  std::optional<RobotSpec> robot = {};  ///< none: the file's, else a point
  std::vector<double> start = {};       ///< empty: the file's
  std::vector<double> goal = {};        ///< empty: the file's
  std::optional<double> clearance =
      {};  ///< room around the body, 0 .. 1e60; none: the file's, else 0.1 in mazes, else 0
  std::optional<Contact> contact = {};  ///< may the path touch obstacles? none: where the planner's paths may
  std::optional<Eigen::Isometry3d> goal_pose = {};  ///< of an arm's tool, instead of `goal`; none: the file's

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

  /// The question that says all of it.
  Question question() const { return {robot, start, goal, clearance, contact, goal_pose}; }
};

/// A point or disc among walls and polygons.
struct WallProblem {
  RobotSpec robot;                     ///< point or disc
  Vec2 start;                          ///< of the reference point
  Vec2 goal;                           ///< of the reference point
  double clearance = 0.0;              ///< around the body; finite, >= 0
  Contact contact = Contact::blocked;  ///< may the path touch obstacles?

  /// Distance that the reference point keeps from every wall.
  double reach() const { return clearance + robot.radius; }
  /// The same as a problem of any body.
  Problem general() const { return {robot, {start.x, start.y}, {goal.x, goal.y}, clearance, contact}; }
};

/// The body that is asked about: the options', else the file's, else a point.
RobotSpec robot_of(const Scene& scene, const Question& options);
/// Room around the body: the options', else the file's, else 0.1 in mazes, else 0.
double clearance_of(const Scene& scene, const Question& options);

/// The problem of a point or disc. A heading in the file (of a body that was overridden) means nothing to them. Throws
/// UsageError where start or goal are missing or have the wrong size, where contact contradicts the clearance, and
/// where the body is another. `usual` is the contact that nobody asked for.
WallProblem wall_problem(const Scene& scene, const Question& options, Contact usual = Contact::blocked);

/// wall_problem for a planner that keeps off the obstacles, as `how` says; throws UsageError where the path is to be
/// allowed to touch them.
WallProblem keeping_off(const Scene& scene, const Question& question, std::string_view how);

/// X,Y or X,Y,THETA: what was given, else the file's. Throws UsageError where there is none, or of another size.
std::vector<double> state_or_heading(std::string_view option, const std::vector<double>& given,
                                     const std::vector<double>& in_file);

/// Throws UsageError where X,Y,THETA has a heading beyond largest_heading; other states have none.
void check_heading(std::string_view option, const std::vector<double>& state);

/// "point", "disc 0.2", …: as the scene format writes it.
std::string robot_text(const RobotSpec& robot);
/// Reads what robot_text writes; throws InputError for others, naming `where`.
RobotSpec robot_value(const std::string& where, std::string_view text);

/// Where a state stands in the plane; none where there is no state.
std::optional<Vec2> plane_point(const std::vector<double>& state);

// Which worlds a body can be planned and judged in at all. All verbs ask here, so that they refuse alike.

/// Arms plan among solids or in free space; all others among walls, polygons, bounds or on a map; nobody
/// where both are mixed, and no body of the plane where nothing confines it. Throws UsageError, saying what would do.
void check_plannable(const Scene& scene, const Question& problem);

}  // namespace warren
