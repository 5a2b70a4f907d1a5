// SPDX-License-Identifier: BSD-3-Clause
// Worlds of polygons and walls for tests: random ones with many equal coordinates, and what a judge makes of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/rng.hpp"
#include "core/base/solution.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren::test {

/// Numbers in a row from one seed.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(seed) {}
  /// 0 .. below - 1.
  int roll(int below) { return static_cast<int>(uniform(seed_, count_++, 0) * below); }
  double real() { return uniform(seed_, count_++, 0); }

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

inline Scene scene_of(const PlaneObstacles& obstacles) {
  Scene scene;
  scene.walls = WallSet::narrowest(obstacles.walls);
  for (std::size_t p = 0; p < obstacles.polygons.size(); ++p) {
    const auto corners = obstacles.polygons[p];
    scene.polygons.push_back({{corners.begin(), corners.end()}, 0});
  }
  scene.bounds = obstacles.bounds;
  return scene;
}

inline PlaneObstacles obstacles_of(const Scene& scene) {
  PlaneObstacles obstacles;
  for (const ScenePolygon& polygon : scene.polygons) {
    std::vector<Vec2> corners = polygon.corners;
    double doubled_area = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i)
      doubled_area += cross(corners[i], corners[(i + 1) % corners.size()]);
    if (doubled_area < 0.0) std::reverse(corners.begin(), corners.end());
    obstacles.polygons.add(corners);
  }
  for (std::size_t i = 0; i < scene.walls.size(); ++i) obstacles.walls.push_back(scene.walls.segment(i));
  obstacles.bounds = scene.bounds;
  return obstacles;
}

/// The world that a path is judged in. Planners may roam where there is nothing at all, which judges refuse: there it
/// gets bounds far around the path.
inline Scene scene_around(const PlaneObstacles& obstacles, const Path<Vec2>& path) {
  Scene scene = scene_of(obstacles);
  if (scene.walls.size() > 0 || !scene.polygons.empty() || scene.bounds) return scene;
  Box box;
  for (const Vec2 p : path) box.include(p);
  scene.bounds = box.grown(1.0 + box.width() + box.height());
  return scene;
}

/// The judge's word for a point's path that may touch.
inline Verification judged(const PlaneObstacles& obstacles, const Path<Vec2>& path) {
  return verify_path(scene_around(obstacles, path), path, {.contact = Contact::allowed}, {});
}

inline double length_of(const Path<Vec2>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += distance(path[i - 1], path[i]);
  return length;
}

/// 0 without a path.
inline double length_of(const Solution<Vec2>& solution) { return length_of(solution.path); }

/// A star around `center` with integer corners within `reach`, anticlockwise; empty where the dice gave none.
inline std::vector<Vec2> star(Dice& dice, Vec2 center, int reach) {
  std::vector<Vec2> corners;
  const int count = 3 + dice.roll(6);
  for (int i = 0; i < count; ++i) {
    const Vec2 arm{static_cast<double>(dice.roll(2 * reach + 1) - reach),
                   static_cast<double>(dice.roll(2 * reach + 1) - reach)};
    if (!(arm == Vec2{})) corners.push_back(arm);
  }
  const auto upper = [](Vec2 p) { return p.y > 0.0 || (p.y == 0.0 && p.x > 0.0); };
  const auto same = [](Vec2 p, Vec2 q) { return cross(p, q) == 0.0 && dot(p, q) > 0.0; };
  std::stable_sort(corners.begin(), corners.end(),
                   [&](Vec2 p, Vec2 q) { return upper(p) != upper(q) ? upper(p) : cross(p, q) > 0.0; });
  corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
  const std::size_t n = corners.size();
  if (n < 3) return {};
  for (std::size_t i = 0; i < n; ++i) {  // every two neighbours less than half a turn apart: the center is inside
    if (cross(corners[i], corners[(i + 1) % n]) <= 0.0) return {};
  }
  for (Vec2& p : corners) p = center + p;
  return corners;
}

/// A bracket, open to the right or to the top, that encloses the box from all other sides; anticlockwise.
inline std::vector<Vec2> bracket(Dice& dice, const Box& box, double thickness) {
  const Box o = box.grown(thickness);
  if (dice.roll(2) == 0) {
    return {o.min, {o.max.x, o.min.y}, {o.max.x, box.min.y}, box.min, {box.min.x, box.max.y}, {o.max.x, box.max.y},
            o.max, {o.min.x, o.max.y}};
  }
  return {o.min,
          {o.max.x, o.min.y},
          o.max,
          {box.max.x, o.max.y},
          {box.max.x, box.min.y},
          box.min,
          {box.min.x, o.max.y},
          {o.min.x, o.max.y}};
}

/// Disjoint simple polygons with integer corners strictly inside the bounds, in any places of a lattice: stars, and
/// stars in brackets. Many corners share their x.
inline PlaneObstacles disjoint_polygons(std::uint64_t seed, int side = 4) {
  Dice dice(seed);
  PlaneObstacles obstacles;
  constexpr int pitch = 24;
  for (int row = 0; row < side; ++row) {
    for (int col = 0; col < side; ++col) {
      if (dice.roll(5) == 0) continue;
      const Vec2 center{static_cast<double>(pitch * col), static_cast<double>(pitch * row)};
      const bool in_bracket = dice.roll(3) == 0;
      const std::vector<Vec2> corners = star(dice, center, in_bracket ? 5 : 11);
      if (!corners.empty()) obstacles.polygons.add(corners);
      if (in_bracket) obstacles.polygons.add(bracket(dice, Box{center, center}.grown(8.0), 3.0));
    }
  }
  const double far = pitch * (side - 1) + 12.0;
  obstacles.bounds = Box{{-12.0, -12.0}, {far, far}};
  return obstacles;
}

/// Walls on the lines of a unit grid of `side` squares each way, some of them several units long, and blocks of whole
/// squares as polygons. Everything touches everything, nothing crosses. Who may go from square to square is simple.
class PolygonsInCells {
 public:
  PolygonsInCells(std::uint64_t seed, int side, bool bounded) : side_(side), dice_(seed) {
    right_shut_.assign(square_count(), 0);
    top_shut_.assign(square_count(), 0);
    full_.assign(square_count(), 0);
    add_blocks();
    add_walls();
    const auto far = static_cast<double>(side);
    const Box box{{0.0, 0.0}, {far, far}};
    if (bounded) {
      obstacles_.bounds = box;
    } else {  // an outline, behind which nobody gets
      obstacles_.walls.push_back({box.min, {far, 0.0}});
      obstacles_.walls.push_back({{0.0, far}, box.max});
      obstacles_.walls.push_back({box.min, {0.0, far}});
      obstacles_.walls.push_back({{far, 0.0}, box.max});
    }
  }

  const PlaneObstacles& obstacles() const { return obstacles_; }
  int side() const { return side_; }
  bool is_full(int x, int y) const { return full_[square(x, y)] != 0; }
  /// The number of the region of each square; full ones have their own.
  std::vector<int> regions() const {
    std::vector<int> region(square_count());
    for (std::size_t i = 0; i < region.size(); ++i) region[i] = static_cast<int>(i);
    for (bool changed = true; changed;) {
      changed = false;
      const auto join = [&](std::size_t a, std::size_t b) {
        const int least = std::min(region[a], region[b]);
        changed = changed || region[a] != least || region[b] != least;
        region[a] = region[b] = least;
      };
      for (int y = 0; y < side_; ++y) {
        for (int x = 0; x < side_; ++x) {
          if (x + 1 < side_ && right_open(x, y)) join(square(x, y), square(x + 1, y));
          if (y + 1 < side_ && top_open(x, y)) join(square(x, y), square(x, y + 1));
        }
      }
    }
    return region;
  }
  std::size_t square(int x, int y) const { return static_cast<std::size_t>(y * side_ + x); }

 private:
  std::size_t square_count() const { return static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_); }
  bool right_open(int x, int y) const {
    return right_shut_[square(x, y)] == 0 && full_[square(x, y)] == 0 && full_[square(x + 1, y)] == 0;
  }
  bool top_open(int x, int y) const {
    return top_shut_[square(x, y)] == 0 && full_[square(x, y)] == 0 && full_[square(x, y + 1)] == 0;
  }

  void add_blocks() {
    for (int i = 0; i < side_; ++i) {
      const int w = 1 + dice_.roll(2);
      const int h = 1 + dice_.roll(3);
      const int x0 = dice_.roll(side_ - w + 1);
      const int y0 = dice_.roll(side_ - h + 1);
      bool fits = true;
      for (int y = y0; y < y0 + h; ++y) {
        for (int x = x0; x < x0 + w; ++x) fits = fits && !is_full(x, y);
      }
      if (!fits) continue;
      for (int y = y0; y < y0 + h; ++y) {
        for (int x = x0; x < x0 + w; ++x) full_[square(x, y)] = 1;
      }
      const auto at = [](int x, int y) { return Vec2{static_cast<double>(x), static_cast<double>(y)}; };
      obstacles_.polygons.add(std::array{at(x0, y0), at(x0 + w, y0), at(x0 + w, y0 + h), at(x0, y0 + h)});
    }
  }

  /// Unit walls, joined into longer ones at some places, of which each lets walls pass in one direction only, so that
  /// none cross. Some stand twice.
  void add_walls() {
    const double share = 0.2 + 0.3 * dice_.real();
    for (std::size_t i = 0; i < square_count(); ++i) {
      right_shut_[i] = dice_.real() < share ? 1 : 0;
      top_shut_[i] = dice_.real() < share ? 1 : 0;
    }
    std::vector<int> passes(square_count());  // the grid point at the upper right of the square
    for (int& p : passes) p = dice_.roll(3);
    for (int line = 0; line + 1 < side_; ++line) {
      add_line(
          line, [&](int i) { return right_shut_[square(line, i)] != 0; },
          [&](int i) { return passes[square(line, i)] == 1 && is_lonely(line, i); },
          [](double along, double across) {
            return Vec2{across, along};
          });
      add_line(
          line, [&](int i) { return top_shut_[square(i, line)] != 0; },
          [&](int i) { return passes[square(i, line)] == 2 && is_lonely(i, line); },
          [](double along, double across) {
            return Vec2{along, across};
          });
    }
  }
  /// Is no polygon near the upper right corner of the square?
  bool is_lonely(int x, int y) const {
    return x + 1 < side_ && y + 1 < side_ && !is_full(x, y) && !is_full(x + 1, y) && !is_full(x, y + 1) &&
           !is_full(x + 1, y + 1);
  }
  template <class Shut, class Joins, class At>
  void add_line(int line, const Shut& shut, const Joins& joins, const At& at) {
    for (int i = 0; i < side_; ++i) {
      if (!shut(i)) continue;
      int last = i;
      while (last + 1 < side_ && shut(last + 1) && joins(last)) ++last;
      const Segment wall{at(i, line + 1.0), at(last + 1.0, line + 1.0)};
      obstacles_.walls.push_back(dice_.roll(2) == 0 ? wall : Segment{wall.b, wall.a});
      if (dice_.roll(10) == 0) obstacles_.walls.push_back(wall);
      i = last;
    }
  }

  int side_;
  Dice dice_;
  PlaneObstacles obstacles_;
  std::vector<char> right_shut_, top_shut_, full_;
};

}  // namespace warren::test
