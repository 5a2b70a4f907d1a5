// SPDX-License-Identifier: BSD-3-Clause
#include "solve/steps/obstacle_alone.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <vector>

namespace warren {
namespace {

/// The 17 of "wall 17: ...", after the word "wall ".
std::optional<std::size_t> number_after(std::string_view name, std::string_view word) {
  if (!name.starts_with(word)) return std::nullopt;
  name.remove_prefix(word.size());
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && end != name.data() ? std::optional(number) : std::nullopt;
}

bool is_same_side(const Segment& s, const Segment& t) {
  return (s.a == t.a && s.b == t.b) || (s.a == t.b && s.b == t.a);
}

/// The polygon and those that seams part from it or from one another.
class PiecesOfOne {
 public:
  PiecesOfOne(const Scene& scene, const Execution& execution) : scene_(scene), execution_(execution) {}

  std::vector<ScenePolygon> with(std::size_t first) {
    std::vector<std::size_t> pieces{first};
    std::vector<bool> taken(scene_.polygons.size(), false);
    taken[first] = true;
    for (std::size_t i = 0; i < pieces.size() && !scene_.seams.empty(); ++i) {
      for (const Segment& seam : seams_of(scene_.polygons[pieces[i]])) {
        for (std::size_t k = 0; k < taken.size(); ++k) {
          if (taken[k] || !has(scene_.polygons[k], seam)) continue;
          taken[k] = true;
          pieces.push_back(k);
        }
      }
    }
    std::vector<ScenePolygon> polygons;
    for (const std::size_t i : pieces) polygons.push_back(scene_.polygons[i]);
    return polygons;
  }

 private:
  bool has(const ScenePolygon& polygon, const Segment& side) const {
    execution_.check();
    const std::vector<Vec2>& corners = polygon.corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (is_same_side({corners[i], corners[(i + 1) % corners.size()]}, side)) return true;
    }
    return false;
  }
  std::vector<Segment> seams_of(const ScenePolygon& polygon) const {
    std::vector<Segment> seams;
    for (const Segment& seam : scene_.seams) {
      if (has(polygon, seam)) seams.push_back(seam);
    }
    return seams;
  }

  const Scene& scene_;
  const Execution& execution_;
};

}  // namespace

std::optional<Scene> obstacle_alone(const Scene& scene, std::string_view name, double room,
                                    const Execution& execution) {
  if (name.starts_with("cell ")) return scene;
  Scene alone;
  if (name.starts_with("bounds: ") && scene.bounds) {
    alone.bounds = scene.bounds;
    return alone;
  }
  Box box;
  if (const auto wall = number_after(name, "wall "); wall && *wall < scene.walls.size()) {
    const Segment segment = scene.walls.segment(*wall);
    alone.walls = WallSet::narrowest(std::vector{segment});
    box = box_of(segment);
  } else if (const auto polygon = number_after(name, "polygon "); polygon && *polygon < scene.polygons.size()) {
    alone.polygons = PiecesOfOne(scene, execution).with(*polygon);
    for (const ScenePolygon& piece : alone.polygons) {
      for (const Vec2 corner : piece.corners) box.include(corner);
    }
  } else {
    return std::nullopt;
  }
  alone.bounds = box.grown(box.width() + box.height() + room);
  return alone;
}

}  // namespace warren
