// SPDX-License-Identifier: BSD-3-Clause
#include "tests/matrix/plain_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace warren::test {
namespace {

/// Positive on the left of the line; the distance from it.
double side_of(const PlaneLine& line, PlanePoint p) {
  const double dx = line.b.x - line.a.x;
  const double dy = line.b.y - line.a.y;
  const double length = std::hypot(dx, dy);
  return length > 0.0 ? (dx * (p.y - line.a.y) - dy * (p.x - line.a.x)) / length : 0.0;
}

bool apart(double one, double other) { return (one > touch && other < -touch) || (one < -touch && other > touch); }

}  // namespace

double distance_of(PlanePoint p, const PlaneLine& line) {
  const double dx = line.b.x - line.a.x;
  const double dy = line.b.y - line.a.y;
  const double square = dx * dx + dy * dy;
  const double along = square > 0.0 ? ((p.x - line.a.x) * dx + (p.y - line.a.y) * dy) / square : 0.0;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(p.x - line.a.x - t * dx, p.y - line.a.y - t * dy);
}

double distance_of(const PlaneLine& s, const PlaneLine& t) {
  if (crosses(s, t)) return 0.0;
  return std::min({distance_of(s.a, t), distance_of(s.b, t), distance_of(t.a, s), distance_of(t.b, s)});
}

bool crosses(const PlaneLine& s, const PlaneLine& t) {
  return apart(side_of(s, t.a), side_of(s, t.b)) && apart(side_of(t, s.a), side_of(t, s.b));
}

std::vector<PlaneLine> sides_of(const Ring& ring) {
  std::vector<PlaneLine> sides;
  for (std::size_t i = 0; i < ring.size(); ++i) sides.push_back({ring[i], ring[(i + 1) % ring.size()]});
  return sides;
}

bool holds(const Ring& ring, PlanePoint p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    if ((ring[i].y > p.y) == (ring[j].y > p.y)) continue;
    const double x = ring[i].x + (p.y - ring[i].y) * (ring[j].x - ring[i].x) / (ring[j].y - ring[i].y);
    inside = inside != (p.x < x);
  }
  return inside;
}

bool holds(const Region& region, PlanePoint p) {
  bool inside = false;
  for (const Ring& ring : region) inside = inside != holds(ring, p);
  return inside;
}

double distance_from_sides(const Region& region, PlanePoint p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Ring& ring : region) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      least = std::min(least, distance_of(p, PlaneLine{ring[i], ring[(i + 1) % ring.size()]}));
    }
  }
  return least;
}

/// Of the points on some level lines between two sides, the one that keeps farthest off the outline.
PlanePoint point_inside(const Ring& ring) {
  PlanePoint best = ring.front();
  double most = -1.0;
  constexpr int steps = 40;
  const auto by_x = [](PlanePoint a, PlanePoint b) { return a.x < b.x; };
  const auto by_y = [](PlanePoint a, PlanePoint b) { return a.y < b.y; };
  const auto [left, right] = std::minmax_element(ring.begin(), ring.end(), by_x);
  const auto [low, high] = std::minmax_element(ring.begin(), ring.end(), by_y);
  for (int i = 1; i < steps; ++i) {
    for (int j = 1; j < steps; ++j) {
      const PlanePoint p{left->x + (right->x - left->x) * i / steps, low->y + (high->y - low->y) * j / steps};
      const double room = distance_from_sides({ring}, p);
      if (room <= most || !holds(ring, p)) continue;
      most = room;
      best = p;
    }
  }
  return best;
}

}  // namespace warren::test
