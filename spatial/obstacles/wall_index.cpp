// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/obstacles/wall_index.hpp"

#include <algorithm>
#include <array>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "spatial/obstacles/motion_bunch.hpp"
#include "spatial/obstacles/wall_grid_builder.hpp"

namespace warren {
namespace {

bool fits_float(std::span<const Segment> segments) {
  return WallSet::narrowest(segments).visit(
      []<class Wall>(std::span<const Wall>) { return std::is_same_v<typename Wall::Number, float>; });
}

template <class T>
WallOf<T> wall_of(const Segment& s) {
  return {static_cast<T>(s.a.x), static_cast<T>(s.a.y), static_cast<T>(s.b.x), static_cast<T>(s.b.y)};
}

/// Are all points of s farther than r from p, or just r? Squared and without a division.
bool keeps(Vec2 p, const Segment& s, double r_sq) noexcept {
  const Vec2 along = s.b - s.a;
  const Vec2 to_p = p - s.a;
  const double length_sq = dot(along, along);
  const double t = dot(to_p, along);
  if (t <= 0.0) return dot(to_p, to_p) >= r_sq;
  if (t >= length_sq) return dot(p - s.b, p - s.b) >= r_sq;
  const double c = cross(along, to_p);
  return c * c >= r_sq * length_sq;
}

/// WallIndex::keep_clearance, r > 0. A bunch with too many walls around it is halved.
template <class T>
std::uint32_t keep_clearance_in(const WallGrid<T>& grid, std::span<const Segment> motions, double r) noexcept {
  constexpr std::size_t room = 128;
  std::array<WallOf<T>, room> walls;
  detail::MotionBunch<T> bunch(motions, r);
  const std::size_t count = grid.copy_near(bunch.around(), walls.data(), room);
  if (count == grid.no_room) {
    if (motions.size() == 1) {
      return grid.for_each_along(motions[0], r,
                                 [&](const Segment& wall) { return segments_keep_distance(motions[0], wall, r); });
    }
    const std::size_t half = motions.size() / 2;
    return keep_clearance_in(grid, motions.first(half), r) | keep_clearance_in(grid, motions.subspan(half), r) << half;
  }
  bunch.sift({walls.data(), count});
  const auto keeps_off = [&](std::size_t i, std::size_t wall) {
    return segments_keep_distance(motions[i], walls[wall].segment(), r);
  };
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    bool keeps = bunch.count(i) == 0 || keeps_off(i, bunch.first(i));
    if (bunch.count(i) > 1) keeps = keeps && keeps_off(i, bunch.last(i));
    if (bunch.count(i) > 2 && keeps) {
      const BoxScreen<T> screen(box_of(motions[i]).grown(r));
      for (std::size_t w = bunch.first(i) + 1; keeps && w < bunch.last(i); ++w) {
        keeps = !screen.meets(walls[w]) || keeps_off(i, w);
      }
    }
    kept |= std::uint32_t{keeps} << i;
  }
  return kept;
}

}  // namespace

/// Most pairs lie on one side of the line of one of the two, far enough from it: that is asked first, and beyond
/// rounding, so that the ends would say the same. Whether they cross is decided by plain doubles: in doubt an end is
/// within rounding of the other segment, and its distance decides.
bool segments_keep_distance(const Segment& s, const Segment& t, double r) noexcept {
  constexpr double beyond_rounding = 1.0 + 1e-12;
  const double r_sq = r * r;
  const Vec2 u = s.b - s.a;
  const Vec2 v = t.b - t.a;
  const double a1 = cross(u, t.a - s.a);
  const double a2 = cross(u, t.b - s.a);
  const double b1 = cross(v, s.a - t.a);
  const double b2 = cross(v, s.b - t.a);
  const bool is_beside_s = (a1 > 0) == (a2 > 0);
  const bool is_beside_t = (b1 > 0) == (b2 > 0);
  const bool far_from_s = is_beside_s & (std::min(a1 * a1, a2 * a2) > beyond_rounding * r_sq * dot(u, u));
  const bool far_from_t = is_beside_t & (std::min(b1 * b1, b2 * b2) > beyond_rounding * r_sq * dot(v, v));
  if (far_from_s | far_from_t) return true;
  if (!is_beside_s && !is_beside_t) return false;
  return keeps(t.a, s, r_sq) && keeps(t.b, s, r_sq) && keeps(s.a, t, r_sq) && keeps(s.b, t, r_sq);
}

WallIndex::WallIndex(const WallSet& walls, std::span<const Segment> more, const Execution& execution)
    : wall_count_(walls.size() + more.size()) {
  if (wall_count_ > (std::size_t{1} << 31)) throw InputError("walls", "at most 2^31 walls can be indexed");
  walls.visit([&]<class Span>(Span given) {
    using T = typename Span::element_type::Number;
    const auto build = [&]<class U>(U) {
      const auto filed = [&](std::size_t i) {
        if (i >= given.size()) return FiledWall<U>{wall_of<U>(more[i - given.size()]), more[i - given.size()]};
        const Segment s = given[i].segment();
        return FiledWall<U>{wall_of<U>(s), s};
      };
      const WallStatistics statistics = statistics_of<U>(wall_count_, filed, execution);
      box_ = statistics.box;
      grid_ = WallGridBuilder<U>(statistics, 65536, 0, execution).build(wall_count_, filed);
    };
    if (std::is_same_v<T, float> && fits_float(more)) {
      build(float{});
    } else {
      build(double{});
    }
  });
}

std::size_t WallIndex::bytes() const {
  return std::visit([](const auto& grid) { return grid.bytes(); }, grid_);
}

std::vector<Segment> WallIndex::some_walls(std::size_t most) const {
  return std::visit(
      [most](const auto& grid) {
        const std::size_t n = std::min(most, grid.filed_count());
        std::vector<Segment> walls(n);
        for (std::size_t i = 0; i < n; ++i) walls[i] = grid.filed(i * grid.filed_count() / n);
        return walls;
      },
      grid_);
}

bool WallIndex::blocks(Vec2 a, Vec2 b) const noexcept {
  const Segment motion{a, b};
  const auto passes = [&](const Segment& wall) { return !segments_touch(motion, wall); };
  return !std::visit([&](const auto& grid) { return grid.for_each_along(motion, 0.0, passes); }, grid_);
}

bool WallIndex::keeps_clearance(Vec2 a, Vec2 b, double r) const noexcept {
  if (r <= 0.0) return !blocks(a, b);
  const Segment motion{a, b};
  const auto keeps_off = [&](const Segment& wall) { return segments_keep_distance(motion, wall, r); };
  return std::visit([&](const auto& grid) { return grid.for_each_along(motion, r, keeps_off); }, grid_);
}

std::uint32_t WallIndex::keep_clearance(std::span<const Segment> motions, double r) const noexcept {
  if (motions.empty()) return 0;
  if (r > 0.0) return std::visit([&](const auto& grid) { return keep_clearance_in(grid, motions, r); }, grid_);
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) kept |= std::uint32_t{!blocks(motions[i].a, motions[i].b)} << i;
  return kept;
}

double WallIndex::clearance(Vec2 p, double at_most) const noexcept {
  if (wall_count_ == 0) return at_most;
  const double farthest = std::max({p.x - box_.min.x, box_.max.x - p.x, p.y - box_.min.y, box_.max.y - p.y, 0.0});
  const double cell = std::visit([](const auto& grid) { return grid.cell(); }, grid_);
  double nearest_sq = at_most * at_most;
  for (double radius = std::min(cell, at_most);; radius = std::min(2 * radius, at_most)) {
    for_each_near(Box{p, p}.grown(radius), [&](const Segment& wall) {
      nearest_sq = std::min(nearest_sq, distance_sq(p, wall));
      return nearest_sq > 0.0;
    });
    if (nearest_sq <= radius * radius || radius >= at_most || radius > farthest) break;
  }
  return std::min(at_most, std::sqrt(nearest_sq));
}

}  // namespace warren
