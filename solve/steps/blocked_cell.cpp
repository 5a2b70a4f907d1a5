// SPDX-License-Identifier: BSD-3-Clause
#include "solve/steps/blocked_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/plane/geometry.hpp"
#include "solve/steps/settled_ends.hpp"

namespace warren {
namespace {

/// The nearest place of the nearest cell, of the lines from 1 to `count`, with a hundredth of the room to spare.
double free_beside(double x, std::uint32_t count, double reach) {
  constexpr double digits = 1000.0;
  const double middle = std::clamp(std::round(x), 1.0, static_cast<double>(count));
  const double room = std::max(0.0, std::floor(0.99 * (0.5 - reach) * digits));
  if (std::abs(x - middle) * digits <= room) return x;
  return (middle * digits + std::copysign(room, x - middle)) / digits;
}

}  // namespace

void explain_blocked_cell(const WallProblem& problem, MazeHint maze, Answer& answer, const MetAt& met_at) {
  if (!is_blocked(answer.outcome)) return;
  const bool is_start = answer.outcome == Outcome::start_blocked;
  const Vec2 at = is_start ? problem.start : problem.goal;
  const auto met = met_at(at);
  if (!met) return;
  const Vec2 place{free_beside(at.x, maze.cols, problem.reach()), free_beside(at.y, maze.rows, problem.reach())};
  const bool is_outside = met->obstacle.starts_with("box: ");
  answer.blocked = BlockedEnd{.is_start = is_start,
                              .by = is_outside ? "outside of the bounds " + met->obstacle.substr(5) : met->obstacle,
                              .room = met->distance,
                              .needed = problem.reach()};
  if (!met_at(place)) {
    answer.blocked->free_place = {place.x, place.y};
    answer.blocked->distance = norm(place - at);
  }
  if (is_outside) {
    if (!met_at({at.y, at.x})) answer.blocked->hint = fmt::format("x comes before y: {},{} is free", at.y, at.x);
  } else if (met->distance >= problem.reach()) {
    answer.blocked->hint = touching_hint;
  } else if (const double depth = problem.robot.radius - met->distance; depth > 0.0) {
    answer.blocked->depth = depth;
  }
}

}  // namespace warren
