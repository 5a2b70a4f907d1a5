// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/ends_on_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "worlds/rasters/map_borders.hpp"

namespace warren {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr std::int64_t widest_join = 4;  // cells to each side

double heading_step(const HeadingLayers& layers) { return full_turn / layers.angles; }

std::uint32_t wrapped(std::int64_t k, std::uint32_t angles) {
  const std::int64_t n = angles;
  return static_cast<std::uint32_t>((k % n + n) % n);
}

/// The whole number that this is, but for rounding.
std::optional<std::int64_t> whole(double x) {
  constexpr double rounding = 1e-9;
  constexpr double largest = 9e15;
  const double nearest = std::round(x);
  if (!(std::abs(x) < largest) || std::abs(x - nearest) > rounding) return std::nullopt;
  return static_cast<std::int64_t>(nearest);
}

/// Numbers below and above x, `reach` of each.
struct Around {
  std::int64_t first;
  std::int64_t last;
  Around(double x, std::int64_t reach)
      : first(static_cast<std::int64_t>(std::floor(x)) - reach + 1), last(first + 2 * reach - 1) {}
};

/// The headings to which an end may be joined.
std::vector<std::uint32_t> headings_around(const HeadingLayers& layers, const LatticeEnd& end) {
  std::vector<std::uint32_t> headings;
  constexpr std::uint32_t all = 4;
  if (end.any_heading || layers.angles <= all) {
    for (std::uint32_t k = 0; k < layers.angles; ++k) headings.push_back(k);
    return headings;
  }
  const Around around(end.pose.theta / heading_step(layers), 2);
  for (std::int64_t k = around.first; k <= around.last; ++k) headings.push_back(wrapped(k, layers.angles));
  return headings;
}

/// The cells around a pose that a body can reach on its way to the lattice, in the lattice's coordinates.
OccupancyMap cut_out(const OccupancyMap& map, const Se2& pose, double reach) {
  const double room = std::min(std::ceil(reach / map.cell) + widest_join + 2, 4294967295.0);
  const auto clamped = [](double x, std::uint32_t end) {
    return static_cast<std::uint32_t>(std::clamp(x, 0.0, static_cast<double>(end)));
  };
  const std::uint32_t left = clamped(std::floor(pose.x / map.cell) - room, map.width() - 1);
  const std::uint32_t low = clamped(std::floor(pose.y / map.cell) - room, map.height() - 1);
  const std::uint32_t right = clamped(std::floor(pose.x / map.cell) + room + 1, map.width());
  const std::uint32_t high = clamped(std::floor(pose.y / map.cell) + room + 1, map.height());
  OccupancyMap cut;
  cut.cell = map.cell;
  cut.origin = {left * map.cell, low * map.cell};
  cut.blocked = Bitmap(std::max(right, left + 1) - left, std::max(high, low + 1) - low);
  for (std::uint32_t y = 0; y < cut.height(); ++y) {
    for (std::uint32_t x = 0; x < cut.width(); ++x) {
      if (map.blocked.test(left + x, low + y)) cut.blocked.set(x, y);
    }
  }
  return cut;
}

/// Around an end of a body that turns.
Se2World turning_world(const Scene& scene, const Problem& problem, const Se2& pose, const Execution& execution) {
  const Se2Options options{.clearance = problem.clearance};
  if (!scene.map) return {scene, problem.robot.outline, options, execution};
  double reach = problem.clearance;
  for (const Vec2 p : problem.robot.outline) reach = std::max(reach, problem.clearance + norm(p));
  Scene around;
  around.map = cut_out(*scene.map, pose, reach);
  add_map_walls(around, execution);
  return {around, problem.robot.outline, options, execution};
}

}  // namespace

LatticeFrame::LatticeFrame(const Scene& scene) {
  if (!scene.map) return;
  origin_ = scene.map->origin;
  yaw_rad_ = scene.map->yaw_rad;
  is_moved_ = !(origin_ == Vec2{}) || yaw_rad_ != 0.0;
}

Se2 LatticeFrame::in_world(const Se2& pose) const {
  if (!is_moved_) return pose;
  const Vec2 p = origin_ + Rotation(yaw_rad_)(pose.position());
  return {p.x, p.y, pose.theta + yaw_rad_};
}

Se2 LatticeFrame::in_lattice(const Se2& pose) const {
  if (!is_moved_) return pose;
  const Vec2 p = Rotation(-yaw_rad_)(pose.position() - origin_);
  return {p.x, p.y, pose.theta - yaw_rad_};
}

Se2 pose_of(const HeadingLayers& layers, const LayerState& state) {
  return {layers.origin.x + layers.cell * state.i, layers.origin.y + layers.cell * state.j,
          full_turn * state.k / layers.angles};
}

std::vector<LayerEnd> states_at(const HeadingLayers& layers, const LatticeEnd& end) {
  const auto i = whole((end.pose.x - layers.origin.x) / layers.cell);
  const auto j = whole((end.pose.y - layers.origin.y) / layers.cell);
  if (!i || !j || *i < 0 || *j < 0 || *i >= layers.width || *j >= layers.height) return {};
  const auto state = [&](std::uint32_t k) {
    return LayerEnd{{static_cast<std::uint32_t>(*i), static_cast<std::uint32_t>(*j), k}};
  };
  std::vector<LayerEnd> states;
  if (end.any_heading || layers.angles == 1) {
    for (std::uint32_t k = 0; k < layers.angles; ++k) states.push_back(state(k));
  } else if (const auto k = whole(end.pose.theta / heading_step(layers))) {
    states.push_back(state(wrapped(*k, layers.angles)));
  }
  return states;
}

EndWorld::EndWorld(const Scene& scene, const Problem& problem, const HeadingLayers& layers, const LatticeEnd& end,
                   const Execution& execution)
    : layers_(layers), end_(end), execution_(execution) {
  const double radius = problem.robot.radius + problem.clearance;
  if (problem.robot.kind == RobotKind::polygon) {
    world_.emplace<Se2World>(turning_world(scene, problem, end.pose, execution));
  } else if (scene.polygons.empty()) {
    world_.emplace<MazeWorld>(scene, radius, execution);
  } else {
    world_.emplace<PolygonWorld>(scene, radius, execution);
  }
}

std::vector<LayerEnd> EndWorld::joined(const LayerSearchOptions& costs) const {
  constexpr std::int64_t usual_join = 2;
  std::vector<LayerEnd> ends = joined_within(usual_join, costs);
  return ends.empty() ? joined_within(widest_join, costs) : ends;
}

std::vector<LayerEnd> EndWorld::joined_within(std::int64_t reach, const LayerSearchOptions& costs) const {
  const Around columns((end_.pose.x - layers_.origin.x) / layers_.cell, reach);
  const Around rows((end_.pose.y - layers_.origin.y) / layers_.cell, reach);
  const std::vector<std::uint32_t> headings = headings_around(layers_, end_);
  std::vector<LayerEnd> ends;
  for (std::int64_t j = std::max<std::int64_t>(rows.first, 0);
       j <= std::min<std::int64_t>(rows.last, layers_.height - 1); ++j) {
    for (std::int64_t i = std::max<std::int64_t>(columns.first, 0);
         i <= std::min<std::int64_t>(columns.last, layers_.width - 1); ++i) {
      execution_.check();
      for (const std::uint32_t k : headings) {
        const LayerState state{static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), k};
        if (!layers_.is_free(state.i, state.j, k)) continue;
        const Se2 to = pose_of(layers_, state);
        const Se2 from{end_.pose.x, end_.pose.y, end_.any_heading ? to.theta : end_.pose.theta};
        if (!is_free_motion(from, to)) continue;
        const double turn = layers_.angles > 1 ? std::abs(turn_between(from.theta, to.theta)) : 0.0;
        ends.push_back({state, costs.step_cost * distance(from.position(), to.position()) / layers_.cell +
                                   costs.turn_cost * turn / heading_step(layers_)});
      }
    }
  }
  return ends;
}

bool EndWorld::is_free_motion(const Se2& from, const Se2& to) const {
  const auto is_free = [&](const auto& world, const auto& a, const auto& b) {
    auto query = world.make_query();
    return world.is_free(a, query) && world.is_free_motion(a, b, query);
  };
  if (const auto* turning = std::get_if<Se2World>(&world_)) return is_free(*turning, from, to);
  if (const auto* walls = std::get_if<MazeWorld>(&world_)) return is_free(*walls, from.position(), to.position());
  if (const auto* plane = std::get_if<PolygonWorld>(&world_)) return is_free(*plane, from.position(), to.position());
  return false;
}

}  // namespace warren
