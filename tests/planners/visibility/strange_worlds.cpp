// SPDX-License-Identifier: BSD-3-Clause
#include "tests/planners/visibility/strange_worlds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "tests/planners/visibility/rational_plane.hpp"

namespace warren::test {
namespace {

constexpr int grid_size = 8;
constexpr int decades = 12;  // coordinates reach from 1e-12 to 1e12

double moved_by_ulps(double c, int ulps) {
  const double towards = ulps > 0 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  for (int i = 0; i < std::abs(ulps); ++i) c = std::nextafter(c, towards);
  return std::abs(c) < smallest_coordinate ? 0.0 : c;  // as readers take it
}

/// As a reader hands it on: simple, anticlockwise, without equal corners in a row; empty where it would be refused.
std::vector<Vec2> as_read(const std::vector<Vec2>& ring) {
  Scene scene;
  scene.polygons.push_back({ring, 0});
  try {
    const PlaneObstacles read = plane_obstacles(scene, {});
    return {read.polygons.corners.begin(), read.polygons.corners.end()};
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

StrangeWorlds::StrangeWorlds(std::uint64_t seed) : dice_(seed) { choose_numbers(); }

void StrangeWorlds::choose_numbers() {
  numbers_ = std::array{Numbers::grid, Numbers::grid, Numbers::grid, Numbers::pool, Numbers::reals, Numbers::powers}
      [static_cast<std::size_t>(dice_.roll(6))];
  may_overlap_ = dice_.roll(4) == 0;
  if (dice_.roll(2) == 0) scale_ = std::pow(10.0, dice_.roll(2 * decades) - decades);
  if (dice_.roll(4) == 0) offset_ = {scale_ * (dice_.real() - 0.5) * 1e3, scale_ * (dice_.real() - 0.5) * 1e3};
  for (int i = 0, n = 4 + dice_.roll(5); i < n; ++i) pool_.push_back(value_of_pool());
}

/// Any size, close to another one, or made of two others.
double StrangeWorlds::value_of_pool() {
  const auto known = [&] {
    return pool_.empty() ? 0.0 : pool_[static_cast<std::size_t>(dice_.roll(static_cast<int>(pool_.size())))];
  };
  switch (dice_.roll(7)) {
    case 0:
      return moved_by_ulps(known(), dice_.roll(5) - 2);
    case 1:
      return known() + known();
    case 2:
      return -known();
    case 3:
      return 0.5 * (known() + known());
    default: {
      const double size = std::pow(10.0, dice_.roll(2 * decades + 1) - decades);
      return (dice_.roll(2) == 0 ? 1.0 : dice_.real()) * (dice_.roll(3) == 0 ? -size : size);
    }
  }
}

double StrangeWorlds::coordinate() {
  switch (numbers_) {
    case Numbers::grid:
      return scale_ * dice_.roll(grid_size + 1);
    case Numbers::reals:
      return scale_ * dice_.real();
    case Numbers::pool:
      return pool_[static_cast<std::size_t>(dice_.roll(static_cast<int>(pool_.size())))];
    case Numbers::powers:
      break;
  }
  const double size = std::pow(10.0, 2 * decades * dice_.real() - decades);
  return dice_.roll(2) == 0 ? size : -size;
}

Vec2 StrangeWorlds::fresh_point() {
  const Vec2 p{coordinate(), coordinate()};
  return p + offset_;
}

Segment StrangeWorlds::known_side() {
  return sides_[static_cast<std::size_t>(dice_.roll(static_cast<int>(sides_.size())))];
}

Vec2 StrangeWorlds::known_corner() {
  const Segment side = known_side();
  return dice_.roll(2) == 0 ? side.a : side.b;
}

/// On it but for rounding, which halves and quarters of a grid don't need.
Vec2 StrangeWorlds::on_known_side() {
  const Segment side = known_side();
  const double t = dice_.roll(3) > 0 ? 0.25 * (1 + dice_.roll(3)) : dice_.real();
  return side.a + t * (side.b - side.a);
}

Vec2 StrangeWorlds::beyond_known_side() {
  const Segment side = known_side();
  return side.b + (dice_.roll(2) == 0 ? 1.0 : 2.0 * dice_.real()) * (side.b - side.a);
}

Vec2 StrangeWorlds::nearly(Vec2 p) {
  return {moved_by_ulps(p.x, dice_.roll(3) - 1), moved_by_ulps(p.y, dice_.roll(3) - 1)};
}

/// A point that has to do with what stands already, in every other case.
Vec2 StrangeWorlds::place() {
  if (sides_.empty()) return fresh_point();
  switch (dice_.roll(12)) {
    case 0:
    case 1:
    case 2:
      return known_corner();
    case 3:
      return on_known_side();
    case 4:
      return beyond_known_side();
    case 5:
      return nearly(dice_.roll(2) == 0 ? known_corner() : on_known_side());
    case 6:
      return {known_corner().x, known_corner().y};
    default:
      return fresh_point();
  }
}

std::vector<Vec2> StrangeWorlds::rectangle() {
  const Vec2 a = place();
  const Vec2 b = place();
  std::vector<Vec2> ring{a, {b.x, a.y}, b, {a.x, b.y}};
  if (dice_.roll(3) == 0) ring.insert(ring.begin() + 1, {0.5 * (a.x + b.x), a.y});  // a corner on a straight side
  return ring;
}

/// A triangle over a side, or a part of it, that stands already.
std::vector<Vec2> StrangeWorlds::on_a_side() {
  const Segment side = known_side();
  const Vec2 a = dice_.roll(3) == 0 ? 0.5 * (side.a + side.b) : side.a;
  return {a, side.b, place()};
}

/// A triangle that shares a corner with a polygon and lies within it, or nearly.
std::vector<Vec2> StrangeWorlds::within_a_corner() {
  const PolygonSet& polygons = made_.obstacles.polygons;
  if (polygons.empty()) return {place(), place(), place()};
  const auto ring = polygons[static_cast<std::size_t>(dice_.roll(static_cast<int>(polygons.size())))];
  const auto at = static_cast<std::size_t>(dice_.roll(static_cast<int>(ring.size())));
  const Vec2 corner = ring[at];
  const auto towards = [&](Vec2 p) { return corner + 0.25 * (1 + dice_.roll(3)) * (p - corner); };
  return {corner, towards(ring[(at + 1) % ring.size()]), towards(ring[(at + ring.size() - 1) % ring.size()])};
}

std::vector<Vec2> StrangeWorlds::around_a_point() {
  std::vector<Vec2> ring;
  Vec2 center;
  for (int i = 0, n = 3 + dice_.roll(4); i < n; ++i) {
    ring.push_back(place());
    center = center + ring.back();
  }
  center = (1.0 / static_cast<double>(ring.size())) * center;
  const auto angle = [&](Vec2 p) { return std::atan2(p.y - center.y, p.x - center.x); };
  std::stable_sort(ring.begin(), ring.end(), [&](Vec2 p, Vec2 q) { return angle(p) < angle(q); });
  return ring;
}

/// A box with a room that is open at the top, perhaps by a slot as wide as rounding leaves.
std::vector<Vec2> StrangeWorlds::bracket_around() {
  Box box;
  box.include(place());
  box.include(place());
  const double x = box.min.x + 0.25 * box.width();
  const double end = dice_.roll(4) == 0 ? moved_by_ulps(x, 1) : box.min.x + 0.5 * box.width();
  const double y = box.min.y + 0.25 * box.height();
  return {box.min,        {box.max.x, box.min.y}, box.max, {end, box.max.y}, {end, y}, {x, y},
          {x, box.max.y}, {box.min.x, box.max.y}};
}

std::vector<Vec2> StrangeWorlds::outline() {
  switch (sides_.empty() ? dice_.roll(3) : dice_.roll(6)) {
    case 0:
      return rectangle();
    case 1:
      return around_a_point();
    case 2:
      return {place(), place(), place()};
    case 3:
      return on_a_side();
    case 4:
      return within_a_corner();
    default:
      return bracket_around();
  }
}

/// By the plainest means: most worlds shall have nothing that cells refuse.
bool StrangeWorlds::overlaps(const std::vector<Vec2>& ring) const {
  PlaneObstacles both = made_.obstacles;
  both.polygons.add(ring);
  return rational::Plane(both).has_overlaps();
}

/// False: the outline that came about doesn't fit.
bool StrangeWorlds::add_polygon() {
  PolygonSet& polygons = made_.obstacles.polygons;
  const bool again = !polygons.empty() && dice_.roll(20) == 0;
  std::vector<Vec2> ring;
  if (again) {
    const auto known = polygons[polygons.size() - 1];
    ring.assign(known.begin(), known.end());
  } else {
    ring = as_read(outline());
  }
  if (ring.empty() || (!may_overlap_ && overlaps(ring))) return false;
  polygons.add(ring);
  for (std::size_t i = 0; i < ring.size(); ++i) sides_.push_back({ring[i], ring[(i + 1) % ring.size()]});
  return true;
}

/// False: it would cross something and mayn't.
bool StrangeWorlds::add_wall() {
  Segment wall{place(), place()};
  if (!sides_.empty()) {
    const Segment known = known_side();
    switch (dice_.roll(10)) {
      case 0:
        wall.b = wall.a;
        break;
      case 1:
        wall = dice_.roll(2) == 0 ? known : Segment{known.b, known.a};
        break;
      case 2:
        wall = {0.5 * (known.a + known.b), beyond_known_side()};
        break;
      case 3:
        wall = {known.b, {known.b.x, wall.b.y}};
        break;
      default:
        break;
    }
  }
  PlaneObstacles both = made_.obstacles;
  both.walls.push_back(wall);
  if (!may_overlap_ && rational::Plane(both).has_overlaps()) return false;
  made_.obstacles.walls.push_back(wall);
  sides_.push_back(wall);
  return true;
}

void StrangeWorlds::add_bounds() {
  PlaneObstacles& obstacles = made_.obstacles;
  const Box around = box_around(obstacles);
  Box box = around;
  switch (dice_.roll(8)) {
    case 0:
      break;
    case 1:
    case 2:
    case 3:
      box = around.grown(std::max(around.width(), around.height()) * (dice_.roll(2) == 0 ? 0.25 : 1e-9));
      break;
    case 4:
      box = {};
      for (int i = 0; i < 3; ++i) box.include(place());
      break;
    default:
      return;
  }
  if (box.width() > 0.0 && box.height() > 0.0) obstacles.bounds = box;
}

/// Mostly a place where a path may begin.
Vec2 StrangeWorlds::end_of_path() {
  const bool anywhere = dice_.roll(2) == 0;
  const auto end = [&] {
    if (!anywhere) return place();
    if (numbers_ == Numbers::grid)
      return 0.25 * scale_ * Vec2{1.0 * dice_.roll(4 * grid_size), 1.0 * dice_.roll(4 * grid_size)} + offset_;
    return fresh_point();
  };
  Vec2 p = end();
  const int tries = dice_.roll(8) == 0 ? 0 : 6;
  for (int i = 0; i < tries && !judged(made_.obstacles, {p}).verified; ++i) p = end();
  return p;
}

PlaneProblem StrangeWorlds::make() {
  const bool many = dice_.roll(2) == 0;
  const int polygons = dice_.roll(3) == 0 ? 0 : dice_.roll(many ? 8 : 4);
  const int walls = dice_.roll(many || polygons == 0 ? 14 : 5);
  for (int left_polygons = polygons, left_walls = walls; left_polygons + left_walls > 0;) {
    const bool polygon = dice_.roll(left_polygons + left_walls) < left_polygons;
    --(polygon ? left_polygons : left_walls);
    for (int tries = 0; tries < 4; ++tries) {
      if (polygon ? add_polygon() : add_wall()) break;
    }
  }
  add_bounds();
  made_.start = end_of_path();
  made_.goal = dice_.roll(25) == 0 ? made_.start : end_of_path();
  return made_;
}

}  // namespace warren::test
