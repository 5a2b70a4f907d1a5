// SPDX-License-Identifier: BSD-3-Clause
#include "planners/voronoi_diagram.hpp"

#include <boost/polygon/voronoi_builder.hpp>
#include <boost/polygon/voronoi_diagram.hpp>

namespace warren {
namespace {

using Diagram = boost::polygon::voronoi_diagram<double>;

constexpr std::size_t bytes_per_segment = 1000;

VoronoiSite site_of(const Diagram::cell_type& cell, std::span<const SnappedSegment> segments) {
  const SnappedSegment& s = segments[cell.source_index()];
  const auto number = static_cast<std::uint32_t>(cell.source_index());
  const Vec2 a{static_cast<double>(s.x1), static_cast<double>(s.y1)};
  const Vec2 b{static_cast<double>(s.x2), static_cast<double>(s.y2)};
  if (cell.contains_segment()) return {{a, b}, number};
  const bool is_end = cell.source_category() == boost::polygon::SOURCE_CATEGORY_SEGMENT_END_POINT;
  return {is_end ? AxisSite{b, b} : AxisSite{a, a}, number};
}

}  // namespace

VoronoiDiagram voronoi_diagram(std::span<const SnappedSegment> segments, const Execution& execution) {
  execution.check();
  execution.reserve(segments.size() * bytes_per_segment);
  boost::polygon::voronoi_builder<std::int32_t> builder;
  for (const SnappedSegment& s : segments) {
    if (s.x1 == s.x2 && s.y1 == s.y2) {
      builder.insert_point(s.x1, s.y1);
    } else {
      builder.insert_segment(s.x1, s.y1, s.x2, s.y2);
    }
  }
  Diagram diagram;
  builder.construct(&diagram);
  execution.check();

  VoronoiDiagram result;
  result.vertices.reserve(diagram.num_vertices());
  for (const auto& vertex : diagram.vertices()) result.vertices.push_back({vertex.x(), vertex.y()});
  result.sites.reserve(diagram.num_cells());
  for (const auto& cell : diagram.cells()) result.sites.push_back(site_of(cell, segments));
  const auto vertex_number = [&](const Diagram::vertex_type* v) {
    return static_cast<std::uint32_t>(v - diagram.vertices().data());
  };
  const auto site_number = [&](const Diagram::cell_type* c) {
    return static_cast<std::uint32_t>(c - diagram.cells().data());
  };
  result.edges.reserve(diagram.num_edges() / 2);
  for (const auto& edge : diagram.edges()) {
    if (&edge > edge.twin() || edge.is_secondary() || edge.is_infinite()) continue;
    result.edges.push_back({vertex_number(edge.vertex0()), vertex_number(edge.vertex1()), site_number(edge.cell()),
                            site_number(edge.twin()->cell())});
  }
  return result;
}

}  // namespace warren
