// SPDX-License-Identifier: BSD-3-Clause
#include "planners/axis/medial_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "planners/vertical_cells/cell_decomposition.hpp"

namespace warren {
namespace {

constexpr double units_of_resolution = 4.0;

/// Vertices are right to some units in the last place. Rounded to 2^-12 grid units, which is nothing beside the snap,
/// those that lie on a coarse grid (in the middle of a corridor, say) do so exactly, and so do their clearances.
double without_noise(double coordinate) { return std::nearbyint(coordinate * 4096.0) / 4096.0; }

}  // namespace

MedialAxis::MedialAxis(const PlaneObstacles& obstacles, const Execution& execution) {
  collect(obstacles);
  if (!(frame_.width() > 0.0) || !(frame_.height() > 0.0)) {
    throw InputError("medial axis", "expected bounds, or obstacles that span an area");
  }
  build(obstacles, execution);
}

void MedialAxis::collect(const PlaneObstacles& obstacles) {
  obstacles_ = obstacles.walls;
  for (std::size_t p = 0; p < obstacles.polygons.size(); ++p) {
    for_each_side(obstacles.polygons[p], [&](Vec2 a, Vec2 b) { obstacles_.push_back({a, b}); });
  }
  for (const Segment& s : obstacles_) frame_.include(box_of(s));
  if (obstacles.bounds) frame_ = *obstacles.bounds;
  true_obstacle_count_ = obstacles_.size();
  const std::array<Vec2, 4> corners{
      {frame_.min, {frame_.max.x, frame_.min.y}, frame_.max, {frame_.min.x, frame_.max.y}}};
  for (std::size_t i = 0; i < 4; ++i) obstacles_.push_back({corners[i], corners[(i + 1) % 4]});
  if (obstacles.bounds) true_obstacle_count_ = obstacles_.size();
}

std::vector<char> MedialAxis::free_points(const PlaneObstacles& obstacles, const std::vector<Vec2>& points,
                                          const Execution& execution) const {
  PlaneObstacles solid;
  solid.polygons = obstacles.polygons;
  Box all = frame_;
  for (const Vec2 p : solid.polygons.corners) all.include(p);
  solid.bounds = all.grown(1.0 + 0.1 * std::max(all.width(), all.height()));
  const CellDecomposition cells = decompose(solid, points, execution);
  std::vector<char> is_free(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    is_free[i] = !cells.places[i].blocked && frame_.contains(points[i]) ? 1 : 0;
  }
  return is_free;
}

void MedialAxis::build(const PlaneObstacles& obstacles, const Execution& execution) {
  const SnappedSegments snapped = snap_segments(obstacles_, execution);
  VoronoiDiagram diagram = voronoi_diagram(snapped.segments, execution);
  const SnapGrid& grid = snapped.grid;
  snap_error_ = snapped.error;
  resolution_ = units_of_resolution * (grid.unit + snap_error_);
  vertices_ = std::move(diagram.vertices);
  for (Vec2& v : vertices_) v = grid.at(without_noise(v.x), without_noise(v.y));
  sites_ = std::move(diagram.sites);
  for (VoronoiSite& site : sites_) {
    site.shape = {grid.at(site.shape.a.x, site.shape.a.y), grid.at(site.shape.b.x, site.shape.b.y)};
    site.segment = snapped.segments[site.segment].source;
  }
  const std::vector<char> is_free = free_points(obstacles, vertices_, execution);
  edges_.reserve(diagram.edges.size());
  for (std::size_t i = 0; i < diagram.edges.size(); ++i) {
    if (i % 4096 == 0) execution.check();
    const VoronoiEdge& e = diagram.edges[i];
    AxisEdge edge{e.from, e.to, e.site, e.other, 0.0, 0.0};
    // The end with more room tells for sure on which side of the obstacles the whole edge lies.
    const auto room = [&](VertexId v) { return distance(vertices_[v], obstacles_[sites_[e.site].segment]); };
    const VertexId wide = room(e.from) >= room(e.to) ? e.from : e.to;
    if (is_free[wide] == 0 || room(wide) <= resolution_) continue;
    const AxisCurve bare = curve(edge);
    edge.length = bare.length();
    edge.clearance = least_clearance(edge, bare);
    edges_.push_back(edge);
  }
}

double MedialAxis::least_clearance(const AxisEdge& edge, const AxisCurve& curve) const {
  const auto clearance_at = [&](Vec2 p) {
    return std::min(distance(p, obstacles_[sites_[edge.site].segment]),
                    distance(p, obstacles_[sites_[edge.other].segment]));
  };
  const double least = std::min(clearance_at(curve.from()), clearance_at(curve.to()));
  const auto [low, high] = std::minmax({curve.first(), curve.last()});
  const bool has_waist = low < curve.waist() && curve.waist() < high;
  return has_waist ? std::min(least, clearance_at(curve.at(curve.waist()))) : least;
}

}  // namespace warren
