// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/arm_world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"

namespace warren {

namespace {

const ArmModel& with_links(const ArmModel& model) {
  if (model.links.empty())
    throw InputError("arm", "none of its links has a solid; a URDF has them in <collision>", model.name);
  return model;
}

}  // namespace

std::vector<Solid> solids_of(const Scene& scene, const Execution& execution) {
  std::vector<Solid> solids;
  execution.reserve((scene.spheres.size() + scene.boxes.size() + scene.solids.size()) * sizeof(Solid));
  for (const Sphere& s : scene.spheres) {
    solids.push_back({SolidKind::sphere, Eigen::Isometry3d(Eigen::Translation3d(s.x, s.y, s.z)), {s.radius, 0.0, 0.0}});
  }
  for (const SolidBox& box : scene.boxes) {
    const Vec3 low(box.low[0], box.low[1], box.low[2]);
    const Vec3 high(box.high[0], box.high[1], box.high[2]);
    solids.push_back({SolidKind::box, Eigen::Isometry3d(Eigen::Translation3d(0.5 * (low + high))), 0.5 * (high - low)});
  }
  solids.insert(solids.end(), scene.solids.begin(), scene.solids.end());
  return solids;
}

ArmWorld::ArmWorld(const Scene& scene, const ArmModel& model, const ArmOptions& options, const Execution& execution)
    : kinematics_(with_links(model)),
      ways_(model.variables),
      resolution_(checked_length("resolution", options.resolution.value_or(1e-5 * kinematics_.reach()), false)),
      certificate_(model, solids_of(scene, execution), checked_clearance(options.clearance), resolution_, execution) {}

JointState ArmWorld::at_unit(const std::array<double, dimension>& u) const {
  JointState q{};
  for (std::size_t j = 0; j < ways_.size(); ++j) {
    const auto& [low, high] = std::pair(ways_[j].low, ways_[j].high);
    q[j] = kinematics_.moves(j) ? std::min(high, low + u[j] * (high - low)) : std::clamp(0.0, low, high);
  }
  return q;
}

bool ArmWorld::is_free(const State& a, Query&) const {
  return kinematics_.variable_outside_limits(a) == most_joints && certificate_.is_free(a);
}

double ArmWorld::distance(const State& a, const State& b) const {
  double sum = 0.0;
  for (std::size_t j = 0; j < ways_.size(); ++j) {
    const double way = variable_way(ways_[j], a[j], b[j]);
    sum += way * way;
  }
  return std::sqrt(sum);
}

JointState ArmWorld::interpolate(const State& a, const State& b, double t) const {
  if (t >= 1.0) return b;
  JointState q{};
  for (std::size_t j = 0; j < ways_.size(); ++j) {
    q[j] = a[j] + t * variable_way(ways_[j], a[j], b[j]);
    if (ways_[j].continuous && std::abs(q[j]) > std::numbers::pi) q[j] = std::remainder(q[j], 2.0 * std::numbers::pi);
  }
  return q;
}

ArmWorld::Embedding ArmWorld::embed(const State& a) const {
  Embedding point{};
  std::size_t next = 0;
  for (std::size_t j = 0; j < ways_.size(); ++j) {
    if (!ways_[j].continuous) {
      point[next++] = a[j];
      continue;
    }
    const std::size_t others = ways_.size() - j - 1;
    if (next + others + 2 > point.size()) continue;
    const auto [s, c] = portable::sin_and_cos(a[j]);
    point[next++] = s;
    point[next++] = c;
  }
  return point;
}

MotionVerdict ArmWorld::judge_motion(const State& a, const State& b) const {
  JointState way{};
  for (std::size_t j = 0; j < ways_.size(); ++j) way[j] = variable_way(ways_[j], a[j], b[j]);
  return certificate_.motion(a, way);
}

double ArmWorld::sampled_volume() const {
  double volume = 1.0;
  for (std::size_t j = 0; j < ways_.size(); ++j) {
    if (is_sampled(j)) volume *= ways_[j].high - ways_[j].low;
  }
  return volume;
}

std::size_t ArmWorld::sampled_dimension() const {
  std::size_t count = 0;
  for (std::size_t j = 0; j < ways_.size(); ++j) count += is_sampled(j) ? 1 : 0;
  return count;
}

Path<JointState> with_even_idle_joints(const ArmWorld& world, Path<JointState> path) {
  if (path.size() < 2) return path;
  const std::vector<ArmVariable>& variables = world.model().variables;
  const auto moves = [&](std::size_t j) { return world.kinematics().moves(j); };
  std::vector<double> along(path.size(), 0.0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < variables.size(); ++j) {
      const double way = variable_way(variables[j], path[i - 1][j], path[i][j]);
      if (moves(j)) sum += way * way;
    }
    along[i] = along[i - 1] + std::sqrt(sum);
  }
  const double whole = along.back();
  for (std::size_t i = 1; i + 1 < path.size() && whole > 0.0; ++i) {
    const JointState even = world.interpolate(path.front(), path.back(), along[i] / whole);
    for (std::size_t j = 0; j < variables.size(); ++j) {
      if (!moves(j)) path[i][j] = even[j];
    }
  }
  return path;
}

}  // namespace warren
