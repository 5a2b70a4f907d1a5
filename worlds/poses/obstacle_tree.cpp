// SPDX-License-Identifier: BSD-3-Clause
// Doubles throughout, so nothing is exact here; but where two sides cross and the signs say otherwise by rounding, an
// end of one is within the rounding of the other, and the distance of that end tells.
#include "worlds/poses/obstacle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/whole.hpp"
#include "parallel/asked_memory.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

/// Kept from lines, as a share of the body's size: nearer than that a path could hardly be verified.
constexpr double spare = 1e-5;
constexpr std::size_t most_sides = 16;  ///< of a convex polygon

BoxOf<2> box_of_body(const Box& box) { return {{box.min.x, box.min.y}, {box.max.x, box.max.y}}; }
BoxOf<2> box_of_body(const Segment& s) { return box_of_body(box_of(s)); }
BoxOf<2> box_of_body(std::span<const Vec2> polygon) { return box_of_body(box_around(polygon)); }

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

bool within(const Box& inner, const Box& outer) { return outer.contains(inner.min) && outer.contains(inner.max); }

/// How far the body's box is inside the bounds; negative outside.
double room_in(const Box& bounds, const Box& body) {
  return std::min(
      {body.min.x - bounds.min.x, bounds.max.x - body.max.x, body.min.y - bounds.min.y, bounds.max.y - body.max.y});
}

/// Which way the corners go round, 1 to the left, -1 to the right, where all turn the same way or go straight on, once
/// around in all, with sides that are neither without length nor too many; else 0.
int turning_of(std::span<const Vec2> corners) {
  if (corners.size() > most_sides) return 0;
  double least = 0.0;
  double most = 0.0;
  int rises = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 b = corners[(i + 1) % corners.size()];
    const Vec2 along = b - corners[i];
    if (!(inverse_square(along) > 0.0)) return 0;
    const Vec2 next = corners[(i + 2) % corners.size()] - b;
    const double turn = cross(along, next);
    if (turn == 0.0 && !(dot(along, next) > 0.0)) return 0;  // it turns back
    rises += along.y <= 0.0 && next.y > 0.0 ? 1 : 0;
    least = std::min(least, turn);
    most = std::max(most, turn);
  }
  if ((least == 0.0) == (most == 0.0) || rises != 1) return 0;
  return most > 0.0 ? 1 : -1;
}

/// Does the whole body stay more than `reach` before the line through p, whose normal is `outward`, for so long?
bool stays_before(const Footprint& body, double time, Vec2 p, Vec2 outward, double reach) {
  const std::span<const Vec2> corners = body.corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double way = time * std::abs(dot(outward, body.velocities[i])) + time * time * body.bends[i];
    if (!(dot(outward, corners[i] - p) - way > reach)) return false;
  }
  return true;
}

/// Thing: a segment or a polygon's corners.
template <class Thing>
BoxTree<2> tree_around(const std::vector<Thing>& things, const Execution& execution) {
  std::vector<BoxOf<2>> boxes;
  for (const Thing& thing : things) push_asked(boxes, box_of_body(thing), execution);
  return BoxTree<2>(boxes, execution);
}

}  // namespace

void Footprint::finish() {
  box = box_around(corners);
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) sides[i] = corners[i + 1] - corners[i];
  sides.back() = corners.front() - corners.back();
  for (std::size_t i = 0; i < sides.size(); ++i) inverse_squares[i] = inverse_square(sides[i]);
}

ObstacleTree::ObstacleTree(const Scene& scene, double reach, const Execution& execution)
    : bounds_(scene.bounds), box_(warren::obstacle_box(scene)) {
  check_polygons(scene, execution);
  // The judge calls free what is farther than 2.7e-14 (L + 2 r + c) by its own doubles, a tenth of it for its last
  // halving, L being the largest coordinate of obstacles, bounds or map, r the body's radius, c the clearance
  // (verify/judges/verify_turning.cpp); `reach` is r + c at least. Corners are off by at most 4 roundings of numbers up
  // to L + r here and there, distances by 8 more of such: 12 x 1.2e-16 each, 0.3e-14 (L + r) in both. A car's legs are
  // off by 8 more of numbers up to L + R, R in `reach`, and the judge takes 0.1e-14 R. So what is more than 4e-14 (L +
  // 2 reach) away here is farther than the judge asks for there.
  constexpr double relative = 4e-14;
  Box all = box_;
  if (bounds_) all.include(*bounds_);
  if (scene.map) all.include(world_box(*scene.map));
  double largest = 0.0;
  for (const Vec2 p : all.corners()) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  rounding_ = relative * ((all.empty() ? 0.0 : largest) + 2.0 * reach);
  std::vector<Segment> sides;
  std::vector<std::span<const Vec2>> convex;
  std::vector<std::span<const Vec2>> others;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    execution.poll(i);
    push_asked(sides, scene.walls.segment(i), execution);
  }
  for (const ScenePolygon& polygon : scene.polygons) {
    execution.check();
    if (turning_of(polygon.corners) != 0) {
      push_asked(convex, polygon.corners, execution);
      continue;
    }
    push_asked(others, polygon.corners, execution);
    for_each_side(polygon.corners, [&](Vec2 a, Vec2 b) { push_asked(sides, {a, b}, execution); });
  }
  const auto side_between = [](Vec2 a, Vec2 b) { return Side{a, b - a, inverse_square(b - a)}; };
  side_tree_ = tree_around(sides, execution);
  for (const std::uint32_t id : side_tree_.order()) {
    execution.poll(sides_.size());
    push_asked(sides_, side_between(sides[id].a, sides[id].b), execution);
  }
  polygon_tree_ = tree_around(others, execution);
  for (const std::uint32_t id : polygon_tree_.order()) {
    execution.reserve(others[id].size_bytes());
    push_asked(polygons_, {others[id].begin(), others[id].end()}, execution);
  }
  convex_tree_ = tree_around(convex, execution);
  for (const std::uint32_t id : convex_tree_.order()) {
    execution.poll(convex_.size());
    const std::span<const Vec2> corners = convex[id];
    const auto first = as_whole<std::uint32_t>(convex_sides_.size());
    const bool left = turning_of(corners) > 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Side side = side_between(corners[i], corners[(i + 1) % corners.size()]);
      const Vec2 right = (1.0 / norm(side.along)) * Vec2{side.along.y, -side.along.x};
      push_asked(convex_sides_, {side, left ? right : Vec2{} - right}, execution);
    }
    push_asked(convex_, {first, as_whole<std::uint32_t>(convex_sides_.size()), box_around(corners)}, execution);
  }
}

/// Square of the distance of boundaries; 0 where they cross.
double ObstacleTree::distance_sq(const Footprint& body, const Side& side) {
  const std::span<const Vec2> corners = body.corners;
  const std::span<const Vec2> sides = body.sides;
  const std::span<const double> inverse_squares = body.inverse_squares;
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
    const double inverse = inverse_squares[last];
    least =
        std::min({least, to_segment_sq(next_to_corner, side.along, side.inverse_length_sq),
                  to_segment_sq(from_corner, along, inverse), to_segment_sq(from_corner + side.along, along, inverse)});
    to_corner = next_to_corner;
    corner_side = next_side;
  }
  return least;
}

/// From a convex polygon, 0 where they meet; anything above `enough` where it is more.
double ObstacleTree::distance_to(const Footprint& body, const ConvexPolygon& polygon, double enough) const {
  const std::span<const ConvexSide> sides(convex_sides_.data() + polygon.first, polygon.last - polygon.first);
  const std::span<const Vec2> corners = body.corners;
  bool holds_first = true;
  for (const ConvexSide& s : sides) {
    const double first = dot(s.outward, corners.front() - s.side.a);
    double least = first;
    for (const Vec2 p : corners.subspan(1)) least = std::min(least, dot(s.outward, p - s.side.a));
    if (least > enough) return least;
    holds_first = holds_first && first <= 0.0;
  }
  if (holds_first) return 0.0;
  if (within(polygon.box, body.box) && encloses(corners, sides.front().side.a)) return 0.0;
  double square = std::numeric_limits<double>::infinity();
  for (const ConvexSide& s : sides) {
    // What is behind a side is nearer to another one, or inside, which is settled.
    const auto is_before = [&s](Vec2 p) { return dot(s.outward, p - s.side.a) > 0.0; };
    if (std::any_of(corners.begin(), corners.end(), is_before)) square = std::min(square, distance_sq(body, s.side));
  }
  return std::sqrt(square);
}

/// Does a polygon hold the body, whose boundary meets none?
bool ObstacleTree::swallows(const Footprint& body) const {
  const Vec2 p = body.corners.front();
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
    least = std::min(least, room_in(*bounds_, body.box));
    if (least <= rounding_) return std::min(least - rounding_, 0.0);
  }
  double boundary = least;
  convex_tree_.search(box_of_body(body.box), least, [&](std::uint32_t place) {
    boundary = std::min(boundary, distance_to(body, convex_[place], boundary));
    return boundary > rounding_ ? boundary : -1.0;
  });
  if (boundary <= rounding_) return 0.0;
  side_tree_.search(box_of_body(body.box), boundary, [&](std::uint32_t place) {
    const Side& side = sides_[place];
    boundary = std::min(boundary, std::sqrt(distance_sq(body, side)));
    const bool swallowed = within(box_of({side.a, side.a + side.along}), body.box) && encloses(body.corners, side.a);
    if (boundary <= rounding_ || swallowed) boundary = -1.0;
    return boundary;
  });
  if (boundary <= rounding_ || swallows(body)) return 0.0;
  return boundary - rounding_;
}

Room ObstacleTree::room_in_bounds(const Footprint& body, const Move& move, double reach) const {
  if (!bounds_) return Room::clear;
  const double room = room_in(*bounds_, body.box);
  if (room <= reach) return Room::blocked;
  if (room > reach + move.travel) return Room::clear;
  const double before = reach + spare * (body.box.width() + body.box.height());
  const bool stays = stays_before(body, move.time, bounds_->min, {1.0, 0.0}, before) &&
                     stays_before(body, move.time, bounds_->min, {0.0, 1.0}, before) &&
                     stays_before(body, move.time, bounds_->max, {-1.0, 0.0}, before) &&
                     stays_before(body, move.time, bounds_->max, {0.0, -1.0}, before);
  return stays ? Room::clear : Room::narrow;
}

Room ObstacleTree::room(const Footprint& body, const Move& move, double reach) const {
  const double touch = reach + rounding_;
  const double enough = touch + move.travel;
  const double before = touch + spare * (body.box.width() + body.box.height());
  Room room = room_in_bounds(body, move, touch);
  if (room == Room::blocked) return room;
  const auto end_at = [&](double distance) {
    if (distance <= enough) room = distance <= touch ? Room::blocked : Room::narrow;
    return room == Room::blocked ? -1.0 : enough;
  };
  const auto passes = [&](const ConvexSide& s) { return stays_before(body, move.time, s.side.a, s.outward, before); };
  const BoxOf<2> box = box_of_body(body.box);
  convex_tree_.search(box, enough, [&](std::uint32_t place) {
    const ConvexPolygon& polygon = convex_[place];
    const ConvexSide* const sides = convex_sides_.data();
    if (room == Room::clear && std::any_of(sides + polygon.first, sides + polygon.last, passes)) return enough;
    const double distance = distance_to(body, polygon, room == Room::clear ? enough : touch);
    return room == Room::clear || distance <= touch ? end_at(distance) : enough;
  });
  if (room == Room::blocked) return room;
  side_tree_.search(box, enough, [&](std::uint32_t place) {
    const Side& side = sides_[place];
    const Vec2 across = std::sqrt(side.inverse_length_sq) * Vec2{side.along.y, -side.along.x};
    if (stays_before(body, move.time, side.a, across, before) ||
        stays_before(body, move.time, side.a, Vec2{} - across, before)) {
      return enough;
    }
    const bool swallowed = within(box_of({side.a, side.a + side.along}), body.box) && encloses(body.corners, side.a);
    return end_at(swallowed ? 0.0 : std::sqrt(distance_sq(body, side)));
  });
  return room != Room::blocked && swallows(body) ? Room::blocked : room;
}

void ObstacleTree::take_blocked_places(std::span<const Vec2> mirrored_body, double reach, PlaceGrid& free) const {
  std::array<Vec2, most_sides> corners;
  for (const ConvexPolygon& polygon : convex_) {
    const std::size_t count = polygon.last - polygon.first;
    const ConvexSide* sides = convex_sides_.data() + polygon.first;
    const bool clockwise = cross(sides->side.along, sides->outward) > 0.0;
    for (std::size_t i = 0; i < count; ++i) corners[clockwise ? count - 1 - i : i] = sides[i].side.a;
    warren::take_blocked_places(std::span(corners).first(count), mirrored_body, reach, free);
  }
  for (const Side& side : sides_) {
    const std::array<Vec2, 2> ends{side.a, side.a + side.along};
    warren::take_blocked_places(ends, mirrored_body, reach, free);
  }
}

}  // namespace warren
