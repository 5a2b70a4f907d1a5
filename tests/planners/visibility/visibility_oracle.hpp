// SPDX-License-Identifier: BSD-3-Clause
// Visibility by definition, for small integer coordinates, in exact 128-bit arithmetic; shares no predicate with the
// library. The straight way from P to Q is cut where it meets obstacles. Just beyond each such place, a hair to the
// left and a hair to the right, stand two samples; a way runs from sample to sample while the short straight pieces
// between them touch no obstacle. "A hair" is far below every distance that coordinates up to 16 can make: places are
// multiples of 1/600 and further, directions differ by 1/600 or more.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "core/plane/polygon.hpp"

namespace warren::oracle {

__extension__ using Wide = __int128;
constexpr std::int64_t unit = 10'000'000'000'000;  // 1
constexpr std::int64_t ahead = 100'000;            // 1e-8
constexpr std::int64_t aside = 1;                  // 1e-13

struct Point {
  std::int64_t x, y;
  friend auto operator<=>(const Point&, const Point&) = default;
};
struct WidePoint {
  Wide x, y;
};

inline int sign(Wide v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }
inline int turn(WidePoint a, WidePoint b, WidePoint c) {
  return sign((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}
inline bool between(Wide a, Wide b, Wide c) { return std::min(a, b) <= c && c <= std::max(a, b); }
inline bool touch(WidePoint a, WidePoint b, WidePoint c, WidePoint d) {
  const auto on = [](WidePoint p, WidePoint q, WidePoint r) {
    return turn(p, q, r) == 0 && between(p.x, q.x, r.x) && between(p.y, q.y, r.y);
  };
  if (on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b)) return true;
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

/// A place on the way: P + num/den * (Q - P), den > 0.
struct Place {
  std::int64_t num, den;
  friend bool operator<(Place a, Place b) { return a.num * b.den < b.num * a.den; }
  friend bool operator==(Place a, Place b) { return a.num * b.den == b.num * a.den; }
};

struct Vertex {
  Point at;
  int sector;  ///< number among the free ones, anticlockwise from +x
  friend auto operator<=>(const Vertex&, const Vertex&) = default;
};

class Plane {
 public:
  /// extra: further points that ways may begin and end at.
  explicit Plane(const PlaneObstacles& obstacles, std::initializer_list<Vec2> extra = {}) {
    for (std::size_t p = 0; p < obstacles.polygons.size(); ++p) {
      rings_.emplace_back();
      for (const Vec2 c : obstacles.polygons[p]) rings_.back().push_back(point(c));
      add_ring(rings_.back());
    }
    for (const Segment& w : obstacles.walls) {
      if (!(w.a == w.b)) segments_.push_back({point(w.a), point(w.b)});
    }
    for (const auto& [a, b] : segments_) corners_.insert({a, b});
    for (const Vec2 p : extra) corners_.insert(point(p));
    if (obstacles.bounds) {
      const Box b = *obstacles.bounds;
      frame_ = {point(b.min), point({b.max.x, b.min.y}), point(b.max), point({b.min.x, b.max.y})};
      add_ring(frame_);
    }
    for (const Point p : corners_) {
      const std::vector<Point> spokes = spokes_at(p);
      int free = 0;
      if (spokes.empty()) sector_numbers_[p].push_back(is_free(scaled(p, {0, 1}, {1, 0}, ahead, aside), 1) ? 0 : -1);
      for (const Point d : spokes) {
        sector_numbers_[p].push_back(is_free(scaled(p, {0, 1}, d, ahead, aside), 1) ? free++ : -1);
      }
    }
  }

  /// Length of the shortest path; infinite if there is none.
  double shortest(Vec2 start, Vec2 goal) const {
    std::map<Vertex, double> far;
    std::set<std::pair<double, Vertex>> queue;
    for (const Vertex& v : vertices()) {
      if (v.at == point(start)) queue.insert({far[v] = 0.0, v});
    }
    while (!queue.empty()) {
      const auto [length, v] = *queue.begin();
      if (v.at == point(goal)) return length;
      queue.erase(queue.begin());
      for (const Point q : corners_) {
        for (const auto& [from, to] : ways(v.at, q)) {
          const Vertex w{q, to};
          const double through = length + std::hypot(q.x - v.at.x, q.y - v.at.y);
          const auto known = far.find(w);
          if (from != v.sector || (known != far.end() && known->second <= through)) continue;
          if (known != far.end()) queue.erase({known->second, w});
          queue.insert({far[w] = through, w});
        }
      }
    }
    return std::numeric_limits<double>::infinity();
  }
  /// Strictly inside of a polygon, or outside of the bounds.
  bool is_blocked(Vec2 at) const {
    const Point p = point(at);
    const auto on_ring = [&](const std::vector<Point>& ring) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        if (touch(scaled(p, 1), scaled(p, 1), scaled(ring[i], 1), scaled(ring[(i + 1) % ring.size()], 1))) return true;
      }
      return false;
    };
    if (!frame_.empty() && !on_ring(frame_) && !inside(frame_, scaled(p, 1), 1)) return true;
    return std::any_of(rings_.begin(), rings_.end(),
                       [&](const auto& ring) { return !on_ring(ring) && inside(ring, scaled(p, 1), 1); });
  }

  const std::set<Point>& corners() const { return corners_; }
  std::set<Vertex> vertices() const {
    std::set<Vertex> result;
    for (const auto& [p, numbers] : sector_numbers_) {
      for (const int n : numbers) {
        if (n >= 0) result.insert({p, n});
      }
    }
    return result;
  }

  /// Pairs (sector at p, sector at q) that the straight way joins.
  std::set<std::pair<int, int>> ways(Point p, Point q) const {
    std::set<std::pair<int, int>> result;
    if (p == q || crosses_something(p, q)) return result;
    const Point d{q.x - p.x, q.y - p.y};
    const std::vector<Place> places = places_on(p, q);
    for (const int first : {1, -1}) {
      std::set<int> sides{first};
      for (std::size_t i = 0; i + 1 < places.size() && !sides.empty(); ++i)
        sides = go_on(p, d, places[i], i == 0, sides);
      for (const int last : sides) {
        const int from = sector_of(p, d, first);
        const int to = sector_of(q, {-d.x, -d.y}, -last);
        if (from >= 0 && to >= 0) result.insert({from, to});
      }
    }
    return result;
  }

 private:
  static Point point(Vec2 v) { return {static_cast<std::int64_t>(v.x), static_cast<std::int64_t>(v.y)}; }

  void add_ring(const std::vector<Point>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) segments_.push_back({ring[i], ring[(i + 1) % ring.size()]});
  }

  /// p + t d, then `forward` along d and `left` to its left, in units of 1 / (t.den * unit).
  static WidePoint scaled(Point p, Place t, Point d, std::int64_t forward, std::int64_t left) {
    const Wide u = unit;
    return {(Wide{p.x} * t.den + Wide{t.num} * d.x) * u + Wide{t.den} * (Wide{forward} * d.x - Wide{left} * d.y),
            (Wide{p.y} * t.den + Wide{t.num} * d.y) * u + Wide{t.den} * (Wide{forward} * d.y + Wide{left} * d.x)};
  }
  static WidePoint scaled(Point p, std::int64_t den) { return {Wide{p.x} * den * unit, Wide{p.y} * den * unit}; }

  bool inside(const std::vector<Point>& ring, WidePoint at, std::int64_t den) const {
    bool in = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const WidePoint a = scaled(ring[i], den);
      const WidePoint b = scaled(ring[(i + 1) % ring.size()], den);
      if ((a.y <= at.y) == (b.y <= at.y)) continue;
      if ((turn(a, b, at) > 0) == (a.y <= at.y)) in = !in;
    }
    return in;
  }
  bool is_free(WidePoint at, std::int64_t den) const {
    if (!frame_.empty() && !inside(frame_, at, den)) return false;
    return std::none_of(rings_.begin(), rings_.end(), [&](const auto& ring) { return inside(ring, at, den); });
  }
  bool touches_something(WidePoint a, WidePoint b, std::int64_t den) const {
    return std::any_of(segments_.begin(), segments_.end(),
                       [&](const auto& s) { return touch(a, b, scaled(s.first, den), scaled(s.second, den)); });
  }

  static std::int64_t cross(Point d, Point e) { return d.x * e.y - d.y * e.x; }

  bool crosses_something(Point p, Point q) const {
    const auto side = [](Point a, Point b, Point c) {
      return sign(cross({b.x - a.x, b.y - a.y}, {c.x - a.x, c.y - a.y}));
    };
    return std::any_of(segments_.begin(), segments_.end(), [&](const auto& s) {
      return side(p, q, s.first) * side(p, q, s.second) < 0 &&
             side(s.first, s.second, p) * side(s.first, s.second, q) < 0;
    });
  }

  /// Where the way meets obstacles, and its two ends.
  std::vector<Place> places_on(Point p, Point q) const {
    const Point d{q.x - p.x, q.y - p.y};
    std::vector<Place> places{{0, 1}, {1, 1}};
    for (const auto& [a, b] : segments_) {
      const Point e{b.x - a.x, b.y - a.y};
      const std::int64_t den = cross(d, e);
      if (den != 0) {
        const std::int64_t num = cross({a.x - p.x, a.y - p.y}, e);
        places.push_back(den > 0 ? Place{num, den} : Place{-num, -den});
      } else if (cross(d, {a.x - p.x, a.y - p.y}) == 0) {
        for (const Point c : {a, b}) places.push_back({(c.x - p.x) * d.x + (c.y - p.y) * d.y, d.x * d.x + d.y * d.y});
      }
    }
    std::erase_if(places, [](Place t) { return t < Place{0, 1} || Place{1, 1} < t; });
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
  }

  /// From the samples just before the place (none before the first: the sides are those of the first sample itself) to
  /// those just behind it.
  std::set<int> go_on(Point p, Point d, Place t, bool is_first, const std::set<int>& sides) const {
    std::set<int> result;
    for (const int side : sides) {
      const WidePoint behind = scaled(p, t, d, ahead, side * aside);
      if (!is_free(behind, t.den)) continue;
      if (is_first || !touches_something(scaled(p, t, d, -ahead, side * aside), behind, t.den)) result.insert(side);
    }
    if (result.size() == 1) {
      const WidePoint left = scaled(p, t, d, ahead, aside);
      const WidePoint right = scaled(p, t, d, ahead, -aside);
      if (!touches_something(left, right, t.den)) result = {1, -1};
    }
    return result;
  }

  /// Directions of the obstacles at p, anticlockwise from +x.
  std::vector<Point> spokes_at(Point p) const {
    std::vector<Point> spokes;
    for (const auto& [a, b] : segments_) {
      if (cross({b.x - a.x, b.y - a.y}, {p.x - a.x, p.y - a.y}) != 0) continue;
      if (!between(a.x, b.x, p.x) || !between(a.y, b.y, p.y)) continue;
      if (a != p) spokes.push_back({a.x - p.x, a.y - p.y});
      if (b != p) spokes.push_back({b.x - p.x, b.y - p.y});
    }
    std::sort(spokes.begin(), spokes.end(), before);
    const auto same = [](Point d, Point e) { return !before(d, e) && !before(e, d); };
    spokes.erase(std::unique(spokes.begin(), spokes.end(), same), spokes.end());
    return spokes;
  }
  static bool is_low(Point d) { return d.y < 0 || (d.y == 0 && d.x < 0); }
  static bool before(Point d, Point e) { return is_low(d) != is_low(e) ? is_low(e) : cross(d, e) > 0; }

  /// The free sector a hair to the left (side 1) or right (-1) of direction d at p; -1: not free.
  int sector_of(Point p, Point d, int side) const {
    const std::vector<Point> spokes = spokes_at(p);
    const auto n = static_cast<int>(spokes.size());
    int sector = std::max(0, n - 1);
    for (int i = 0; i < n; ++i) {
      const bool passed =
          side > 0 ? !before(d, spokes[static_cast<std::size_t>(i)]) : before(spokes[static_cast<std::size_t>(i)], d);
      if (passed) sector = i;
    }
    return sector_numbers_.at(p)[static_cast<std::size_t>(sector)];
  }

  std::vector<std::vector<Point>> rings_;
  std::vector<Point> frame_;
  std::vector<std::pair<Point, Point>> segments_;
  std::set<Point> corners_;
  std::map<Point, std::vector<int>> sector_numbers_;  // of each sector around a corner: its number among the free ones
};

}  // namespace warren::oracle
