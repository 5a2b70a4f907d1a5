// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/heading_layer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "pictures/layers/draw_bodies.hpp"
#include "pictures/layers/draw_cells.hpp"
#include "worlds/rasters/heading_layers_of_map.hpp"
#include "worlds/rasters/heading_layers_of_scene.hpp"

namespace warren {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// From cells into the world.
std::function<Vec2(Vec2)> placed(const HeadingCells& heading) {
  return [&heading, turned = Rotation(heading.yaw_rad)](Vec2 p) { return heading.origin + turned(heading.cell * p); };
}

std::vector<Vec2> turned_outline(const RobotSpec& robot, double heading_rad) {
  const Rotation turned(heading_rad);
  std::vector<Vec2> outline;
  for (const Vec2 p : robot.outline) outline.push_back(turned(p));
  return outline;
}

/// As far as the reference point may be while some of the body is in the bounds, or at the obstacles.
LayerOptions one_layer(const Scene& scene, const RobotSpec& robot, double clearance, const Execution& execution) {
  constexpr double cells = 400.0;
  constexpr double most_cells = 20'000.0;
  constexpr double least_cells = 16.0;
  double reach = clearance;
  for (const Vec2 p : robot.outline) reach = std::max(reach, clearance + norm(p));
  LayerOptions options;
  options.clearance = clearance;
  const Box inner = scene.bounds ? *scene.bounds : obstacle_box(scene, execution);
  if (inner.empty()) return options;
  const Box box = inner.grown(reach);
  options.region = box;
  const double longer = std::max(box.width(), box.height());
  const double shorter = std::min(box.width(), box.height());
  options.grid.cell = std::min(longer / cells, std::max(shorter / least_cells, longer / most_cells));
  return options;
}

/// "heading of a state", or which share of them is drawn.
std::string label_of(std::string what, std::size_t drawn, std::size_t count) {
  return drawn < count ? fmt::format("{} ({} of {})", what, drawn, count) : std::move(what);
}

PictureLayer arrows_of(const std::vector<Se2>& states, std::string id, const std::string& label, double length) {
  constexpr std::size_t most_arrows = 2000;
  const std::size_t apart = (states.size() + most_arrows - 1) / most_arrows;
  std::vector<Se2> drawn;
  for (std::size_t i = 0; i < states.size(); i += apart) drawn.push_back(states[i]);
  PictureLayer layer = heading_arrows(drawn, length);
  layer.id = std::move(id);
  layer.label = label_of(label, drawn.size(), states.size());
  layer.over_roadmap = true;
  return layer;
}

}  // namespace

void check_has_headings(const RobotSpec& robot) {
  if (!robot.outline.empty()) return;
  const char* why = robot.kind == RobotKind::car                                      ? "a round car takes"
                    : robot.kind == RobotKind::point || robot.kind == RobotKind::disc ? "a point and a disc take"
                                                                                      : nullptr;
  if (why == nullptr) throw UsageError("@heading: an arm has joints, and no heading");
  throw UsageError(
      fmt::format("@heading: {} the same room at any heading; it is for polygons and cars with an outline", why));
}

HeadingCells heading_cells(const Scene& scene, const RobotSpec& robot, double clearance, double heading_rad,
                           const Execution& execution) {
  check_has_headings(robot);
  HeadingCells cells;
  cells.yaw_rad = scene.map ? scene.map->yaw_rad : 0.0;
  const double seen_rad = heading_rad - cells.yaw_rad;
  cells.heading_degrees = seen_rad / degree;
  RobotSpec standing{.kind = RobotKind::polygon, .outline = turned_outline(robot, seen_rad)};
  HeadingLayers layers =
      scene.map ? map_layers(*scene.map, standing.outline, 1, clearance, execution)
                : orientation_layers(scene, standing, one_layer(scene, standing, clearance, execution), execution);
  cells.cell = layers.cell;
  const Vec2 corner = layers.origin - 0.5 * layers.cell * Vec2{1.0, 1.0};
  cells.origin = scene.map ? world_point(*scene.map, {0.0, 0.0}) : corner;
  cells.blocked = std::move(layers.bitmaps[layers.standing.front()]);
  return cells;
}

PictureLayer blocked_at_heading(const HeadingCells& heading, const Execution& execution) {
  const double degrees = heading.heading_degrees + heading.yaw_rad / degree;
  PictureLayer layer =
      cells_layer(fmt::format("layer_{:.0f}", degrees), fmt::format("no room at {:.4g} degrees", degrees),
                  heading.blocked, placed(heading), execution);
  layer.fill = colors::no_room;
  layer.blocks = false;
  return layer;
}

PictureLayer arrows_among(const HeadingCells& heading, const Execution& execution) {
  constexpr std::uint32_t most_a_side = 24;
  const std::uint32_t apart = std::max(heading.blocked.width(), heading.blocked.height()) / most_a_side + 1;
  const auto at = placed(heading);
  std::vector<Se2> poses;
  for (std::uint32_t y = apart / 2; y < heading.blocked.height(); y += apart) {
    execution.check();
    for (std::uint32_t x = apart / 2; x < heading.blocked.width(); x += apart) {
      if (heading.blocked.test(x, y)) continue;
      const Vec2 p = at({x + 0.5, y + 0.5});
      poses.push_back({p.x, p.y, heading.yaw_rad + heading.heading_degrees * degree});
    }
  }
  return heading_arrows(poses, 0.6 * apart * heading.cell);
}

std::vector<PictureLayer> state_arrows(std::span<const Se2> states, double heading_rad) {
  constexpr double near_rad = 10.0 * degree;
  std::vector<Se2> near;
  std::vector<Se2> others;
  Box box;
  for (const Se2& state : states) {
    (std::abs(turn_between(heading_rad, state.theta)) <= near_rad ? near : others).push_back(state);
    box.include(state.position());
  }
  if (states.empty()) return {};
  const double extent = std::max(box.width(), box.height());
  const double length =
      std::clamp(extent / std::sqrt(static_cast<double>(states.size())), extent / 60.0, extent / 25.0);
  std::vector<PictureLayer> layers{
      arrows_of(others, "other_headings", "state, turned as its arrow", length),
      arrows_of(near, "near_headings", fmt::format("state turned by {:.4g} ± 10 degrees", heading_rad / degree),
                1.3 * length)};
  layers[1].color = colors::wall;
  layers[1].width = 1.6 * widths::edge;
  return layers;
}

}  // namespace warren
