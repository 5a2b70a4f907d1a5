// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/disc_ground.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "core/base/trigonometry.hpp"

namespace warren {
namespace {

Vec2 unit_of(Vec2 v) { return (1.0 / norm(v)) * v; }

DiscCircle circle_around(const VisibleCorners& corners, VertexId v) {
  const Vec2 centre = corners.position(v);
  const Sector sector = corners.sector(v);
  DiscCircle circle{centre, unit_of(sector.first - centre), unit_of(sector.last - centre), {}, 0.0, v};
  circle.begin = {-circle.first.y, circle.first.x};
  const Vec2 end{circle.last.y, -circle.last.x};
  const double width = portable::atan2(cross(circle.begin, end), dot(circle.begin, end));
  circle.width = sector.first == sector.last ? std::numbers::pi : std::max(width, 0.0);
  return circle;
}

/// Walls without length, each place once.
std::vector<Vec2> places_of_points(const std::vector<Segment>& walls) {
  std::vector<Vec2> places;
  for (const Segment& wall : walls) {
    if (wall.a == wall.b) places.push_back(wall.a);
  }
  std::sort(places.begin(), places.end(), [](Vec2 p, Vec2 q) { return p.x != q.x ? p.x < q.x : p.y < q.y; });
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

}  // namespace

DiscGround::DiscGround(const PlaneObstacles& obstacles, const Execution& execution)
    : corners(obstacles, execution), box(box_around(obstacles)) {
  if (!obstacles.bounds && !box.empty()) room = box;
  const PlanePieces& pieces = corners.pieces();
  execution.reserve(pieces.pieces().size() * sizeof(Segment) + corners.size() * (sizeof(DiscCircle) + 4));
  segments.reserve(pieces.pieces().size());
  for (std::uint32_t i = 0; i < pieces.pieces().size(); ++i) segments.push_back(pieces.segment(i));
  circle_of.assign(corners.size(), no_vertex);
  for (VertexId v = 0; v < corners.size(); ++v) {
    execution.poll(v);
    if (!corners.is_reflex(v)) continue;
    circle_of[v] = static_cast<std::uint32_t>(circles.size());
    circles.push_back(circle_around(corners, v));
  }
  first_whole = static_cast<std::uint32_t>(circles.size());
  const std::vector<Vec2> points = places_of_points(obstacles.walls);
  execution.reserve(points.size() * (sizeof(Segment) + sizeof(DiscCircle)));
  for (const Vec2 p : points) {
    execution.check();
    const std::vector<Sector> sectors = free_sectors(pieces, p);
    if (sectors.empty() || !sectors.front().whole) continue;  // on an obstacle, or inside
    segments.push_back({p, p});
    circles.push_back({p, {}, {}, {1.0, 0.0}, 2.0 * std::numbers::pi, no_vertex});
  }
  grid = SegmentGrid(segments, execution);
}

DiscRoadmap::DiscRoadmap(const PlaneObstacles& obstacles, const Execution& execution, std::optional<Graph> known)
    : ground(obstacles, execution), graph(ground.corners, VisibilityEdges::discs, execution, std::move(known)) {}

}  // namespace warren
