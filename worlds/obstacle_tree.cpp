// SPDX-License-Identifier: BSD-3-Clause
// Doubles throughout, so nothing is exact here; but where two sides cross and the signs say otherwise by rounding, an
// end of one is within the rounding of the other, and the distance of that end tells.
#include "worlds/obstacle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "parallel/execution.hpp"

namespace warren {
namespace {

BoxOf<2> box_of_body(const Box& box) { return {{box.min.x, box.min.y}, {box.max.x, box.max.y}}; }

double inverse_square(Vec2 v) {
  const double square = dot(v, v);
  return square > 0.0 ? 1.0 / square : 0.0;
}

/// Square of the distance from a + to_p to the segment from a along `along`.
double to_segment_sq(Vec2 to_p, Vec2 along, double inverse_length_sq) {
  const double t = std::clamp(dot(to_p, along) * inverse_length_sq, 0.0, 1.0);
  const Vec2 off = to_p - t * along;
  return dot(off, off);
}

/// Is p inside, by crossings of the ray to the right? For points that are not on the boundary.
bool encloses(std::span<const Vec2> polygon, Vec2 p) {
  bool inside = false;
  Vec2 a = polygon.back();
  for (const Vec2 b : polygon) {
    if ((a.y <= p.y) != (b.y <= p.y) && (cross(b - a, p - a) > 0.0) == (b.y > a.y)) inside = !inside;
    a = b;
  }
  return inside;
}

bool within(const Box& inner, const Box& outer) {
  return outer.min.x <= inner.min.x && inner.max.x <= outer.max.x && outer.min.y <= inner.min.y &&
         inner.max.y <= outer.max.y;
}

/// How far the body's box is inside the bounds; negative outside.
double room_in(const Box& bounds, const Box& body) {
  return std::min(
      {body.min.x - bounds.min.x, bounds.max.x - body.max.x, body.min.y - bounds.min.y, bounds.max.y - body.max.y});
}

double largest_coordinate_of(const Box& box) {
  if (box.empty()) return 0.0;
  return std::max({std::abs(box.min.x), std::abs(box.max.x), std::abs(box.min.y), std::abs(box.max.y)});
}

}  // namespace

void Footprint::finish() {
  box_ = {};
  for (const Vec2 p : corners_) box_.include(p);
  for (std::size_t i = 0; i + 1 < corners_.size(); ++i) sides_[i] = corners_[i + 1] - corners_[i];
  sides_.back() = corners_.front() - corners_.back();
}

ObstacleTree::ObstacleTree(const Scene& scene, double reach)
    : bounds_(scene.bounds), box_(warren::obstacle_box(scene)) {
  constexpr double relative = 1e-14;
  const double inner = largest_coordinate_of(box_);
  rounding_ = relative * (std::max(inner, bounds_ ? largest_coordinate_of(*bounds_) : 0.0) + reach);
  std::vector<Segment> sides;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) sides.push_back(scene.walls.segment(i));
  for (const ScenePolygon& polygon : scene.polygons) {
    Vec2 a = polygon.corners.back();
    for (const Vec2 b : polygon.corners) {
      sides.push_back({a, b});
      a = b;
    }
  }
  file_sides(sides);
  file_polygons(scene);
}

ObstacleTree::Side ObstacleTree::side_between(Vec2 a, Vec2 b) { return {a, b - a, inverse_square(b - a)}; }

void ObstacleTree::file_sides(const std::vector<Segment>& sides) {
  std::vector<BoxOf<2>> boxes;
  for (const Segment& s : sides) boxes.push_back(box_of_body(box_of(s)));
  side_tree_ = BoxTree<2>(boxes);
  for (const std::uint32_t id : side_tree_.order()) sides_.push_back(side_between(sides[id].a, sides[id].b));
}

void ObstacleTree::file_polygons(const Scene& scene) {
  std::vector<BoxOf<2>> boxes;
  for (const ScenePolygon& polygon : scene.polygons) {
    Box box;
    for (const Vec2 p : polygon.corners) box.include(p);
    boxes.push_back(box_of_body(box));
  }
  polygon_tree_ = BoxTree<2>(boxes);
  for (const std::uint32_t id : polygon_tree_.order()) polygons_.push_back(scene.polygons[id].corners);
}

/// Square of the distance of boundaries; 0 where they cross.
double ObstacleTree::distance_sq(const Footprint& body, const Side& side) {
  const std::span<const Vec2> corners = body.corners();
  const std::span<const Vec2> sides = body.sides();
  double least = std::numeric_limits<double>::infinity();
  Vec2 to_corner = corners.back() - side.a;
  double corner_side = cross(side.along, to_corner);
  for (std::size_t i = 0, last = corners.size() - 1; i < corners.size(); last = i++) {
    // The body's side from corner `last` to corner i.
    const Vec2 next_to_corner = corners[i] - side.a;
    const double next_side = cross(side.along, next_to_corner);
    const Vec2 along = sides[last];
    const Vec2 from_corner = Vec2{} - to_corner;
    const double a_side = cross(along, from_corner);
    const double b_side = cross(along, from_corner + side.along);
    if (corner_side * next_side < 0.0 && a_side * b_side < 0.0) return 0.0;
    const double inverse = inverse_square(along);
    least =
        std::min({least, to_segment_sq(next_to_corner, side.along, side.inverse_length_sq),
                  to_segment_sq(from_corner, along, inverse), to_segment_sq(from_corner + side.along, along, inverse)});
    to_corner = next_to_corner;
    corner_side = next_side;
  }
  return least;
}

/// Does a polygon hold the body, whose boundary meets none?
bool ObstacleTree::swallows(const Footprint& body) const {
  const Vec2 p = body.corners().front();
  bool found = false;
  polygon_tree_.search({{p.x, p.y}, {p.x, p.y}}, 0.0, [&](std::uint32_t place) {
    found = encloses(polygons_[place], p);
    return found ? -1.0 : 0.0;
  });
  return found;
}

double ObstacleTree::clearance(const Footprint& body, double enough) const {
  double least = enough + 2.0 * rounding_;
  least = std::nextafter(least, std::numeric_limits<double>::infinity());
  if (bounds_) {
    least = std::min(least, room_in(*bounds_, body.box()));
    if (least <= rounding_) return std::min(least - rounding_, 0.0);
  }
  double boundary = least;
  side_tree_.search(box_of_body(body.box()), least, [&](std::uint32_t place) {
    const Side& side = sides_[place];
    boundary = std::min(boundary, std::sqrt(distance_sq(body, side)));
    const bool swallowed =
        within(box_of({side.a, side.a + side.along}), body.box()) && encloses(body.corners(), side.a);
    if (boundary <= rounding_ || swallowed) boundary = -1.0;
    return boundary;
  });
  if (boundary <= rounding_ || swallows(body)) return 0.0;
  return boundary - rounding_;
}

std::size_t ObstacleTree::bytes() const {
  std::size_t sum = side_tree_.bytes() + polygon_tree_.bytes() + sides_.size() * sizeof(Side);
  for (const auto& polygon : polygons_) sum += polygon.size() * sizeof(Vec2);
  return sum;
}

}  // namespace warren
