// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/straight_runs.hpp"

#include <algorithm>

namespace warren {
namespace {

constexpr double most_turn_rad = 3.0;  // so that the run's turn is the shorter way between its ends, too

/// All poses from first to last in one direction, and how far each of them is from the line.
bool is_straight(std::span<const Se2> poses, double bend) {
  const Vec2 way = poses.back().position() - poses.front().position();
  const double length_sq = dot(way, way);
  const double most_cross = bend * std::sqrt(length_sq);
  return std::all_of(poses.begin(), poses.end(), [&](const Se2& pose) {
    const Vec2 p = pose.position() - poses.front().position();
    const double along = dot(way, p);
    const bool on_the_way = length_sq > 0.0 ? along >= 0.0 && along <= length_sq : p == Vec2{};
    return pose.theta == poses.front().theta && on_the_way && std::abs(cross(way, p)) <= most_cross;
  });
}

bool turns_on_the_spot(std::span<const Se2> poses) {
  double sum = 0.0;
  const bool left = shorter_turn(poses[0].theta, poses[1].theta) > 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double turn = shorter_turn(poses[i - 1].theta, poses[i].theta);
    sum += turn;
    if (!(poses[i].position() == poses[0].position()) || (turn > 0.0) != left) return false;
  }
  return std::abs(sum) < most_turn_rad;
}

}  // namespace

double shorter_turn(double a, double b) {
  constexpr double full_turn = 2.0 * std::numbers::pi;
  double turn = b - a;
  turn -= full_turn * std::floor(turn / full_turn + 0.5);
  return turn;
}

bool is_there(const Se2& pose, const Se2& wanted, bool any_heading, double tolerance) {
  if (portable::hypot(pose.x - wanted.x, pose.y - wanted.y) > tolerance) return false;
  return any_heading || std::abs(shorter_turn(pose.theta, wanted.theta)) <= tolerance;
}

Leg leg_of(std::span<const Se2> path, const PoseRun& run) {
  const Se2& a = path[run.first];
  const Se2& b = path[run.last];
  return {a, b.position() - a.position(), shorter_turn(a.theta, b.theta)};
}

std::vector<PoseRun> pose_runs(std::span<const Se2> path, double bend, const Execution& execution) {
  constexpr std::size_t most_legs = 1024;
  constexpr std::size_t runs_a_poll = 1024;
  if (path.size() == 1) return {PoseRun{0, 0}};
  std::vector<PoseRun> runs;
  for (std::size_t first = 0; first + 1 < path.size();) {
    if (runs.size() % runs_a_poll == 0) execution.reserve(runs_a_poll * sizeof(PoseRun));  // and polls
    std::size_t legs = 1;
    while (2 * legs <= most_legs && first + 2 * legs < path.size()) {
      const std::span<const Se2> poses = path.subspan(first, 2 * legs + 1);
      if (!is_straight(poses, bend) && !turns_on_the_spot(poses)) break;
      legs *= 2;
    }
    runs.push_back({first, first + legs});
    first += legs;
  }
  return runs;
}

}  // namespace warren
