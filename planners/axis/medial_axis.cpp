// SPDX-License-Identifier: BSD-3-Clause
#include "planners/axis/medial_axis.hpp"

#include <boost/polygon/voronoi_builder.hpp>
#include <boost/polygon/voronoi_diagram.hpp>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/chunks.hpp"
#include "planners/vertical_cells/cell_decomposition.hpp"
#include "spatial/obstacles/polygon_index.hpp"

namespace warren {
namespace {

constexpr double largest_turn = 1.0 / 32.0;  // radians between two tangents

Vec2 unit(Vec2 v) {
  const double length = norm(v);
  return length > 0.0 ? (1.0 / length) * v : Vec2{1.0, 0.0};
}

namespace boost_polygon = boost::polygon;

constexpr std::size_t bytes_per_segment = 1000;

/// Of the construction that runs in this thread, or was the last: Boost makes its predicates itself, so they look here.
thread_local const Execution* construction = nullptr;

/// Throws Stopped, every some thousand questions.
void poll_sometimes() {
  thread_local std::uint32_t questions = 0;
  construction->poll(++questions);
}

/// One of Boost's own predicates, which looks at the deadline before it answers.
template <class Plain>
struct Polled {
  template <class A, class B>
  bool operator()(const A& a, const B& b) const {
    poll_sometimes();
    return plain(a, b);
  }
  Plain plain;
};

using IntegerTraits = boost_polygon::detail::voronoi_ctype_traits<std::int32_t>;
using PlainPredicates = boost_polygon::detail::voronoi_predicates<IntegerTraits>;
using PlainDiagramTraits = boost_polygon::voronoi_diagram_traits<double>;

/// The order of events is asked for while they are sorted, queued and taken.
struct PolledPredicates : PlainPredicates {
  template <class Site, class Circle>  // NOLINTNEXTLINE(readability-identifier-naming): Boost's name
  using event_comparison_predicate = Polled<PlainPredicates::event_comparison_predicate<Site, Circle>>;
};

/// Which vertices are the same is asked edge by edge, at the end.
struct PolledDiagramTraits : PlainDiagramTraits {
  // NOLINTNEXTLINE(readability-identifier-naming): Boost's name
  using vertex_equality_predicate_type = Polled<PlainDiagramTraits::vertex_equality_predicate_type>;
};

using Diagram = boost_polygon::voronoi_diagram<double, PolledDiagramTraits>;
using Builder = boost_polygon::voronoi_builder<std::int32_t, IntegerTraits, PolledPredicates>;

constexpr double units_of_resolution = 4.0;

/// Vertices are right to some units in the last place. Rounded to 2^-12 grid units, which is nothing beside the snap,
/// those that lie on a coarse grid (in the middle of a corridor, say) do so exactly, and so do their clearances.
double without_noise(double coordinate) { return std::nearbyint(coordinate * 4096.0) / 4096.0; }

VoronoiSite site_of(const Diagram::cell_type& cell, const SnappedSegments& snapped) {
  const IntegerPiece& s = snapped.segments[cell.source_index()];
  const Vec2 a = snapped.grid.at(s.a.x + 0.0, s.a.y + 0.0);  // so that no zero is a negative one
  const Vec2 b = snapped.grid.at(s.b.x + 0.0, s.b.y + 0.0);
  if (cell.contains_segment()) return {{a, b}, s.source};
  const bool is_end = cell.source_category() == boost_polygon::SOURCE_CATEGORY_SEGMENT_END_POINT;
  return {is_end ? Segment{b, b} : Segment{a, a}, s.source};
}

/// Gives the axis its vertices, its sites and all edges, unmeasured, whose sites share no point, or are two segments
/// that share an end. In world units. Throws Stopped; for memory only before it begins.
void add_diagram(const SnappedSegments& snapped, MedialAxis& axis, const Execution& execution) {
  execution.check();
  execution.reserve(snapped.segments.size() * bytes_per_segment);
  construction = &execution;
  Builder builder;
  const auto whole = [](double coordinate) { return static_cast<std::int32_t>(coordinate); };
  for (const IntegerPiece& s : snapped.segments) {
    poll_sometimes();
    if (s.a == s.b) {
      builder.insert_point(whole(s.a.x), whole(s.a.y));
    } else {
      builder.insert_segment(whole(s.a.x), whole(s.a.y), whole(s.b.x), whole(s.b.y));
    }
  }
  Diagram diagram;
  builder.construct(&diagram);
  execution.check();

  std::size_t taken = 0;
  axis.vertices.reserve(diagram.num_vertices());
  for (const auto& vertex : diagram.vertices()) {
    execution.poll(++taken);
    axis.vertices.push_back(snapped.grid.at(without_noise(vertex.x()), without_noise(vertex.y())));
  }
  axis.sites.reserve(diagram.num_cells());
  for (const auto& cell : diagram.cells()) {
    execution.poll(++taken);
    axis.sites.push_back(site_of(cell, snapped));
  }
  const auto vertex_number = [&](const Diagram::vertex_type* v) {
    return static_cast<std::uint32_t>(v - diagram.vertices().data());
  };
  const auto site_number = [&](const Diagram::cell_type* c) {
    return static_cast<std::uint32_t>(c - diagram.cells().data());
  };
  axis.edges.reserve(diagram.num_edges() / 2);
  for (const auto& edge : diagram.edges()) {
    execution.poll(++taken);
    if (&edge > edge.twin() || edge.is_secondary() || edge.is_infinite()) continue;
    axis.edges.push_back({vertex_number(edge.vertex0()), vertex_number(edge.vertex1()), site_number(edge.cell()),
                          site_number(edge.twin()->cell()), 0.0, 0.0});
  }
}

}  // namespace

AxisCurve::AxisCurve(const Segment& one, const Segment& other, Vec2 from, Vec2 to) : from_(from), to_(to) {
  if (is_point(one) != is_point(other)) {
    const Vec2 focus = is_point(one) ? one.a : other.a;
    const Segment& directrix = is_point(one) ? other : one;
    along_ = unit(directrix.b - directrix.a);
    origin_ = directrix.a + dot(focus - directrix.a, along_) * along_;
    const double side = cross(along_, focus - directrix.a);
    upwards_ = side < 0.0 ? Vec2{along_.y, -along_.x} : Vec2{-along_.y, along_.x};
    focal_ = std::abs(side);
    waist_ = 0.0;
  }
  if (focal_ == 0.0) {
    origin_ = from;
    along_ = unit(to - from);
    if (is_point(one) && is_point(other)) waist_ = parameter_beside(one.a);
  }
  first_ = parameter_beside(from);
  last_ = parameter_beside(to);
}

Vec2 AxisCurve::at(double parameter) const {
  const Vec2 foot = origin_ + parameter * along_;
  if (focal_ == 0.0) return foot;
  return foot + (0.5 * (parameter / focal_ * parameter + focal_)) * upwards_;
}

AxisCurve AxisCurve::part(double first, double last, Vec2 from, Vec2 to) const {
  AxisCurve result = *this;
  result.first_ = first;
  result.last_ = last;
  result.from_ = from;
  result.to_ = to;
  return result;
}

double AxisCurve::length() const {
  if (focal_ == 0.0) return std::abs(last_ - first_);
  const auto from_apex = [&](double t) {
    const double slope = t / focal_;
    return 0.5 * (t * std::sqrt(1.0 + slope * slope) + focal_ * portable::asinh(slope));
  };
  return std::abs(from_apex(last_) - from_apex(first_));
}

void AxisCurve::append_polyline(std::vector<Vec2>& path) const {
  if (focal_ > 0.0) {
    const auto slope_angle = [&](double parameter) { return portable::atan(parameter / focal_); };
    const auto append = [&](double t0, double t1) {
      const double turn = slope_angle(t1) - slope_angle(t0);
      const double count = std::max(1.0, std::ceil(std::abs(turn) / largest_turn));
      double touches = t0;
      for (double i = 1.0; i <= count; i += 1.0) {
        const double next = i == count ? t1 : focal_ * portable::tan(slope_angle(t0) + turn * (i / count));
        const double height = 0.5 * (touches / focal_ * next + focal_);  // where the tangents of both meet
        path.push_back(origin_ + (0.5 * (touches + next)) * along_ + height * upwards_);
        touches = next;
      }
    };
    const bool over_apex = std::min(first_, last_) < 0.0 && std::max(first_, last_) > 0.0;
    if (over_apex) append(first_, 0.0);  // a tangent at the narrowest point keeps its clearance exactly
    append(over_apex ? 0.0 : first_, last_);
  }
  path.push_back(to_);
}

MedialAxis::MedialAxis(const PlaneObstacles& plane, const Execution& execution) : obstacles(plane.walls) {
  for (std::size_t p = 0; p < plane.polygons.size(); ++p) {
    for_each_side(plane.polygons[p], [&](Vec2 a, Vec2 b) { obstacles.push_back({a, b}); });
  }
  for (const Segment& s : obstacles) frame.include(box_of(s));
  if (plane.bounds) frame = *plane.bounds;
  true_obstacle_count = obstacles.size();
  for_each_side(frame.corners(), [&](Vec2 a, Vec2 b) { obstacles.push_back({a, b}); });
  if (plane.bounds) true_obstacle_count = obstacles.size();
  if (!(frame.width() > 0.0) || !(frame.height() > 0.0)) {
    throw InputError("medial axis", "expected bounds, or obstacles that span an area");
  }
  const SnappedSegments snapped = snap_segments(obstacles, execution);
  resolution = units_of_resolution * (snapped.grid.unit + snapped.error);
  add_diagram(snapped, *this, execution);
  decompose({plane.polygons, {}, {}}, {}, execution);  // throws where polygons overlap
  const PolygonIndex polygons(plane.polygons, execution);
  std::vector<char> is_free(vertices.size());  // inside the frame (or on it) and not strictly inside a polygon; exact
  for_each_index(vertices.size(), 1024, execution, [&](std::size_t i) {
    is_free[i] = frame.contains(vertices[i]) && !polygons.polygon_around(vertices[i]) ? 1 : 0;
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    execution.poll(i);
    AxisEdge edge = edges[i];
    // The end with more room tells for sure on which side of the obstacles the whole edge lies.
    const auto room = [&](VertexId v) { return distance(vertices[v], obstacles[sites[edge.site].segment]); };
    const VertexId wide = room(edge.from) >= room(edge.to) ? edge.from : edge.to;
    if (is_free[wide] == 0 || room(wide) <= resolution) continue;
    const AxisCurve bare = curve(edge);
    edge.length = bare.length();
    edge.clearance = least_clearance(edge, bare);
    edges[kept++] = edge;
  }
  edges.resize(kept);
}

double MedialAxis::least_clearance(const AxisEdge& edge, const AxisCurve& curve) const {
  const auto clearance_at = [&](Vec2 p) {
    return std::min(distance(p, obstacles[sites[edge.site].segment]),
                    distance(p, obstacles[sites[edge.other].segment]));
  };
  const double least = std::min(clearance_at(curve.from()), clearance_at(curve.to()));
  const auto [low, high] = std::minmax({curve.first(), curve.last()});
  const bool has_waist = low < curve.waist() && curve.waist() < high;
  return has_waist ? std::min(least, clearance_at(curve.at(curve.waist()))) : least;
}

}  // namespace warren
