// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/scene/plane_obstacles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/chunks.hpp"
#include "scenes/scene/rings.hpp"

namespace warren {
namespace {

constexpr std::size_t obstacle_grain = 512;

/// Appends the corners without repetitions, the last one and the first included.
void append_distinct(std::vector<Vec2>& to, const std::vector<Vec2>& corners) {
  const std::size_t begin = to.size();
  for (const Vec2 p : corners) {
    if (to.size() == begin || !(p == to.back())) to.push_back(p);
  }
  while (to.size() > begin + 1 && to.back() == to[begin]) to.pop_back();
}

/// Asked at the leftmost corner, the lowest of these: a simple outline is convex there.
bool runs_clockwise(std::span<const Vec2> corners) {
  const auto before = [](Vec2 p, Vec2 q) { return p.x < q.x || (p.x == q.x && p.y < q.y); };
  const auto at = static_cast<std::size_t>(std::min_element(corners.begin(), corners.end(), before) - corners.begin());
  const std::size_t n = corners.size();
  return orient2d(corners[(at + n - 1) % n], corners[at], corners[(at + 1) % n]) < 0;
}

bool has_area(std::span<const Vec2> corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    if (orient2d(corners[0], corners[1], corners[i]) != 0) return true;
  }
  return false;
}

std::string text_of(Vec2 p) { return fmt::format("{} {}", p.x, p.y); }

/// place(): names the polygon. No two corners in a row are equal.
template <class Place>
void check_outline(std::span<const Vec2> corners, const Place& place, const Execution& execution) {
  if (corners.size() < 3) {
    throw InputError(place(), "a polygon needs at least three different corners", std::to_string(corners.size()));
  }
  if (!has_area(corners)) {
    throw InputError(place(), "this polygon has no area: all its corners lie on one line");
  }
  const auto contact = self_contact(corners, execution);
  if (!contact) return;
  throw InputError(place(),
                   fmt::format("a polygon's outline must not cross or touch itself; the sides from {} and from {} meet",
                               text_of(corners[contact->first]), text_of(corners[contact->second])));
}

/// The checked outlines of some polygons.
PolygonSet checked_outlines(const Scene& scene, Range range, const Execution& execution) {
  PolygonSet set;
  for (std::size_t i = range.first; i < range.last; ++i) {
    append_distinct(set.corners, scene.polygons[i].corners);
    if (set.corners.size() > std::numeric_limits<std::uint32_t>::max()) {
      throw InputError(scene.source, "polygons with 2^32 corners and more are too many");
    }
    set.first.push_back(static_cast<std::uint32_t>(set.corners.size()));
    const std::span<Vec2> outline = std::span(set.corners).subspan(set.first[set.first.size() - 2]);
    check_outline(
        std::span<const Vec2>(outline), [&] { return place_of_polygon(scene, i); }, execution);
    if (runs_clockwise(outline)) std::reverse(outline.begin(), outline.end());
  }
  return set;
}

std::vector<PolygonSet> checked_parts(const Scene& scene, const Execution& execution, bool keep) {
  std::vector<PolygonSet> parts(chunk_count(scene.polygons.size(), obstacle_grain));
  for_chunks(scene.polygons.size(), obstacle_grain, execution, [&](Range range) {
    PolygonSet part = checked_outlines(scene, range, execution);
    if (keep) parts[range.first / obstacle_grain] = std::move(part);
  });
  return parts;
}

}  // namespace

std::vector<Vec2> anticlockwise(const std::vector<Vec2>& corners) {
  std::vector<Vec2> outline;
  append_distinct(outline, corners);
  if (outline.size() < 3 || !has_area(outline)) return corners;
  if (runs_clockwise(outline)) std::reverse(outline.begin(), outline.end());
  return outline;
}

std::string place_of_polygon(const Scene& scene, std::size_t polygon) {
  const std::size_t line = scene.polygons[polygon].line;
  return line > 0 ? fmt::format("{}:{}", scene.source, line) : fmt::format("{}: polygon {}", scene.source, polygon);
}

void check_polygons(const Scene& scene, const Execution& execution) { checked_parts(scene, execution, false); }

void check_body(std::span<const Vec2> outline, const std::string& where, const Execution& execution) {
  std::vector<Vec2> corners;
  append_distinct(corners, {outline.begin(), outline.end()});
  check_outline(
      std::span<const Vec2>(corners), [&] { return where; }, execution);
}

PlaneObstacles plane_obstacles(const Scene& scene, const Execution& execution) {
  PlaneObstacles obstacles;
  std::vector<PolygonSet> parts = checked_parts(scene, execution, true);
  std::size_t corners = 0;
  for (const PolygonSet& part : parts) corners += part.corners.size();
  if (corners > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError(scene.source, "polygons with 2^32 corners and more are too many");
  }
  execution.reserve(corners * sizeof(Vec2) + scene.walls.size() * sizeof(Segment));
  obstacles.polygons.corners.reserve(corners);
  for (const PolygonSet& part : parts) {
    for (std::size_t i = 0; i < part.size(); ++i) obstacles.polygons.add(part[i]);
  }
  obstacles.walls.reserve(scene.walls.size());
  scene.walls.visit([&](auto walls) {
    for (const auto& wall : walls) obstacles.walls.push_back(wall.segment());
  });
  obstacles.bounds = scene.bounds;
  return obstacles;
}

}  // namespace warren
