// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "verify/exact/exact_segments.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {
namespace {

std::vector<Vec2> without_repetitions(const std::vector<Vec2>& corners) {
  std::vector<Vec2> kept = corners;
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
  return kept;
}

/// Is the inside right of the sides? Asked at the leftmost corner, the lowest of these: there the ring is convex.
bool runs_clockwise(const std::vector<Vec2>& corners) {
  const auto before = [](Vec2 p, Vec2 q) { return p.x < q.x || (p.x == q.x && p.y < q.y); };
  const auto corner = std::min_element(corners.begin(), corners.end(), before);
  const Vec2 next = corner + 1 == corners.end() ? corners.front() : *(corner + 1);
  const Vec2 last = corner == corners.begin() ? corners.back() : *(corner - 1);
  return exact::side_of(last, *corner, next) < 0;
}

std::string numbers(const Segment& s) { return fmt::format("{} {} {} {}", s.a.x, s.a.y, s.b.x, s.b.y); }

}  // namespace

Obstacles::Obstacles(const Scene& scene) : scene_(scene) {
  if (scene.bounds) {
    const Box& b = *scene.bounds;
    rings_.push_back({{b.min, {b.min.x, b.max.y}, b.max, {b.max.x, b.min.y}}, Ring::none});
  }
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    Ring ring{without_repetitions(scene.polygons[i].corners), i};
    if (ring.corners.empty()) continue;
    if (runs_clockwise(ring.corners)) std::reverse(ring.corners.begin(), ring.corners.end());
    rings_.push_back(std::move(ring));
  }
  for (std::size_t ring = 0; ring < rings_.size(); ++ring) {
    first_side_.push_back(sides_.size());
    for (const Vec2 p : rings_[ring].corners) rings_[ring].box.include(p);
    for (std::size_t side = 0; side < rings_[ring].corners.size(); ++side) sides_.push_back({ring, side});
  }
}

std::string Obstacles::name(std::size_t i) const {
  if (i < wall_count()) return fmt::format("wall {}: {}", i, numbers(segment(i)));
  const Side side = sides_[i - wall_count()];
  const Ring& ring = rings_[side.ring];
  if (ring.polygon == Ring::none) return fmt::format("bounds: {}", numbers(segment(i)));
  return fmt::format("polygon {}: {}", ring.polygon, numbers(segment(i)));
}

bool outline_holds(std::span<const Vec2> corners, Vec2 p, bool on_outline) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [a, b] = exact::outline_side(corners, i);
    if (exact::contains({a, b}, p)) return on_outline;
    // Sides count where they cross the height of p going right of it; a half-open rule counts shared corners once.
    if ((a.y <= p.y) != (b.y <= p.y)) {
      const int side = exact::side_of(a, b, p);
      if (b.y > a.y ? side > 0 : side < 0) inside = !inside;
    }
  }
  return inside;
}

}  // namespace warren
