// SPDX-License-Identifier: BSD-3-Clause
// The question that is asked of a world: which body, from where to where, with how much room. Options come
// first, then (for `verify`) what the answer says, then the world file, then the documented defaults.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"
#include "scenes/scene/scene.hpp"
#include "tools/words/arguments.hpp"
#include "tools/words/command.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {

/// --robot --start --goal --clearance --contact
std::span<const OptionSpec> problem_option_specs();

/// What is said about the problem outside the world file; nothing where nothing is said.
struct ProblemOptions {
  std::optional<RobotSpec> robot;
  std::vector<double> start;
  std::vector<double> goal;
  std::optional<double> clearance;
  std::optional<Contact> contact;
};

/// Throws UsageError for values that no problem can have.
ProblemOptions problem_options(const Arguments& arguments);

/// Any body among anything.
struct Problem {
  RobotSpec robot;
  std::vector<double> start;  ///< 2, 3 or 6 numbers
  std::vector<double> goal;   ///< a turning body's may have 2: any heading
  double clearance = 0.0;     ///< around the body; finite, >= 0
  Contact contact = Contact::blocked;
};

/// A point or disc among walls and polygons.
struct WallProblem {
  RobotSpec robot;  ///< point or disc
  Vec2 start;
  Vec2 goal;
  double clearance = 0.0;  ///< around the body; finite, >= 0
  Contact contact = Contact::blocked;

  /// Distance that the reference point keeps from every wall.
  double reach() const { return clearance + robot.radius; }
  Problem general() const { return {robot, {start.x, start.y}, {goal.x, goal.y}, clearance, contact}; }
};

/// The body that is asked about: the options', else the file's, else a point.
RobotSpec robot_of(const Scene& scene, const ProblemOptions& options);
/// Room around the body: the options', else the file's, else 0.1 in mazes, else 0.
double clearance_of(const Scene& scene, const ProblemOptions& options);

/// The problem of a point or disc. A heading in the file (of a body that was overridden) means nothing to them. Throws
/// UsageError where start or goal are missing or have the wrong size, where contact contradicts the clearance, and
/// where the body is another. `usual` is the contact that nobody asked for.
WallProblem wall_problem(const Scene& scene, const ProblemOptions& options, Contact usual = Contact::blocked);

/// X,Y or X,Y,THETA: what was given, else the file's. Throws UsageError where there is none, or of another size.
std::vector<double> state_or_heading(std::string_view option, const std::vector<double>& given,
                                     const std::vector<double>& in_file);

/// Throws UsageError where X,Y,THETA has a heading beyond largest_heading; other states have none.
void check_heading(std::string_view option, const std::vector<double>& state);

/// "point", "disc 0.2", …: as the scene format writes it.
std::string robot_text(const RobotSpec& robot);
/// Reads what robot_text writes; throws InputError for others, naming `where`.
RobotSpec robot_value(const std::string& where, std::string_view text);

constexpr std::string_view kind_name(RobotKind kind) {
  constexpr std::string_view names[] = {"point", "disc", "polygon", "car", "puma560", "arm"};
  return names[static_cast<std::size_t>(kind)];
}
constexpr std::string_view name_of(Contact contact) { return contact == Contact::allowed ? "allowed" : "blocked"; }

}  // namespace warren
