// SPDX-License-Identifier: BSD-3-Clause
// A second judge of all that turns, which shares nothing with verify/: how much room there is in the middle of a piece
// of a leg, and how far anything goes in half of it, bound the room on the whole piece; what that leaves open is
// halved. Numbers are long doubles; what their rounding, or that of the judges, might decide is told as unsure.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "core/plane/se2.hpp"
#include "scenes/scene/scene.hpp"

namespace warren::test {

using Real = long double;

enum class Bounded : std::uint8_t { free, met, unsure };

/// room_at(t): at the share t of the leg, beyond what is needed. way: how far anything goes on the leg, at most.
template <class RoomAt>
Bounded bounded(const RoomAt& room_at, Real way, Real unsure, Real middle = 0.5L, Real half = 0.5L) {
  constexpr Real finest = 1.0L / 8192.0L;
  const Real room = room_at(middle);
  if (room < -unsure || (half == 0.5L && std::min(room_at(0.0L), room_at(1.0L)) < -unsure)) return Bounded::met;
  if (room - way * half > unsure) return Bounded::free;
  if (half < finest) return Bounded::unsure;
  const Bounded first = bounded(room_at, way, unsure, middle - 0.5L * half, 0.5L * half);
  if (first == Bounded::met) return first;
  const Bounded second = bounded(room_at, way, unsure, middle + 0.5L * half, 0.5L * half);
  return second == Bounded::met ? second : std::max(first, second);
}

struct Place {
  Real x = 0.0L, y = 0.0L;
  friend Place operator-(Place a, Place b) { return {a.x - b.x, a.y - b.y}; }
  friend Place operator+(Place a, Place b) { return {a.x + b.x, a.y + b.y}; }
  friend Place operator*(Real s, Place a) { return {s * a.x, s * a.y}; }
};
inline Place place_of(Vec2 p) { return {p.x, p.y}; }
inline Real inner(Place a, Place b) { return a.x * b.x + a.y * b.y; }
inline Real outer(Place a, Place b) { return a.x * b.y - a.y * b.x; }
inline Place turned(Place p, Real angle) {
  const Real s = std::sin(angle), c = std::cos(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}
inline Real apart(Place p, Place a, Place b) {
  const Place along = b - a;
  const Real square = inner(along, along);
  const Real t = square > 0.0L ? std::clamp(inner(p - a, along) / square, 0.0L, 1.0L) : 0.0L;
  const Place off = p - (a + t * along);
  return std::hypot(off.x, off.y);
}

/// A point, or a convex polygon, anticlockwise, and what it keeps around it, among sides, within a box.
struct PlaneJudge {
  std::vector<Vec2> outline;
  Real needed = 0.0L;
  std::vector<Segment> sides{};
  Box bounds{};
  std::vector<Box> blocked{};  // whole boxes, whose sides are among the sides
  Real unsure = 0.0L;

  Real room(Place at, Real heading) const {
    std::vector<Place> corners;
    for (const Vec2 p : outline) corners.push_back(at + turned(place_of(p), heading));
    Real least = 1e30L;
    for (const Place c : corners) {
      least = std::min({least, c.x - bounds.min.x, bounds.max.x - c.x, c.y - bounds.min.y, bounds.max.y - c.y});
    }
    for (const Segment& s : sides) least = std::min(least, room_to(corners, place_of(s.a), place_of(s.b)));
    const Place c = corners.front();
    for (const Box& box : blocked) {
      const Real depth = std::min({c.x - box.min.x, box.max.x - c.x, c.y - box.min.y, box.max.y - c.y});
      if (depth > 0.0L) least = std::min(least, -depth);
    }
    return least - needed;
  }

 private:
  /// Well below 0 where some of the side is well within the body.
  Real room_to(const std::vector<Place>& corners, Place a, Place b) const {
    Real least = 1e30L;
    Real from = 0.0L, to = 1.0L;  // what of the side lies within
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Place p = corners[i], q = corners[(i + 1) % corners.size()], side = q - p;
      least = std::min({least, apart(p, a, b), apart(a, p, q), apart(b, p, q)});
      const Real size = std::hypot(side.x, side.y);
      const Real first = outer(side, a - p) - 2.0L * unsure * size, last = outer(side, b - p) - 2.0L * unsure * size;
      if (first <= 0.0L && last <= 0.0L) to = -1.0L;
      if (first <= 0.0L && last > 0.0L) from = std::max(from, first / (first - last));
      if (first > 0.0L && last <= 0.0L) to = std::min(to, first / (first - last));
    }
    return corners.size() > 1 && from < to ? -1e30L : least;
  }
};

inline Real turn_of(const Se2& a, const Se2& b) {
  return std::remainder(static_cast<Real>(b.theta) - a.theta, 2.0L * std::numbers::pi_v<Real>);
}

/// A body that goes straight and turns evenly.
inline Bounded bounded_turning(const PlaneJudge& judge, const Se2& a, const Se2& b) {
  const Real turn = turn_of(a, b);
  if (std::abs(turn) > 3.1L) return Bounded::unsure;  // either way may be meant
  Real size = 0.0L;
  for (const Vec2 p : judge.outline) size = std::max(size, std::hypot(static_cast<Real>(p.x), p.y));
  const Place from = place_of(a.position()), way = place_of(b.position()) - from;
  const auto room_at = [&](Real t) { return judge.room(from + t * way, a.theta + t * turn); };
  return bounded(room_at, std::hypot(way.x, way.y) + size * std::abs(turn), judge.unsure);
}

/// A car that keeps its steering: its chord lies along the heading halfway. off: what poses may be off by.
inline Bounded bounded_car(const PlaneJudge& judge, const Se2& a, const Se2& b, Real radius, bool reverses, Real off) {
  const Real turn = turn_of(a, b);
  if (std::abs(turn) > 3.1L) return Bounded::unsure;
  const Place from = place_of(a.position()), chord = place_of(b.position()) - from;
  const Place seen = turned(chord, -(a.theta + 0.5L * turn));
  const Real bend = turn == 0.0L ? 1.0L : 0.5L * turn / std::sin(0.5L * turn);
  const Real length = std::abs(seen.x) * bend;
  const Real short_by = radius * std::abs(turn) - length, back = reverses ? 0.0L : -seen.x;
  const Real wrong = std::max({std::abs(seen.y), short_by, back});
  if (wrong > 2.0L * off) return Bounded::met;
  if (wrong > 0.5L * off) return Bounded::unsure;
  Real size = 0.0L;
  for (const Vec2 p : judge.outline) size = std::max(size, std::hypot(static_cast<Real>(p.x), p.y));
  const auto room_at = [&](Real t) {
    const Real share = turn == 0.0L ? t : std::sin(0.5L * t * turn) / std::sin(0.5L * turn);
    return judge.room(from + share * turned(chord, 0.5L * (t - 1.0L) * turn), a.theta + t * turn);
  };
  return bounded(room_at, length + off + size * std::abs(turn), judge.unsure);
}

using Space = std::array<Real, 3>;
inline Real distance_in_space(const Space& a, const Space& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The arm's origins, the tool's last: each row's screws, one after the other, by what they do to the axes.
inline std::vector<Space> origins_of(const DhTable& table, const std::array<Real, most_joints>& q) {
  Space at{}, x{1.0L, 0.0L, 0.0L}, y{0.0L, 1.0L, 0.0L}, z{0.0L, 0.0L, 1.0L};
  const auto go = [&](const Space& along, Real way) {
    for (std::size_t k = 0; k < 3; ++k) at[k] += way * along[k];
  };
  const auto turn = [](Space& first, Space& second, Real angle) {
    const Real s = std::sin(angle), c = std::cos(angle);
    for (std::size_t k = 0; k < 3; ++k) {
      const Real one = c * first[k] + s * second[k];
      second[k] = c * second[k] - s * first[k];
      first[k] = one;
    }
  };
  std::vector<Space> origins{at};
  for (std::size_t i = 0; i < table.joints.size(); ++i) {
    const DhJoint& joint = table.joints[i];
    const auto along_x = [&] {
      go(x, joint.a);
      turn(y, z, joint.alpha_rad);
    };
    if (table.convention == DhConvention::modified) along_x();
    turn(x, y, q[i] + joint.offset_rad);
    go(z, joint.d);
    if (table.convention == DhConvention::standard) along_x();
    origins.push_back(at);
  }
  const auto tool = table.tool.translation();
  go(x, tool.x());
  go(y, tool.y());
  go(z, tool.z());
  origins.push_back(at);
  return origins;
}

/// The least of a function that is convex on [0, 1].
template <class F>
Real least_of_convex(const F& f) {
  Real low = 0.0L, high = 1.0L;
  for (int i = 0; i < 100; ++i) {
    const Real a = low + (high - low) / 3.0L, b = high - (high - low) / 3.0L;
    (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
  }
  return f(0.5L * (low + high));
}

/// Among spheres and boxes; links may touch each other.
inline Bounded bounded_arm(const Scene& scene, const DhTable& table, Real radius, const JointState& a,
                           const JointState& b, Real tolerance) {
  Real reach = table.tool.translation().norm(), turns = 0.0L, beyond = -1.0L;
  for (std::size_t j = 0; j < table.joints.size(); ++j) {
    const DhJoint& joint = table.joints[j];
    reach += std::hypot(joint.a, joint.d);
    turns += std::abs(static_cast<Real>(b[j]) - a[j]);
    for (const double q : {a[j], b[j]}) beyond = std::max({beyond, joint.low_rad - Real{q}, q - Real{joint.high_rad}});
  }
  if (beyond > 2.0L * tolerance) return Bounded::met;
  if (beyond > 0.5L * tolerance) return Bounded::unsure;
  const auto room_at = [&](Real t) {
    std::array<Real, most_joints> q{};
    for (std::size_t j = 0; j < q.size(); ++j) q[j] = a[j] + t * (static_cast<Real>(b[j]) - a[j]);
    const std::vector<Space> at = origins_of(table, q);
    Real least = 1e30L;
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      const auto on_link = [&](Real s) {
        Space p = at[i];
        for (std::size_t k = 0; k < 3; ++k) p[k] += s * (at[i + 1][k] - at[i][k]);
        return p;
      };
      for (const Sphere& ball : scene.spheres) {
        const auto off = [&](Real s) { return distance_in_space(on_link(s), {ball.x, ball.y, ball.z}); };
        least = std::min(least, least_of_convex(off) - ball.radius - radius);
      }
      for (const SolidBox& box : scene.boxes) {
        const auto off = [&](Real s) {
          const Space p = on_link(s);
          Space nearest = p;
          for (std::size_t k = 0; k < 3; ++k) nearest[k] = std::clamp<Real>(p[k], box.low[k], box.high[k]);
          return distance_in_space(p, nearest);
        };
        least = std::min(least, least_of_convex(off) - radius);
      }
    }
    return least;
  };
  return bounded(room_at, turns * reach, 2e-6L * reach);  // so much the judge of arms may ask for beyond what is needed
}

}  // namespace warren::test
