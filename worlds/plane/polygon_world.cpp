// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/plane/polygon_world.hpp"

#include <algorithm>
#include <vector>

#include "core/base/error.hpp"
#include "core/plane/convex_polygons.hpp"
#include "core/plane/se2.hpp"
#include "scenes/scene/plane_obstacles.hpp"

namespace warren {
namespace {

/// The sides of polygons and bounds, as further walls.
std::vector<Segment> all_sides(const PolygonIndex& polygons, const Scene& scene, const Execution& execution) {
  const std::size_t count = polygons.polygons().corners.size();
  execution.reserve(count * sizeof(Segment));
  std::vector<Segment> sides = bounds_walls(scene);
  sides.reserve(sides.size() + count);
  for (std::size_t i = 0; i < count; ++i) {
    execution.poll(i);
    sides.push_back(polygons.side(i));
  }
  return sides;
}

/// The body turned, mirrored at its reference point, in convex pieces, each grown by the room.
std::vector<std::vector<Vec2>> mirrored_pieces(std::span<const Vec2> outline, double theta, double room,
                                               std::size_t disc_corners) {
  const Rotation turned(theta);
  std::vector<Vec2> mirrored;
  for (const Vec2 p : outline) mirrored.push_back(Vec2{} - turned(p));
  const std::vector<Vec2> disc = polygon_around_disc(room, disc_corners);
  std::vector<std::vector<Vec2>> pieces = convex_pieces(mirrored);
  for (std::vector<Vec2>& piece : pieces) piece = minkowski_sum(piece, disc);
  return pieces;
}

/// Where the reference point may be so that the body, which is `mirrored`, is in the bounds.
Box shrunk(const Box& bounds, const std::vector<std::vector<Vec2>>& mirrored) {
  Box body;  // mirrored: its max is how far the body reaches down and left
  for (const auto& piece : mirrored) body.include(box_around(piece));
  const Box box{bounds.min + body.max, bounds.max + body.min};
  if (box.empty()) throw InputError("robot", "does not fit into the bounds at this angle");
  return box;
}

}  // namespace

PolygonWorld::PolygonWorld(const Scene& scene, double clearance, const Execution& execution)
    : clearance_(checked_clearance(clearance)),
      planning_clearance_(clearance * (1 + 1e-9)),
      polygons_(plane_obstacles(scene, execution).polygons, execution),
      sides_(scene.walls, all_sides(polygons_, scene, execution), execution) {
  box_ = scene.bounds ? *scene.bounds : sides_.box();
  if (box_.empty()) {
    throw InputError("world", "has neither polygons, walls nor bounds: nothing confines the robot");
  }
}

double PolygonWorld::suggested_samples(const Execution& execution) const {
  constexpr double least = 500.0;
  constexpr double samples_a_side = 8.0;
  const double width = typical_width(sides_, box_, &polygons_, execution);
  const double asked = samples_for_width(width, sampled_area(), clearance_);
  return std::clamp(asked, least, least + samples_a_side * static_cast<double>(sides_.wall_count()));
}

PlaneObstacles translation_obstacles(const Scene& scene, std::span<const Vec2> outline, double theta, double room,
                                     std::size_t disc_corners, const Execution& execution) {
  check_body(outline, "robot", {});
  check_polygons(scene, execution);
  const std::vector<std::vector<Vec2>> body = mirrored_pieces(outline, theta, room, disc_corners);
  PlaneObstacles obstacles;
  const auto add_sums = [&](std::span<const Vec2> piece) {
    execution.check();
    for (const std::vector<Vec2>& mirrored : body) {
      auto& [corners, first] = obstacles.polygons;
      const std::vector<Vec2> sum = minkowski_sum(piece, mirrored);
      const bool grows = corners.size() + sum.size() > corners.capacity() || first.size() == first.capacity();
      if (grows) execution.reserve(2 * (corners.capacity() * sizeof(Vec2) + first.capacity() * sizeof first[0]));
      obstacles.polygons.add(sum);
    }
  };
  for (const ScenePolygon& polygon : scene.polygons) {
    for (const std::vector<Vec2>& piece : convex_pieces(polygon.corners)) add_sums(piece);
  }
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Segment wall = scene.walls.segment(i);
    const std::vector<Vec2> ends = wall.a == wall.b ? std::vector{wall.a} : std::vector{wall.a, wall.b};
    add_sums(ends);
  }
  obstacles.bounds = scene.bounds ? shrunk(*scene.bounds, body) : obstacle_box(scene);
  return obstacles;
}

}  // namespace warren
