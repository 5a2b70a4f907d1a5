// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/free_headings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/whole.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "parallel/asked_memory.hpp"

namespace warren {
namespace {

/// The headings that one body is kept from at one place; the place is the origin.
class BlockedHeadings {
 public:
  static constexpr double half_turn = std::numbers::pi;
  static constexpr double full_turn = 2.0 * half_turn;

  BlockedHeadings(std::span<const Vec2> outline, double room, const Execution& execution)
      : outline_(outline), room_(room), execution_(execution), reach_(outline_reach(outline) + room) {}

  double reach() const { return reach_; }

  void add(const Segment& obstacle) {
    execution_.check();
    if (distance(Vec2{}, obstacle) > reach_) return;
    for_each_side(outline_, [&](Vec2 a, Vec2 b) { add_pair({a, b}, obstacle); });
  }

  /// What is left.
  std::vector<HeadingInterval> free() && {
    std::sort(blocked_.begin(), blocked_.end());
    std::vector<HeadingInterval> gaps;
    double end = -half_turn;
    for (const auto& [low, high] : blocked_) {
      if (low > end) gaps.push_back({end, low - end});
      end = std::max(end, high);
    }
    if (half_turn > end) gaps.push_back({end, half_turn - end});
    const bool is_cut = gaps.size() > 1 && gaps.front().low == -half_turn && end < half_turn;
    if (is_cut) {
      gaps.back().width += gaps.front().width;
      gaps.erase(gaps.begin());
    }
    std::erase_if(gaps, [](const HeadingInterval& gap) { return gap.width < narrowest_heading; });
    return gaps;
  }

 private:
  static double angle_of(Vec2 p) { return portable::atan2(p.y, p.x); }
  /// Angles `turn` + phi at which the cosine of phi is that; none where it can't be.
  void add_angles(double turn, double cosine) {
    constexpr double rounding = 1e-12;
    if (!(std::abs(cosine) <= 1.0 + rounding)) return;
    const double phi = portable::acos(std::clamp(cosine, -1.0, 1.0));
    for (const double angle : {turn - phi, turn + phi}) events_[count_++] = wrapped_angle(angle);
  }
  /// Where a point on a circle around the origin is at the room's distance from the line through s.
  template <class Add>
  void meet_line(double radius, const Segment& s, const Add& add) {
    const Vec2 along = s.b - s.a;
    const double length = norm(along);
    if (!(length > 0.0) || !(radius > 0.0)) return;
    const Vec2 normal = (1.0 / length) * Vec2{-along.y, along.x};
    for (const double side : {-room_, room_}) add(angle_of(normal), (dot(normal, s.a) + side) / radius);
  }

  void add_pair(const Segment& side, const Segment& obstacle) {
    count_ = 0;
    for (const Vec2 corner : {side.a, side.b}) {
      const double radius = norm(corner);
      const auto add = [&](double turn, double cosine) { add_angles(turn - angle_of(corner), cosine); };
      meet_line(radius, obstacle, add);
      for (const Vec2 end : {obstacle.a, obstacle.b}) {
        const double away = norm(end);
        if (!(radius > 0.0 && away > 0.0)) continue;
        add(angle_of(end), (radius * radius + away * away - room_ * room_) / (2.0 * radius * away));
      }
    }
    for (const Vec2 end : {obstacle.a, obstacle.b}) {
      // Seen from the body, the end turns the other way.
      meet_line(norm(end), side, [&](double turn, double cosine) { add_angles(angle_of(end) - turn, cosine); });
    }
    std::sort(events_.begin(), events_.begin() + as_whole<std::ptrdiff_t>(count_));
    if (count_ == 0) return add_between(side, obstacle, -half_turn, half_turn);
    for (std::size_t i = 0; i < count_; ++i) {
      const double next = i + 1 < count_ ? events_[i + 1] : events_[0] + full_turn;
      add_between(side, obstacle, events_[i], next);
    }
  }

  void add_between(const Segment& side, const Segment& obstacle, double low, double high) {
    const Rotation turned(0.5 * (low + high));
    if (distance(Segment{turned(side.a), turned(side.b)}, obstacle) > room_) return;
    block(low, std::min(high, half_turn));
    if (high > half_turn) block(-half_turn, high - full_turn);
  }
  void block(double low, double high) {
    if (!blocked_.empty() && blocked_.back().second == low) {
      blocked_.back().second = high;
    } else {
      push_asked(blocked_, {low, high}, execution_);
    }
  }

  std::span<const Vec2> outline_;
  double room_;
  const Execution& execution_;
  double reach_;
  std::array<double, 24> events_{};  // of a pair: two corners meet two lines and two ends, two ends two lines
  std::size_t count_ = 0;
  std::vector<std::pair<double, double>> blocked_;
};

/// Calls f with the borders between free and blocked cells near a place of the map, as segments of the world.
template <class F>
void for_each_border_near(const OccupancyMap& map, Vec2 place, double reach, const Execution& execution, const F& f) {
  const Vec2 at = map_point(map, place);
  const double cells = reach / map.cell + 2.0;
  const auto within = [](double x, std::uint32_t size) {
    return bounded_whole<std::int64_t>(std::floor(x), -1.0, static_cast<double>(size));
  };
  const auto is_blocked = [&](std::int64_t x, std::int64_t y) {
    return x < 0 || y < 0 || x >= map.width() || y >= map.height() || map.blocked.holds(x, y);
  };
  const auto border = [&](std::int64_t x, std::int64_t y, std::int64_t to_x, std::int64_t to_y) {
    f(Segment{world_point(map, {static_cast<double>(x), static_cast<double>(y)}),
              world_point(map, {static_cast<double>(to_x), static_cast<double>(to_y)})});
  };
  for (std::int64_t y = within(at.y - cells, map.height()); y <= within(at.y + cells, map.height()); ++y) {
    execution.check();
    for (std::int64_t x = within(at.x - cells, map.width()); x <= within(at.x + cells, map.width()); ++x) {
      if (is_blocked(x, y) != is_blocked(x + 1, y)) border(x + 1, y, x + 1, y + 1);
      if (is_blocked(x, y) != is_blocked(x, y + 1)) border(x, y + 1, x + 1, y + 1);
    }
  }
}

}  // namespace

std::vector<HeadingInterval> free_headings(const Scene& scene, std::span<const Vec2> outline, Vec2 place, double room,
                                           const Execution& execution) {
  BlockedHeadings blocked(outline, room, execution);
  const auto add = [&](const Segment& s) { blocked.add({s.a - place, s.b - place}); };
  if (scene.map) {
    for_each_border_near(*scene.map, place, blocked.reach(), execution, add);
    return std::move(blocked).free();
  }
  for (std::size_t i = 0; i < scene.walls.size(); ++i) add(scene.walls.segment(i));
  for (const Segment& side : bounds_walls(scene)) add(side);
  for (const ScenePolygon& polygon : scene.polygons) {
    for_each_side(polygon.corners, [&](Vec2 a, Vec2 b) { add({a, b}); });
  }
  return std::move(blocked).free();
}

}  // namespace warren
