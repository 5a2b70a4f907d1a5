// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/path_view.hpp"

#include <algorithm>
#include <cmath>

#include "solve/paths/path_legs.hpp"

namespace warren {
namespace {

constexpr std::size_t points_a_poll = std::size_t{1} << 16U;

}  // namespace

Path<Vec2> curve_of(const Answer& answer, const Execution& execution) {
  if (answer.states.empty() || answer.problem.robot.kind != RobotKind::car) return answer.path;
  constexpr double most_turn_rad = 0.0873;
  const PathLegs legs(answer);
  Path<Vec2> curve{answer.path.front()};
  for (std::size_t leg = 0; leg < legs.leg_count(); ++leg) {
    if (leg % points_a_poll == 0) execution.check();
    const double parts = std::clamp(std::ceil(legs.length(leg) / (most_turn_rad * legs.radius(leg))), 1.0, 1000.0);
    for (double k = 1.0; k <= parts; k += 1.0) {
      const PathState state = legs.at(leg, k / parts);
      curve.push_back({state.numbers[0], state.numbers[1]});
    }
  }
  return curve;
}

std::vector<std::vector<Vec2>> seen_of(const Path<Vec2>& path, const PathView& view, const Execution& execution) {
  std::vector<std::vector<Vec2>> chains;
  if (path.size() == 1 && view.box.contains(path.front())) chains.push_back({path.front()});
  bool is_open = false;  // does the last chain go on?
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (i % points_a_poll == 0) execution.check();
    const bool is_seen = box_of({path[i], path[i + 1]}).meets(view.box);
    const bool is_last = i + 2 == path.size();
    if (is_seen && !is_open) chains.push_back({path[i]});
    if (is_open && !is_seen && chains.back().back() != path[i]) chains.back().push_back(path[i]);
    is_open = is_seen;
    if (!is_seen) continue;
    const bool is_far = distance(chains.back().back(), path[i + 1]) >= view.pixel;
    if (is_far || is_last || chains.back().size() == 1) chains.back().push_back(path[i + 1]);
  }
  return chains;
}

}  // namespace warren
