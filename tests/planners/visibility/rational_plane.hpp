// SPDX-License-Identifier: BSD-3-Clause
// Visibility by definition for any doubles, in exact rationals: all coordinates over one common denominator, a power of
// two, so that only numerators of any length are left. Shares no predicate with the library.
//
// A straight way that crosses no side or wall inside both meets obstacles at their ends alone. Between two such places
// its middle tells all: does the way run along something, and is it free on its left and on its right? At such a place
// the sides and walls that meet there cut the plane around it into sectors, and the way goes on in the sector in which
// it came. All pairs against all segments, O(n^3): for worlds of some thirty corners.
#pragma once

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/plane/polygon.hpp"

namespace warren::rational {

using Integer =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<512>, boost::multiprecision::et_off>;

/// Numerators over the plane's common denominator.
struct Point {
  Integer x, y;
  friend bool operator==(const Point&, const Point&) = default;
};
inline Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
inline int sign(const Integer& v) { return v.sign(); }
inline int turn(const Point& d, const Point& e) { return sign(d.x * e.y - d.y * e.x); }
inline int turn(const Point& a, const Point& b, const Point& c) { return turn(b - a, c - a); }

/// A corner, and the number of one free sector around it, anticlockwise from +x.
struct Vertex {
  double x, y;
  int sector;
  friend auto operator<=>(const Vertex&, const Vertex&) = default;
};

class Plane {
 public:
  /// extra: further points that ways may begin and end at.
  explicit Plane(const PlaneObstacles& obstacles, std::initializer_list<Vec2> extra = {}) : obstacles_(obstacles) {
    find_denominator(extra);
    for (std::size_t p = 0; p < obstacles.polygons.size(); ++p) {
      const auto ring = obstacles.polygons[p];
      for (std::size_t i = 0; i < ring.size(); ++i) add_side(ring[i], ring[(i + 1) % ring.size()], p);
    }
    for (const Segment& w : obstacles.walls) {
      if (!(w.a == w.b)) add_side(w.a, w.b, wall);
    }
    for (const Side& s : sides_) {
      corners_.insert(key(s.as_given.a));
      corners_.insert(key(s.as_given.b));
    }
    for (const Vec2 p : extra) corners_.insert(key(p));
    if (obstacles.bounds) {
      const Box& b = *obstacles.bounds;
      const Vec2 ring[] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
      for (std::size_t i = 0; i < 4; ++i) add_side(ring[i], ring[(i + 1) % 4], frame);
    }
    for (const auto& c : corners_) around_.emplace(c, look_around(at({c.first, c.second})));
  }

  std::set<Vertex> vertices() const {
    std::set<Vertex> result;
    for (const auto& [c, around] : around_) {
      for (const int n : around.numbers) {
        if (n >= 0) result.insert({c.first, c.second, n});
      }
    }
    return result;
  }

  /// All pairs of vertices, both ways round, that a straight way joins.
  std::set<std::pair<Vertex, Vertex>> edges() const {
    std::set<std::pair<Vertex, Vertex>> result;
    for (auto p = corners_.begin(); p != corners_.end(); ++p) {
      for (auto q = std::next(p); q != corners_.end(); ++q) {
        for (const auto& [i, j] : ways({p->first, p->second}, {q->first, q->second})) {
          result.insert({{p->first, p->second, i}, {q->first, q->second, j}});
          result.insert({{q->first, q->second, j}, {p->first, p->second, i}});
        }
      }
    }
    return result;
  }

  /// Length of the shortest path; infinite if there is none. `all` is edges().
  static double shortest(const std::set<std::pair<Vertex, Vertex>>& all, Vec2 start, Vec2 goal) {
    std::map<Vertex, double> far;
    std::set<std::pair<double, Vertex>> queue;
    const double least = -std::numeric_limits<double>::infinity();
    for (auto e = all.lower_bound({{start.x, start.y, 0}, {least, least, 0}}); e != all.end(); ++e) {
      if (e->first.x != start.x || e->first.y != start.y) break;
      queue.insert({far[e->first] = 0.0, e->first});
    }
    while (!queue.empty()) {
      const auto [length, v] = *queue.begin();
      if (v.x == goal.x && v.y == goal.y) return length;
      queue.erase(queue.begin());
      for (auto e = all.lower_bound({v, {least, least, 0}}); e != all.end() && e->first == v; ++e) {
        const double through = length + std::hypot(e->second.x - v.x, e->second.y - v.y);
        const auto known = far.find(e->second);
        if (known != far.end() && known->second <= through) continue;
        if (known != far.end()) queue.erase({known->second, e->second});
        queue.insert({far[e->second] = through, e->second});
      }
    }
    return std::numeric_limits<double>::infinity();
  }

  /// Strictly inside of a polygon, or outside of the bounds.
  bool is_blocked(Vec2 v) const {
    const Point p = at(v);
    const Point up{0, 1};
    for (std::size_t owner = 0; owner <= obstacles_.polygons.size(); ++owner) {
      const std::size_t o = owner == obstacles_.polygons.size() ? frame : owner;
      if (o == frame && !obstacles_.bounds) continue;
      const bool on_it =
          std::any_of(sides_.begin(), sides_.end(), [&](const Side& s) { return s.owner == o && holds(s, p); });
      if (!on_it && inside(o, p, up) != (o == frame)) return true;
    }
    return false;
  }

  /// Do two sides or walls cross inside both (the bounds' sides too), or do polygons share more than their outlines?
  bool has_overlaps() const {
    for (const Side& s : sides_) {
      for (const Side& t : sides_) {
        if (turn(s.a, s.b, t.a) * turn(s.a, s.b, t.b) < 0 && turn(t.a, t.b, s.a) * turn(t.a, t.b, s.b) < 0) return true;
      }
      if (s.owner < obstacles_.polygons.size() && runs_through_another(s)) return true;
    }
    return false;
  }

 private:
  using Key = std::pair<double, double>;
  static constexpr std::size_t wall = static_cast<std::size_t>(-1);
  static constexpr std::size_t frame = static_cast<std::size_t>(-2);

  struct Side {
    Point a, b;
    Segment as_given;
    std::size_t owner;  ///< polygon's number, wall or frame
  };
  /// What meets at a corner.
  struct Around {
    std::vector<Point> spokes;  ///< different directions, anticlockwise from +x
    std::vector<int>
        numbers;  ///< of the sector behind each spoke (or of the only one) among the free ones; -1: not free
  };

  static Key key(Vec2 p) { return {p.x + 0.0, p.y + 0.0}; }  // no minus zero

  void find_denominator(std::initializer_list<Vec2> extra) {
    const auto look = [&](double c) {
      int exponent = 0;
      if (c == 0.0) return;
      std::frexp(c, &exponent);
      shift_ = std::max(shift_, 54 - exponent);  // one more than needed: middles are whole numbers too
    };
    const auto look_at = [&](Vec2 p) {
      look(p.x);
      look(p.y);
    };
    for (const Vec2 p : obstacles_.polygons.corners) look_at(p);
    for (const Segment& w : obstacles_.walls) look_at(w.a), look_at(w.b);
    if (obstacles_.bounds) look_at(obstacles_.bounds->min), look_at(obstacles_.bounds->max);
    for (const Vec2 p : extra) look_at(p);
  }
  Integer scaled(double c) const {
    int exponent = 0;
    const double fraction = std::frexp(c, &exponent);
    const Integer mantissa(static_cast<std::int64_t>(std::ldexp(fraction, 53)));
    return mantissa << static_cast<unsigned>(c == 0.0 ? 0 : exponent - 53 + shift_);
  }
  Point at(Vec2 p) const { return {scaled(p.x), scaled(p.y)}; }
  void add_side(Vec2 a, Vec2 b, std::size_t owner) { sides_.push_back({at(a), at(b), {a, b}, owner}); }

  static bool between(const Integer& a, const Integer& b, const Integer& c) {
    return a <= b ? a <= c && c <= b : b <= c && c <= a;
  }
  static bool holds(const Side& s, const Point& p) {
    return between(s.a.x, s.b.x, p.x) && between(s.a.y, s.b.y, p.y) && turn(s.a, s.b, p) == 0;
  }

  /// Is the point a hair away from p towards `aside`, a direction of no side at p, inside of the ring? By the ray on.
  bool inside(std::size_t owner, const Point& p, const Point& aside) const {
    bool in = false;
    for (const Side& s : sides_) {
      if (s.owner != owner) continue;
      const bool a_right = turn(aside, s.a - p) <= 0;
      if (a_right == (turn(aside, s.b - p) <= 0)) continue;
      const int side = turn(s.a, s.b, p);
      if (side != 0 && (side > 0) == a_right) in = !in;
    }
    return in;
  }
  bool is_free(const Point& p, const Point& aside) const {
    if (obstacles_.bounds && !inside(frame, p, aside)) return false;
    for (std::size_t o = 0; o < obstacles_.polygons.size(); ++o) {
      if (inside(o, p, aside)) return false;
    }
    return true;
  }

  /// Is the inside of a polygon, somewhere along its side, another one's too? No side crosses another.
  bool runs_through_another(const Side& s) const {
    const Point d = s.b - s.a;
    std::vector<Point> places{s.a, s.b};
    for (const Side& other : sides_) {
      for (const Point& p : {other.a, other.b}) {
        if (holds(s, p)) places.push_back(p);
      }
    }
    std::sort(places.begin(), places.end(), [&](const Point& p, const Point& q) {
      return (p.x - s.a.x) * d.x + (p.y - s.a.y) * d.y < (q.x - s.a.x) * d.x + (q.y - s.a.y) * d.y;
    });
    for (std::size_t i = 1; i < places.size(); ++i) {
      if (places[i] == places[i - 1]) continue;
      const Point middle{(places[i].x + places[i - 1].x) / 2, (places[i].y + places[i - 1].y) / 2};
      int depth = 0;
      for (std::size_t o = 0; o < obstacles_.polygons.size(); ++o) depth += inside(o, middle, left_of(d)) ? 1 : 0;
      if (depth > 1) return true;
    }
    return false;
  }

  static bool is_low(const Point& d) { return d.y < 0 || (d.y == 0 && d.x < 0); }
  static bool before(const Point& d, const Point& e) { return is_low(d) != is_low(e) ? is_low(e) : turn(d, e) > 0; }
  static Point left_of(const Point& d) { return {-d.y, d.x}; }

  Around look_around(const Point& p) const {
    Around around;
    for (const Side& s : sides_) {
      if (!holds(s, p)) continue;
      if (!(s.a == p)) around.spokes.push_back(s.a - p);
      if (!(s.b == p)) around.spokes.push_back(s.b - p);
    }
    std::vector<Point>& spokes = around.spokes;
    std::sort(spokes.begin(), spokes.end(), before);
    const auto same = [](const Point& d, const Point& e) { return !before(d, e) && !before(e, d); };
    spokes.erase(std::unique(spokes.begin(), spokes.end(), same), spokes.end());
    int free = 0;
    if (spokes.empty()) around.numbers.push_back(is_free(p, {1, 0}) ? 0 : -1);
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      const Point& first = spokes[i];
      const Point& last = spokes[(i + 1) % spokes.size()];
      const Point inner = turn(first, last) > 0 ? first + last : left_of(first);
      around.numbers.push_back(is_free(p, inner) ? free++ : -1);
    }
    return around;
  }
  /// The sector a hair to the left (or to the right) of direction d; its place in `numbers`.
  static std::size_t sector_beside(const Around& around, const Point& d, bool left) {
    const std::vector<Point>& spokes = around.spokes;
    std::size_t sector = spokes.empty() ? 0 : spokes.size() - 1;
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      if (left ? !before(d, spokes[i]) : before(spokes[i], d)) sector = i;
    }
    return sector;
  }

  /// Pairs (free sector at p, free sector at q) that the straight way joins.
  std::set<std::pair<int, int>> ways(Vec2 from, Vec2 to) const {
    std::set<std::pair<int, int>> result;
    const Point p = at(from);
    const Point q = at(to);
    const Point d = q - p;
    std::vector<std::pair<Integer, Key>> places;  // how far along, what is there
    for (const Side& s : sides_) {
      if (apart(s.as_given, from, to)) continue;
      const int a = turn(p, q, s.a);
      const int b = turn(p, q, s.b);
      if (a * b < 0 && turn(s.a, s.b, p) * turn(s.a, s.b, q) < 0) return result;
      if (a == 0) note(s.a, s.as_given.a, p, q, places);
      if (b == 0) note(s.b, s.as_given.b, p, q, places);
    }
    note(p, from, p, q, places);
    note(q, to, p, q, places);
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    const auto n = places.size();
    for (const bool first_left : {true, false}) {
      bool left = first_left;
      bool right = !first_left;
      for (std::size_t i = 0; i + 1 < n && (left || right); ++i) {
        if (i > 0) pass(around_at(places[i].second), d, left, right);
        const Point here = at({places[i].second.first, places[i].second.second});
        const Point next = at({places[i + 1].second.first, places[i + 1].second.second});
        run_along({(here.x + next.x) / 2, (here.y + next.y) / 2}, d, left, right);
      }
      const auto end_in = [&](bool last_left) {
        const Around& start = around_.at(key(from));
        const Around& end = around_.at(key(to));
        const int i = start.numbers[sector_beside(start, d, first_left)];
        const int j = end.numbers[sector_beside(end, p - q, !last_left)];
        if (i >= 0 && j >= 0) result.insert({i, j});
      };
      if (left) end_in(true);
      if (right) end_in(false);
    }
    return result;
  }

  static bool apart(const Segment& s, Vec2 p, Vec2 q) {
    return std::max(s.a.x, s.b.x) < std::min(p.x, q.x) || std::max(p.x, q.x) < std::min(s.a.x, s.b.x) ||
           std::max(s.a.y, s.b.y) < std::min(p.y, q.y) || std::max(p.y, q.y) < std::min(s.a.y, s.b.y);
  }
  static void note(const Point& v, Vec2 as_given, const Point& p, const Point& q,
                   std::vector<std::pair<Integer, Key>>& places) {
    if (!between(p.x, q.x, v.x) || !between(p.y, q.y, v.y)) return;
    places.emplace_back((v.x - p.x) * (q.x - p.x) + (v.y - p.y) * (q.y - p.y), key(as_given));
  }
  /// A corner of the bounds is no corner that ways begin at.
  Around around_at(const Key& corner) const {
    const auto known = around_.find(corner);
    return known != around_.end() ? known->second : look_around(at({corner.first, corner.second}));
  }
  /// Which lanes of the way along d go on behind a place where obstacles meet.
  static void pass(const Around& around, const Point& d, bool& left, bool& right) {
    const Point back{-d.x, -d.y};
    const std::size_t in_left = sector_beside(around, back, false);  // looking back, the left lane lies on the right
    const std::size_t in_right = sector_beside(around, back, true);
    const std::size_t out_left = sector_beside(around, d, true);
    const std::size_t out_right = sector_beside(around, d, false);
    const bool to_left = (left && in_left == out_left) || (right && in_right == out_left);
    const bool to_right = (left && in_left == out_right) || (right && in_right == out_right);
    left = to_left;
    right = to_right;
  }
  /// Which lanes are open on a stretch of the way along d with this middle, on which nothing ends.
  void run_along(const Point& middle, const Point& d, bool& left, bool& right) const {
    const bool split = std::any_of(sides_.begin(), sides_.end(), [&](const Side& s) { return holds(s, middle); });
    if (!split) left = right = left || right;
    left = left && is_free(middle, left_of(d));
    right = right && is_free(middle, {d.y, -d.x});
  }

  const PlaneObstacles& obstacles_;
  int shift_ = 0;
  std::vector<Side> sides_;
  std::set<Key> corners_;
  std::map<Key, Around> around_;
};

}  // namespace warren::rational
