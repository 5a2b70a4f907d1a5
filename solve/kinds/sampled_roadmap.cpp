// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/sampled_roadmap.hpp"

#include <iterator>

namespace warren {
namespace {

using Wall = std::array<double, 4>;

std::vector<Wall> walls_of(const Scene& scene, const Execution& execution) {
  execution.reserve(scene.walls.size() * sizeof(Wall));
  std::vector<Wall> walls;
  walls.reserve(scene.walls.size());
  scene.walls.visit([&](auto all) {
    for (const auto& wall : all) {
      const Segment s = wall.segment();
      walls.push_back({s.a.x, s.a.y, s.b.x, s.b.y});
    }
  });
  polled_sort(walls.begin(), walls.end(), execution);
  return walls;
}

using Corners = std::vector<std::array<double, 2>>;

std::vector<Corners> polygons_of(const Scene& scene, const Execution& execution) {
  std::vector<Corners> polygons;
  for (const ScenePolygon& polygon : scene.polygons) {
    Corners corners;
    for (const Vec2 c : polygon.corners) corners.push_back({c.x, c.y});
    polygons.push_back(std::move(corners));
  }
  polled_sort(polygons.begin(), polygons.end(), execution);
  return polygons;
}

template <class T>
std::vector<T> difference(const std::vector<T>& a, const std::vector<T>& b) {
  std::vector<T> only;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
  return only;
}

bool same_box(const std::optional<Box>& a, const std::optional<Box>& b) {
  if (a.has_value() != b.has_value()) return false;
  return !a || (a->min == b->min && a->max == b->max);
}

bool has_other_frame(const Scene& a, const Scene& b) {
  return !same_box(a.bounds, b.bounds) || a.maze != b.maze || has_solids(a) || has_solids(b) ||
         a.seams.size() != b.seams.size() || a.map.has_value() != b.map.has_value();
}

/// Nothing where the maps' cells are not the same places.
bool add_changed_cells(const OccupancyMap& a, const OccupancyMap& b, std::vector<Box>& places) {
  const bool same_place = a.width() == b.width() && a.height() == b.height() && a.cell == b.cell &&
                          a.origin == b.origin && a.yaw_rad == b.yaw_rad;
  if (!same_place || !a.water.empty() || !b.water.empty()) return false;
  for (std::uint32_t y = 0; y < a.height(); ++y) {
    if (std::equal(a.blocked.row(y).begin(), a.blocked.row(y).end(), b.blocked.row(y).begin())) continue;
    for (std::uint32_t x = 0; x < a.width(); ++x) {
      if (a.blocked.test(x, y) == b.blocked.test(x, y)) continue;
      places.push_back(world_box(a, {{1.0 * x, 1.0 * y}, {x + 1.0, y + 1.0}}));
      if (places.size() > most_changed_places) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<std::vector<Box>> changed_places(const Scene& before, const Scene& now, const Execution& execution) {
  if (has_other_frame(before, now)) return std::nullopt;
  if (!before.bounds && !same_box(obstacle_box(before, execution), obstacle_box(now, execution))) return std::nullopt;
  std::vector<Box> places;
  if (before.map && !add_changed_cells(*before.map, *now.map, places)) return std::nullopt;
  const auto walls = difference(walls_of(before, execution), walls_of(now, execution));
  const auto polygons = difference(polygons_of(before, execution), polygons_of(now, execution));
  if (walls.size() + polygons.size() + places.size() > most_changed_places) return std::nullopt;
  for (const Wall& wall : walls) {
    Box box;
    box.include(Vec2{wall[0], wall[1]});
    box.include(Vec2{wall[2], wall[3]});
    places.push_back(box);
  }
  for (const Corners& corners : polygons) {
    Box box;
    for (const auto& [x, y] : corners) box.include(Vec2{x, y});
    places.push_back(box);
  }
  return places;
}

bool comes_near(const std::vector<Box>& places, const Box& box, double reach) {
  const Box wide = box.grown(reach);
  return std::ranges::any_of(places, [&](const Box& place) { return wide.meets(place); });
}

}  // namespace warren
