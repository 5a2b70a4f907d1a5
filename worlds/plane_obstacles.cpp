// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/plane_obstacles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/geometry.hpp"
#include "parallel/chunks.hpp"
#include "worlds/simple_outline.hpp"

namespace warren {
namespace {

constexpr std::size_t grain = 512;

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

void check_outline(const Scene& scene, std::size_t polygon, std::span<const Vec2> corners, const Execution& execution) {
  if (corners.size() < 3) {
    throw InputError(place_of_polygon(scene, polygon), "a polygon needs at least three different corners",
                     std::to_string(corners.size()));
  }
  if (!has_area(corners)) {
    throw InputError(place_of_polygon(scene, polygon), "this polygon has no area: all its corners lie on one line");
  }
  const auto contact = self_contact(corners, execution);
  if (!contact) return;
  throw InputError(place_of_polygon(scene, polygon),
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
    check_outline(scene, i, outline, execution);
    if (runs_clockwise(outline)) std::reverse(outline.begin(), outline.end());
  }
  return set;
}

std::vector<PolygonSet> checked_parts(const Scene& scene, const Execution& execution, bool keep) {
  std::vector<PolygonSet> parts(chunk_count(scene.polygons.size(), grain));
  for_chunks(scene.polygons.size(), grain, execution, [&](Range range) {
    PolygonSet part = checked_outlines(scene, range, execution);
    if (keep) parts[range.first / grain] = std::move(part);
  });
  return parts;
}

/// Is direction p in the angle that opens anticlockwise from direction `first` to direction `last`, first included?
/// Directions are those of points seen from `at`.
bool in_angle(Vec2 at, Vec2 first, Vec2 last, Vec2 p) {
  const int turn = orient2d(at, first, last);
  const bool left_of_first = orient2d(at, first, p) > 0;
  const bool on_first = orient2d(at, first, p) == 0 && dot(first - at, p - at) > 0.0;
  const bool right_of_last = orient2d(at, last, p) < 0;
  if (on_first) return true;
  if (turn > 0) return left_of_first && right_of_last;
  return left_of_first || right_of_last;  // half a turn or more
}

/// The part of a polygon around a point of its outline: anticlockwise from `first` to `last` is its inside.
struct Cone {
  Vec2 first;
  Vec2 last;
};

/// The cones of a side's polygon at p, a point of the side.
Cone cone_at(const PolygonIndex& polygons, std::size_t side, Vec2 p) {
  const std::size_t polygon = polygons.polygon_of(side);
  const std::span<const Vec2> corners = polygons.polygons()[polygon];
  const std::size_t n = corners.size();
  const std::size_t i = side - polygons.polygons().first[polygon];
  const Vec2 a = corners[i];
  const Vec2 b = corners[(i + 1) % n];
  if (p == a) return {b, corners[(i + n - 1) % n]};
  if (p == b) return {corners[(i + 2) % n], a};
  return {b, a};
}

/// Finds overlaps of one polygon with those of higher number.
class OverlapSearch {
 public:
  explicit OverlapSearch(const PolygonIndex& polygons) : polygons_(polygons) {}

  std::optional<std::size_t> partner(std::size_t polygon) const {
    std::optional<std::size_t> lowest;
    Box box;
    for (const Vec2 p : polygons_.polygons()[polygon]) box.include(p);
    polygons_.for_each_polygon_near(box, [&](std::uint32_t other) {
      const bool of_interest = other > polygon && (!lowest || other < *lowest);
      if (of_interest && overlap(polygon, other)) lowest = other;
      return true;
    });
    return lowest;
  }

 private:
  bool overlap(std::size_t a, std::size_t b) const {
    bool touching = false;
    Box box_b;
    for (const Vec2 p : polygons_.polygons()[b]) box_b.include(p);
    const bool apart = polygons_.for_each_side_near(a, box_b, [&](std::size_t side) {
      return polygons_.for_each_side_near(b, box_of(polygons_.side(side)), [&](std::size_t other) {
        if (!segments_touch(polygons_.side(side), polygons_.side(other))) return true;
        touching = true;
        return !overlap_where_they_touch(side, other);
      });
    });
    if (!apart) return true;
    return !touching && (polygons_.side_of(b, polygons_.polygons()[a][0]) == PolygonSide::inside ||
                         polygons_.side_of(a, polygons_.polygons()[b][0]) == PolygonSide::inside);
  }

  bool overlap_where_they_touch(std::size_t side, std::size_t other) const {
    const Segment s = polygons_.side(side);
    const Segment t = polygons_.side(other);
    if (segments_cross(s, t)) return true;
    const auto overlap_at = [&](Vec2 p) {
      const Cone c = cone_at(polygons_, side, p);
      const Cone d = cone_at(polygons_, other, p);
      return in_angle(p, d.first, d.last, c.first) || in_angle(p, c.first, c.last, d.first);
    };
    for (const Vec2 p : {s.a, s.b}) {
      if (on_segment(p, t) && overlap_at(p)) return true;
    }
    for (const Vec2 p : {t.a, t.b}) {
      if (on_segment(p, s) && overlap_at(p)) return true;
    }
    return false;
  }

  const PolygonIndex& polygons_;
};

}  // namespace

std::string place_of_polygon(const Scene& scene, std::size_t polygon) {
  const std::size_t line = scene.polygons[polygon].line;
  return line > 0 ? fmt::format("{}:{}", scene.source, line) : fmt::format("{}: polygon {}", scene.source, polygon);
}

void check_polygons(const Scene& scene, const Execution& execution) { checked_parts(scene, execution, false); }

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

std::optional<std::pair<std::size_t, std::size_t>> first_overlap(const PolygonIndex& polygons,
                                                                 const Execution& execution) {
  const OverlapSearch search(polygons);
  const std::size_t count = polygons.polygons().size();
  std::vector<std::optional<std::pair<std::size_t, std::size_t>>> parts(chunk_count(count, grain));
  for_chunks(count, grain, execution, [&](Range range) {
    for (std::size_t i = range.first; i < range.last; ++i) {
      const auto partner = search.partner(i);
      if (!partner) continue;
      parts[range.first / grain] = {i, *partner};
      return;
    }
  });
  for (const auto& part : parts) {
    if (part) return part;
  }
  return std::nullopt;
}

}  // namespace warren
