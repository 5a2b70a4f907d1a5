// SPDX-License-Identifier: BSD-3-Clause
// The question that is asked of a world of walls: which body, from where to where, with how much room. Options come
// first, then (for `verify`) what the answer says, then the world file, then the documented defaults.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"
#include "tools/arguments.hpp"
#include "tools/command.hpp"
#include "worlds/scene.hpp"
#include "worlds/verify.hpp"

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

/// A point or disc among walls.
struct WallProblem {
  RobotSpec robot;  ///< point or disc
  Vec2 start;
  Vec2 goal;
  double clearance = 0.0;  ///< around the body; finite, >= 0
  Contact contact = Contact::blocked;

  /// Distance that the reference point keeps from every wall.
  double reach() const { return clearance + robot.radius; }
};

/// Throws UsageError where start or goal are missing or have the wrong size, where contact contradicts the clearance,
/// and where the world or the body needs a planner that this version does not have.
WallProblem wall_problem(const Scene& scene, const ProblemOptions& options);

/// "point", "disc 0.2": as the scene format writes it.
std::string robot_text(const RobotSpec& robot);
/// Reads what robot_text writes; throws UsageError for others, naming `where`.
RobotSpec robot_value(std::string_view where, std::string_view text);

constexpr std::string_view name_of(Contact contact) { return contact == Contact::allowed ? "allowed" : "blocked"; }

}  // namespace warren
