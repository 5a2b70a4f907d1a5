// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/plane/obstacles_at_fixed_angle.hpp"

#include <vector>

#include "core/base/error.hpp"
#include "core/plane/convex_polygons.hpp"
#include "core/plane/se2.hpp"
#include "scenes/scene/plane_obstacles.hpp"

namespace warren {
namespace {

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

PlaneObstacles translation_obstacles(const Scene& scene, std::span<const Vec2> outline, double theta, double room,
                                     std::size_t disc_corners, const Execution& execution) {
  check_body(outline, "robot", {});
  check_polygons(scene, execution);
  const std::vector<std::vector<Vec2>> body = mirrored_pieces(outline, theta, room, disc_corners);
  PlaneObstacles obstacles;
  const auto add_sums = [&](std::span<const Vec2> piece) {
    for (const std::vector<Vec2>& mirrored : body) obstacles.polygons.add(minkowski_sum(piece, mirrored));
  };
  for (const ScenePolygon& polygon : scene.polygons) {
    execution.check();
    for (const std::vector<Vec2>& piece : convex_pieces(polygon.corners)) add_sums(piece);
  }
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    execution.poll(i);
    const Segment wall = scene.walls.segment(i);
    const std::vector<Vec2> ends = wall.a == wall.b ? std::vector{wall.a} : std::vector{wall.a, wall.b};
    add_sums(ends);
  }
  obstacles.bounds = scene.bounds ? shrunk(*scene.bounds, body) : obstacle_box(scene);
  return obstacles;
}

}  // namespace warren
